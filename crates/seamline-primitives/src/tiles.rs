//! Where vertices are noisy: flat pieces of a curved surface that were taken for planes.
//!
//! Noise hides that a strip of a cylinder bends, and a plane is the surface that needs least to be proved. Such planes
//! lie beside each other as tiles do, with no crease between; where one is set free, a surface that takes in several
//! can be found on the next rung, and what none takes in is flat still.

use crate::hypothesis::View;
use crate::pieces::NONE;
use crate::regions::Regions;
use crate::surface::Kind;

/// Evidence from which a plane is no tile.
const LARGE: i64 = 60;
/// Share of a tile's border, at least, across which the mesh goes on smoothly to other tiles or to what no surface
/// explains.
const SMOOTH_SHARE: f64 = 0.3;

/// Dissolves planes that are tiles of something curved: all that are before any of them is.
pub(crate) fn dissolve(view: View, regions: &mut Regions) {
    let tiles: Vec<u32> = regions
        .alive()
        .filter(|&region| is_tile(view, regions, region))
        .collect();
    for tile in tiles {
        regions.dissolve(tile);
    }
}

/// Is a region a small plane that goes on to others without a crease?
fn is_tile(view: View, regions: &Regions, region: u32) -> bool {
    let small_plane = |r: u32| {
        let region = &regions.all[r as usize];
        region.surface.kind == Kind::Plane && region.evidence < LARGE
    };
    if !small_plane(region) {
        return false;
    }
    let [mut smooth, mut whole] = [0.0; 2];
    for &piece in &regions.all[region as usize].pieces {
        for &link in view.pieces.around.row(piece) {
            let link = &view.pieces.links[link as usize];
            let owner = regions.owner[link.across(piece) as usize];
            if owner == region {
                continue;
            }
            whole += link.length;
            if !link.wall && (owner == NONE || small_plane(owner)) {
                smooth += link.length;
            }
        }
    }
    smooth > SMOOTH_SHARE * whole
}
