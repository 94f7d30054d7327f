//! After the selection: regions and pieces that lie on a larger neighbour's surface after all.

use std::collections::{BTreeMap, BTreeSet};

use crate::hypothesis::{Hypothesis, View};
use crate::pieces::NONE;
use crate::refine::refine_patiently;
use crate::regions::Regions;
use crate::surface::Kind;

/// Least cosine between the normals of a lone triangle and of the surface it lies on: at the pole of a
/// coarse sphere triangles meet at 60 degrees.
const LONE_TRIANGLE_COS: f64 = 0.2;
const PIECE_COS: f64 = 0.85;
/// Most vertices a fit looks at.
const MOST_POINTS: usize = 400;

/// A flat piece whose vertices lie on a curved surface is of its tessellation if it is no coarser: it is at most
/// so many times as far from the surface in its midst as the others are.
const LIKE_THE_OTHERS: f64 = 1.5;

/// Are the pieces of a plane steps of a curved surface, and not a flat on it, as at the end of a ball?
fn is_of_one_tessellation(view: View, curved: &Hypothesis, plane: &Hypothesis) -> bool {
    let sagitta = |pieces: &[u32]| view.sagitta(&curved.surface, pieces);
    sagitta(&plane.pieces) <= LIKE_THE_OTHERS * sagitta(&curved.pieces)
}

/// Gives regions and unowned pieces that lie on the surface of a larger neighbour to it, over walls too.
pub(crate) fn absorb(view: View, regions: &mut Regions, tolerance: f64) {
    let mut fitted = Vec::new();
    for _ in 0..5 {
        polish(view, regions, &mut fitted);
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
    let mut grown = BTreeSet::new();
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
            add(regions, large, gone.pieces);
            grown.insert(large);
            joined += 1;
        }
    }
    // Once each: a large one may take in many.
    for region in grown {
        weigh(view, regions, region);
    }
    joined
}

/// Layer by layer, the unowned pieces beside regions; gives how many joined.
fn absorb_pieces(view: View, regions: &mut Regions, tolerance: f64) -> usize {
    let mut joined: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let mut layer: Vec<u32> = (0..view.pieces.count() as u32).collect();
    while !layer.is_empty() {
        let takers: Vec<(u32, u32)> = layer
            .iter()
            .filter_map(|&piece| Some((taker(view, regions, piece, tolerance)?, piece)))
            .collect();
        layer.clear();
        for &(region, piece) in &takers {
            regions.owner[piece as usize] = region;
            joined.entry(region).or_default().push(piece);
            let links = view.pieces.around.row(piece).iter();
            layer.extend(links.map(|&link| view.pieces.links[link as usize].across(piece)));
        }
        layer.sort_unstable();
        layer.dedup();
    }
    let count = joined.values().map(Vec::len).sum();
    for (region, pieces) in joined {
        add(regions, region, pieces);
        weigh(view, regions, region);
    }
    count
}

/// The region with the longest common border among those on whose surface an unowned piece lies.
fn taker(view: View, regions: &Regions, piece: u32, tolerance: f64) -> Option<u32> {
    if regions.owner[piece as usize] != NONE || view.pieces.certain[piece as usize] {
        return None;
    }
    let lone = view.pieces.faces.row(piece).len() == 1;
    let cos = if lone { LONE_TRIANGLE_COS } else { PIECE_COS };
    let mut best: Option<(f64, u32)> = None;
    for &link in view.pieces.around.row(piece) {
        let link = &view.pieces.links[link as usize];
        let owner = regions.owner[link.across(piece) as usize];
        if owner == NONE || best.is_some_and(|(length, _)| link.length <= length) {
            continue;
        }
        let region = &regions.all[owner as usize];
        let tolerance = reach(region, tolerance);
        if view.fits_turned(piece, &region.surface, region.sign, tolerance, cos) {
            best = Some((link.length, owner));
        }
    }
    best.map(|(_, owner)| owner)
}

/// Gives pieces to a region, which is to be weighed afterwards.
fn add(regions: &mut Regions, region: u32, more: Vec<u32>) {
    for &piece in &more {
        regions.owner[piece as usize] = region;
    }
    regions.all[region as usize].pieces.extend(more);
}

fn weigh(view: View, regions: &mut Regions, region: u32) {
    let own = &mut regions.all[region as usize];
    let pieces = std::mem::take(&mut own.pieces);
    if !pieces.is_empty() {
        *own = view.weigh(own.surface, own.sign, pieces, own.tolerance);
    }
}

/// Fits surfaces once more to all that lies on them, those that changed since they were fitted last: what was
/// grown from a small neighbourhood errs far from it.
fn polish(view: View, regions: &mut Regions, fitted: &mut Vec<usize>) {
    fitted.resize(regions.all.len(), 0);
    for region in regions.alive().collect::<Vec<_>>() {
        let own = &regions.all[region as usize];
        let now = own.pieces.len();
        if own.surface.kind == Kind::Plane
            || std::mem::replace(&mut fitted[region as usize], now) == now
        {
            continue;
        }
        let points = view.some_points(&own.pieces, MOST_POINTS);
        if let Some(fit) = refine_patiently(own.surface, &points, 0.0) {
            let better = view.weigh(fit.surface, own.sign, own.pieces.clone(), own.tolerance);
            if better.exact && better.rms <= own.rms {
                regions.all[region as usize] = better;
            }
        }
    }
}
