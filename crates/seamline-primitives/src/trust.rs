//! Natural borders: a false surface fits as exactly as a true one; it differs in where it ends.

use crate::hypothesis::{Hypothesis, View};
use crate::pieces::NONE;
use crate::regions::{Ending, Regions};
use crate::surface::Kind;

/// Evidence from which no border is asked of a surface its vertices lie on exactly.
const ENOUGH_IF_EXACT: i64 = 5;
/// Two regions of less evidence do not vouch for each other.
const SMALL: i64 = 25;
/// Evidence below which almost the whole border must be natural.
const TINY: i64 = 8;
/// How many times larger than a region's pieces on average a flat beside it is at least.
const MUCH_LARGER: f64 = 2.0;
const NATURAL_SHARE: f64 = 0.5;
const NATURAL_SHARE_OF_TINY: f64 = 0.9;
/// Evidence from which an abrupt end speaks for a surface: a small one has hardly begun to leave it.
const GONE_FAR: i64 = 50;
/// What lies beside an abrupt end lies at least so many root mean squares of the region's own vertices off it: half as many
/// are as good, twice as many lose true cylinders of 50 vertices.
const ABRUPT: f64 = 700.0;
/// The same where vertices are noisy, as a share of the diagonal: a multiple of the noise, of which residuals are there,
/// does worse from 1 % of the mean edge on.
const FAR_IN_NOISE: f64 = 1e-3;

/// Which regions can be trusted, one a region.
pub(crate) fn trusted(view: View, regions: &Regions) -> Vec<bool> {
    let mut trusted = vec![false; regions.all.len()];
    while spread(view, regions, &mut trusted) {}
    trusted
}

/// One round over the regions not yet trusted. True if any was.
fn spread(view: View, regions: &Regions, trusted: &mut [bool]) -> bool {
    let mut any = false;
    for region in regions.alive() {
        if !trusted[region as usize] && is_natural(view, regions, trusted, region) {
            trusted[region as usize] = true;
            any = true;
        }
    }
    any
}

/// Is enough of a region's border natural? Walls say nothing: each tile of a narrow band between two walls has walls
/// on most of its border.
fn is_natural(view: View, regions: &Regions, trusted: &[bool], region: u32) -> bool {
    let own = &regions.all[region as usize];
    let exact = own.strong && own.exact && own.evidence >= ENOUGH_IF_EXACT;
    if own.surface.kind == Kind::Plane || exact {
        return true;
    }
    let far = own.strong && own.evidence >= GONE_FAR;
    let flat = MUCH_LARGER * view.area(&own.pieces) / own.pieces.len() as f64;
    let [mut walls, mut natural, mut whole] = [0.0; 3];
    for &piece in &own.pieces {
        for &link in view.pieces.around.row(piece) {
            let at = &view.pieces.links[link as usize];
            let across = at.across(piece);
            let owner = regions.owner[across as usize];
            if owner == region {
                continue;
            }
            whole += at.length;
            if at.wall {
                walls += at.length;
                continue;
            }
            let speaks = if owner == NONE {
                // On a dense free form every next piece lies in the tangent plane: a flat is larger.
                view.pieces.certain[across as usize]
                    || (own.exact || view.pieces.areas[across as usize] >= flat)
                        && regions.ending(view, own, piece, link) == Ending::Tangent
            } else {
                let both_small =
                    own.evidence < SMALL && regions.all[owner as usize].evidence < SMALL;
                trusted[owner as usize]
                    && !both_small
                    && (own.exact || regions.all[owner as usize].exact)
            };
            if speaks || far && ends_abruptly(view, own, across) {
                natural += at.length;
            }
        }
    }
    if whole - walls <= 0.0 {
        return true;
    }
    let least = if own.evidence < TINY {
        NATURAL_SHARE_OF_TINY
    } else {
        NATURAL_SHARE
    };
    natural >= least * (whole - walls)
}

/// Does a region end here as surfaces do, with what comes next far off it? A free form leaves the surface it came near
/// by and by.
fn ends_abruptly(view: View, region: &Hypothesis, across: u32) -> bool {
    let far = if view.ground.noise > 0.0 {
        FAR_IN_NOISE
    } else {
        ABRUPT * region.rms
    };
    let mut vertices = view.pieces.vertices.row(across).iter();
    vertices.any(|&v| {
        region
            .surface
            .distance(view.ground.positions[v as usize])
            .abs()
            >= far
    })
}
