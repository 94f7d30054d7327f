//! Planes, cylinders, cones, spheres and tori, found exactly in the facets of a CAD tessellation.
//!
//! Vertices of a CAD export lie on the designed surface to the last bits of a float. So a hypothesis (this
//! plane, this cylinder) can be tested almost exactly, where curvature only hints. [`find`] goes these steps:
//!
//! 1. `pieces`: triangles in one plane become flat pieces; angles above 40 degrees between them are walls that
//!    no surface crosses. Pieces of many vertices in more than two lines are planes beyond doubt (`certain`).
//! 2. `search`: round each piece not yet explained (`scout`), surfaces are fitted to neighbourhoods (`around`, `look`)
//!    from guesses (`guess`, `refine`, `freedom`) and grown as far as they hold (`grow`, `hypothesis`); cylinders of one
//!    radius beside each other may be strips of one torus (`bends`).
//! 3. `select`: the best proved goes first. Vertices along one ruling or one circle prove nothing, and a free form
//!    comes near many surfaces: what is weak must be spoken for by its borders.
//! 4. The same again with looser tolerances, for kernels that store approximations; small leftovers are taken in
//!    (`absorb`).
//! 5. `trust`: a surface on which its vertices lie exactly is believed; one they come near only where it ends
//!    as surfaces do. What is left is one surface as a whole (`whole`), or none.
//! 6. `parts`: what no surface explains is united to free forms, and these are cut (`creases`) along chains of edges that
//!    go straighter on than chance and what is beside them let them (`chains`, `fans`), where the surface itself turns and
//!    not the tessellation only (`crease_angles`), or anywhere if chance is hardly possible. In noise, along paths
//!    (`crease_paths`). Pieces too alike or too small are united again (`crease_pieces`).
//! 7. `describe`: each surface is fitted once more to all its vertices, and what was designed equal comes out equal
//!    (`snap`).
//!
//! Where nothing is exact, the `noise` of the vertices is estimated and the same is done with it as the precision;
//! patches then compete for the faces between them (`relax`). Unless the vertices do not scatter about the quadric
//! (`heights`) through those about them (`scatter`, `neighbourhoods`): then they are not noisy. Where that explains
//! little, and quartics leave hardly anything of what quadrics do (`smooth`), all is free form.
//!
//! Nothing here knows how a part lies: results do not change when it is turned, moved or scaled, but for ties.
//! All lengths inside are in diagonals of the bounding box. Thresholds were chosen on CAD meshes with ground truth;
//! each says what it is for.

// In small matrices indices are the mathematics.
#![allow(clippy::needless_range_loop)]

mod absorb;
mod around;
mod bends;
mod certain;
mod chains;
mod climb;
mod crease_angles;
mod crease_paths;
mod crease_pieces;
mod creases;
mod describe;
mod eigen;
mod fans;
mod few;
mod flat;
mod freedom;
mod ground;
mod grow;
mod guess;
mod heights;
mod hypothesis;
mod linear;
mod links;
mod look;
mod neighbourhoods;
mod noise;
mod parts;
mod patches;
mod pieces;
mod refine;
mod regions;
mod relax;
mod rows;
mod scatter;
mod scout;
mod search;
mod seeds;
mod select;
mod smooth;
mod snap;
mod surface;
mod tiles;
mod triangles;
mod tried;
mod trust;
mod unite;
mod whole;

use glam::DVec3;
use seamline_mesh::Topology;

pub use surface::{Kind, Surface};

use climb::{PLANE_VERTICES, climb, recut};
use ground::Ground;
use hypothesis::View;
use parts::Parts;
use patches::{Patches, connected};
use pieces::{NONE, Pieces};
use regions::Regions;
use triangles::Triangles;

/// Distances, in diagonals of the bounding box, at which vertices still lie on a surface: that of an export
/// in single precision, then those of kernels which store an approximation.
const LADDER: [f64; 3] = [1e-6, 1e-5, 5e-5];
/// The last rung of it.
const LOOSEST: usize = LADDER.len() - 1;

/// Root mean square distance, in diagonals, of vertices stored in single precision from the surface they were
/// put on: 1e-8 to 2e-8 in exports about the origin, 1e-7 and more in surfaces that only come near.
const PRECISION: f64 = 5e-8;

/// Root mean square of what single precision takes from a coordinate, as a share of it.
const ROUNDING: f64 = 0.29 * f32::EPSILON as f64;

/// Root mean square distance, in standard deviations of the noise, of vertices that lie on a surface but for noise.
const EXACT_DEVIATIONS: f64 = 1.5;
/// How often surfaces are looked for again with less noise, at most.
const LOOKED_AGAIN: usize = 2;
/// By how much the noise must have been taken too large for that.
const MUCH_LESS: f64 = 0.6;

