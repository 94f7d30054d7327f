//! Natural borders: a false surface fits as exactly as a true one; it differs in where it ends.

use seamline_mesh::Topology;

use crate::hypothesis::View;
use crate::pieces::NONE;
use crate::regions::{Ending, Regions};
use crate::surface::Kind;

/// Evidence from which no border is asked of a surface its vertices lie on exactly.
const ENOUGH_IF_EXACT: i64 = 5;
/// Evidence below which walls do not count: each tile of a narrow band between two walls has walls on most of
/// its border.
const SMALL: i64 = 25;
/// Evidence below which almost the whole border must be natural.
const TINY: i64 = 8;
/// How many times larger than a region's pieces on average a flat beside it is at least.
const MUCH_LARGER: f64 = 2.0;
const NATURAL_SHARE: f64 = 0.5;
const NATURAL_SHARE_OF_TINY: f64 = 0.9;

/// Which regions can be trusted, one a region.
pub(crate) fn trusted(view: View, topology: &Topology, regions: &Regions) -> Vec<bool> {
    let mut trusted = vec![false; regions.all.len()];
    while spread(view, topology, regions, &mut trusted) {}
    trusted
}

/// One round over the regions not yet trusted. True if any was.
fn spread(view: View, topology: &Topology, regions: &Regions, trusted: &mut [bool]) -> bool {
    let mut any = false;
    for region in regions.alive() {
        if !trusted[region as usize] && is_natural(view, topology, regions, trusted, region) {
            trusted[region as usize] = true;
            any = true;
        }
    }
    any
}

fn is_natural(
    view: View,
    topology: &Topology,
    regions: &Regions,
    trusted: &[bool],
    region: u32,
) -> bool {
    let own = &regions.all[region as usize];
    let exact = own.strong && own.exact && own.evidence >= ENOUGH_IF_EXACT;
    if own.surface.kind == Kind::Plane || exact {
        return true;
    }
    if own.strong && own.evidence >= LARGE && ends_abruptly(view, regions, region) {
        return true;
    }
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
                        && regions.ending(view, topology, own, piece, link) == Ending::Tangent
            } else {
                let both_small =
                    own.evidence < SMALL && regions.all[owner as usize].evidence < SMALL;
                trusted[owner as usize]
                    && !both_small
                    && (own.exact || regions.all[owner as usize].exact)
            };
            if speaks {
                natural += at.length;
            }
        }
    }
    if whole - walls <= 0.0 {
        return true;
    }
    let share = if own.evidence < SMALL {
        natural / (whole - walls)
    } else {
        (walls + natural) / whole
    };
    let least = if own.evidence < TINY {
        NATURAL_SHARE_OF_TINY
    } else {
        NATURAL_SHARE
    };
    share >= least
}

/// Evidence from which an abrupt end is asked of a surface: a small one has hardly begun to leave it.
const LARGE: i64 = 100;
/// Share of its border along which a surface ends abruptly, if it is one.
const ABRUPT_SHARE: f64 = 0.75;
/// What lies beside the end of a surface lies at least so many tolerances off it.
const ABRUPT: f64 = 25.0;

/// Does a region that only comes near its surface end as surfaces do? A true one ends at walls, or where the
/// next piece lies far off it; a free form leaves the surface it came near by and by.
fn ends_abruptly(view: View, regions: &Regions, region: u32) -> bool {
    let own = &regions.all[region as usize];
    let [mut abrupt, mut whole] = [0.0; 2];
    for &piece in &own.pieces {
        for &link in view.pieces.around.row(piece) {
            let at = &view.pieces.links[link as usize];
            let across = at.across(piece);
            if regions.owner[across as usize] == region {
                continue;
            }
            whole += at.length;
            let farthest = || {
                let vertices = view.pieces.vertices.row(across).iter();
                vertices
                    .map(|&v| own.surface.distance(view.positions[v as usize]).abs())
                    .fold(0.0, f64::max)
            };
            if at.wall || farthest() >= ABRUPT * own.tolerance {
                abrupt += at.length;
            }
        }
    }
    abrupt >= ABRUPT_SHARE * whole
}
