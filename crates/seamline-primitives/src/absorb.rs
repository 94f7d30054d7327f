//! After the selection: regions and pieces that lie on a larger neighbour's surface after all.

use std::collections::{BTreeMap, HashSet};

use crate::hypothesis::{Hypothesis, View};
use crate::pieces::NONE;
use crate::regions::Regions;
use crate::surface::Kind;

/// Least cosine between the normals of a lone triangle and of the surface it lies on: at the pole of a
/// coarse sphere triangles meet at 60 degrees.
const LONE_TRIANGLE_COS: f64 = 0.2;
const PIECE_COS: f64 = 0.85;

/// A flat piece whose vertices lie on a curved surface is of its tessellation if it is no coarser: the steps
/// from it to the surface are at most so many times those of the others.
const LIKE_THE_OTHERS: f64 = 1.25;

/// Are the pieces of a plane steps of a curved surface, and not a flat on it, as at the end of a ball?
fn is_of_one_tessellation(view: View, curved: &Hypothesis, plane: &Hypothesis) -> bool {
    let step = |pieces: &[u32]| view.greatest_step(&curved.surface, curved.sign, pieces);
    step(&plane.pieces) <= LIKE_THE_OTHERS * step(&curved.pieces)
}

/// Gives regions and unowned pieces that lie on the surface of a larger neighbour to it, over walls too.
pub(crate) fn absorb(view: View, regions: &mut Regions, tolerance: f64) {
    for _ in 0..5 {
        let joined =
            absorb_regions(view, regions, tolerance) + absorb_pieces(view, regions, tolerance);
        if joined == 0 {
            break;
        }
    }
}

/// How far from a region's surface what it takes in may lie: what its own vertices lie on exactly takes in
/// nothing that does not.
fn reach(region: &Hypothesis, tolerance: f64) -> f64 {
    if region.exact {
        region.tolerance
    } else {
        region.tolerance.max(tolerance)
    }
}

fn absorb_regions(view: View, regions: &mut Regions, tolerance: f64) -> usize {
    let mut joined = 0;
    let mut alive: Vec<u32> = regions.alive().collect();
    alive.sort_by_key(|&r| regions.all[r as usize].evidence);
    for small in alive {
        let mut beside: BTreeMap<u32, f64> = BTreeMap::new();
        for &piece in &regions.all[small as usize].pieces {
            for &link in view.pieces.around.row(piece) {
                let link = &view.pieces.links[link as usize];
                let owner = regions.owner[link.across(piece) as usize];
                if owner != NONE && owner != small {
                    *beside.entry(owner).or_default() += link.length;
                }
            }
        }
        let evidence = |r: u32| regions.all[r as usize].evidence;
        let takes = |large: u32| {
            let large = &regions.all[large as usize];
            let own = &regions.all[small as usize];
            let tolerance = reach(large, tolerance);
            let certain = own.surface.kind == Kind::Plane && own.exact;
            let lies = |&p: &u32| view.fits(p, &large.surface, large.sign, tolerance);
            (large.exact || !certain)
                && own.pieces.iter().all(lies)
                && (!certain || is_of_one_tessellation(view, large, own))
        };
        let taker = beside
            .into_iter()
            .filter(|&(large, _)| evidence(large) > evidence(small) && takes(large))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((large, _)) = taker {
            let gone = regions.dissolve(small);
            join(view, regions, large, gone.pieces);
            joined += 1;
        }
    }
    joined
}

fn absorb_pieces(view: View, regions: &mut Regions, tolerance: f64) -> usize {
    let mut takers: Vec<(u32, u32)> = Vec::new();
    for piece in 0..view.pieces.count() as u32 {
        if regions.owner[piece as usize] != NONE || view.pieces.certain[piece as usize] {
            continue;
        }
        let lone = view.pieces.faces.row(piece).len() == 1;
        let cos = if lone { LONE_TRIANGLE_COS } else { PIECE_COS };
        let mut best: Option<(f64, u32)> = None;
        for &link in view.pieces.around.row(piece) {
            let link = &view.pieces.links[link as usize];
            let owner = regions.owner[link.across(piece) as usize];
            if owner == NONE {
                continue;
            }
            let Hypothesis { surface, sign, .. } = &regions.all[owner as usize];
            let tolerance = reach(&regions.all[owner as usize], tolerance);
            if view.fits_turned(piece, surface, *sign, tolerance, cos)
                && best.is_none_or(|(length, _)| link.length > length)
            {
                best = Some((link.length, owner));
            }
        }
        takers.extend(best.map(|(_, owner)| (owner, piece)));
    }
    takers.sort_unstable();
    for same in takers.chunk_by(|a, b| a.0 == b.0) {
        let pieces = same.iter().map(|&(_, piece)| piece).collect();
        join(view, regions, same[0].0, pieces);
    }
    takers.len()
}

fn join(view: View, regions: &mut Regions, region: u32, more: Vec<u32>) {
    for &piece in &more {
        regions.owner[piece as usize] = region;
    }
    let own = &mut regions.all[region as usize];
    let mut pieces = std::mem::take(&mut own.pieces);
    pieces.extend(more);
    debug_assert_eq!(pieces.iter().collect::<HashSet<_>>().len(), pieces.len());
    *own = view.weigh(own.surface, own.sign, pieces, own.tolerance);
}