/// Exact share of the area below which no more is looked for: vertices are noisy, or nothing was designed.
const HARDLY_ANYTHING: f64 = 0.005;

/// Exact share of the area from which surfaces explain a mesh of noisy vertices. Natural shapes have .02 to .11, for the
/// noise is guessed from them; of the bench's fine and uniform meshes with noise of .1 % of their mean edge the least has
/// .24.
pub const LEAST_EXACT_OF_NOISY: f64 = 0.15;

/// Fewest vertices of a piece between walls that is told to be a plane: three always lie in one.
const LEAST_PLANE: usize = 4;

/// A surface with its evidence. Lengths are in the mesh's own unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// Where and what it is.
    pub surface: Surface,
    /// Does the surface bend away from the outside, as an outer cylinder does? A hole and an inner fillet do
    /// not. No meaning for a plane, whose normal points outside.
    pub convex: bool,
    /// Root mean square distance of the patch's vertices.
    pub residual: f64,
    /// Do the vertices lie on it as exactly as they are stored?
    pub exact: bool,
    /// Distinct vertices less degrees of freedom.
    pub evidence: u32,
}

/// The patches of a mesh.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// The patch of each face; numbers from 0.
    pub of_face: Vec<u32>,
    /// One a patch: its surface, `None` for a free form.
    pub surfaces: Vec<Option<Fitted>>,
    /// Share of the area that lies exactly on surfaces of sufficient evidence: near 0 where vertices are noisy
    /// or nothing is designed of such surfaces.
    pub exact_share: f64,
    /// Standard deviation of each coordinate of the vertices from where they were designed; 0 where they are as
    /// exact as they are stored, and where no noise was made out.
    pub noise: f64,
    /// Do the vertices lie on smooth surfaces, though hardly one of them on any of those above?
    pub smooth: bool,
}

/// Finds the patches of a mesh.
///
/// Faces must be between vertices of `positions`; faces without area belong to a neighbour or to themselves.
/// Nothing is found in a mesh without extent: one patch a connected piece then.
///
/// `farthest` is the greatest coordinate in size the mesh was stored with, in the unit of `positions`: single
/// precision is coarser far from the origin.
pub fn find(positions: &[DVec3], topology: &Topology, farthest: f64) -> Found {
    let (centre, diagonal) = frame(positions, topology);
    let scaled: Vec<DVec3> = positions.iter().map(|&x| (x - centre) / diagonal).collect();
    let triangles = Triangles::of(&scaled, &topology.triangles);
    let ground = Ground {
        precision: PRECISION.hypot(ROUNDING * farthest / diagonal),
        noise: 0.0,
        positions: &scaled,
        triangles: &triangles,
        topology,
    };
    let mut found = look(ground);
    if found.exact_share < HARDLY_ANYTHING {
        let noisy = through_noise(ground);
        let explains = |noisy: &Found| noisy.exact_share >= LEAST_EXACT_OF_NOISY;
        found = if !noisy.as_ref().is_some_and(explains) && smooth::is_smooth(ground) {
            // Either is as large as what comes.
            drop((noisy, found));
            free_forms(ground)
        } else {
            noisy.unwrap_or(found)
        };
    }
    for fitted in found.surfaces.iter_mut().flatten() {
        *fitted = fitted.moved(centre, diagonal);
    }
    found.noise *= diagonal;
    found
}

/// The same where vertices are noisy. `None` where they are not, or there is no telling how noisy.
fn through_noise(stored: Ground) -> Option<Found> {
    // Less than what storing them takes away cannot be told from it.
    let with = |noise: f64| {
        let noise = noise.max(stored.precision);
        Ground {
            precision: EXACT_DEVIATIONS * noise,
            noise,
            ..stored
        }
    };
    let mut ground = with(noise::standard_deviation(
        stored.positions,
        stored.topology,
        stored.triangles,
    )?);
    let mut found = look(ground);
    for _ in 0..LOOKED_AGAIN {
        // What flat pairs of triangles are off a plane may be design; what vertices are off large surfaces is not.
        match noise::residual_of_most(&found.surfaces) {
            Some(less) if less < MUCH_LESS * ground.noise => ground = with(less),
            _ => break,
        }
        found = look(ground);
    }
    if !scatter::is_noise(ground) {
        return None;
    }
    let mut patches = Patches {
        of_face: found.of_face,
        surfaces: found.surfaces,
    };
    relax::relax(ground, &mut patches);
    let mut patches = patches.connected(ground.topology);
    relax::weigh_all(ground, &mut patches);
    Some(Found {
        of_face: patches.of_face,
        surfaces: patches.surfaces,
        exact_share: found.exact_share,
        noise: ground.noise,
        smooth: false,
    })
}

/// The ladder of tolerances, none below the precision of the ground.
fn ladder(ground: Ground) -> [f64; 3] {
    LADDER.map(|tolerance| tolerance.max(6.0 * ground.precision))
}

/// Finds the patches of a mesh whose vertices lie on its surfaces up to the precision of the ground.
fn look(ground: Ground) -> Found {
    let ladder = ladder(ground);
    let (pieces, mut regions) = climb(ground, ladder);
    let exact_share = exact_share(ground.seen(&pieces), &regions);
    if exact_share < HARDLY_ANYTHING {
        return nothing_exact(ground.topology);
    }
    let trusted = trust::trusted(ground.seen(&pieces), &regions);
    let doubtful: Vec<u32> = regions.alive().filter(|&r| !trusted[r as usize]).collect();
    for region in doubtful {
        regions.dissolve(region);
    }
    // What is free now may lie on a neighbour, and triangles of two neighbours in one plane by chance.
    let mut all = 0..pieces.count() as u32;
    let pieces = if all.any(|p| regions.owner[p as usize] == NONE && pieces.faces.row(p).len() > 1)
    {
        let flat = ground.precision;
        recut(ground, flat, PLANE_VERTICES[0], pieces, &mut regions)
    } else {
        pieces
    };
    let view = ground.seen(&pieces);
    absorb::absorb(view, &mut regions, ladder[0]);
    let mut parts = parts::parts(view, &regions, ladder[0]);
    if whole::accept_wholes(view, &mut regions, &parts, ladder[0]) {
        absorb::absorb(view, &mut regions, ladder[0]);
        parts = parts::parts(view, &regions, ladder[0]);
    }
    Found {
        exact_share,
        ..cut(view, &regions, parts, ladder)
    }
}

/// The patches of a mesh of free forms only.
fn free_forms(ground: Ground) -> Found {
    let mut regions = Regions::default();
    let nothing = Pieces::default();
    let flat = ground.precision;
    let pieces = recut(ground, flat, PLANE_VERTICES[0], nothing, &mut regions);
    let view = ground.seen(&pieces);
    Found {
        smooth: true,
        ..cut(view, &regions, parts::free(view, &regions), ladder(ground))
    }
}

/// Cuts the free forms among parts, and tells what each patch is.
fn cut(view: View, regions: &Regions, mut parts: Parts, ladder: [f64; 3]) -> Found {
    let View { ground, pieces } = view;
    parts::join_islands(view, regions, &mut parts);
    let mut of_face: Vec<u32> = pieces
        .of_face
        .iter()
        .map(|&p| parts.of_piece[p as usize])
        .collect();
    creases::split(ground, &parts.forms, &mut of_face);
    let (of_face, part_of) = connected(ground.topology, &of_face);
    let mut patches = Patches {
        surfaces: describe::surfaces(
            view,
            regions,
            &parts,
            (&of_face, &part_of),
            [ladder[0], ladder[1]],
        ),
        of_face,
    };
    let points = patches.points(ground.positions, ground.topology);
    snap::snap(&mut patches.surfaces, &points, ground.precision);
    Found {
        of_face: patches.of_face,
        surfaces: patches.surfaces,
        noise: ground.noise,
        ..Found::default()
    }
}

/// Share of the area that regions take on which their vertices lie exactly, or planes between walls.
fn exact_share(view: View, regions: &Regions) -> f64 {
    let exact = regions.alive().filter(|&r| regions.all[r as usize].exact);
    let exact: f64 = exact
        .map(|r| view.area(&regions.all[r as usize].pieces))
        .sum();
    let by_itself = |&piece: &u32| {
        regions.owner[piece as usize] == NONE
            && view.pieces.vertices.row(piece).len() >= LEAST_PLANE
            && view.pieces.smooth_links(piece).next().is_none()
            && view.is_flat(piece, view.ground.precision)
    };
    let planes = (0..view.pieces.count() as u32).filter(by_itself);
    let planes: f64 = planes.map(|p| view.pieces.areas[p as usize]).sum();
    let whole: f64 = view.pieces.areas.iter().sum();
    if whole > 0.0 {
        (exact + planes) / whole
    } else {
        0.0
    }
}

/// Where next to nothing is exact, nothing is said: one patch a connected piece.
fn nothing_exact(topology: &Topology) -> Found {
    let (of_face, part_of) = connected(topology, &vec![0; topology.triangles.len()]);
    Found {
        of_face,
        surfaces: vec![None; part_of.len()],
        ..Found::default()
    }
}

/// Centre and diagonal of the box of the used vertices.
fn frame(positions: &[DVec3], topology: &Topology) -> (DVec3, f64) {
    let used = topology.triangles.as_flattened().iter();
    let (low, high) = used
        .map(|&v| positions[v as usize])
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
    let diagonal = (high - low).length();
    if diagonal > 0.0 && diagonal.is_finite() {
        ((low + high) / 2.0, diagonal)
    } else {
        (DVec3::ZERO, 1.0)
    }
}
