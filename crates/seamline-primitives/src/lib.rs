//! Planes, cylinders, cones, spheres and tori, found exactly in the facets of a CAD tessellation.
//!
//! Vertices of a CAD export lie on the designed surface to the last bits of a float. So a hypothesis (this
//! plane, this cylinder) can be tested almost exactly, where curvature only hints.

mod absorb;
mod certain;
mod eigen;
mod crease_angles;
mod creases;
mod guess;
mod hypothesis;
mod linear;
mod parts;
mod pieces;
mod refine;
mod regions;
mod rows;
mod search;
mod select;
mod surface;
mod trust;

use glam::DVec3;
use seamline_mesh::Topology;

pub use surface::{Kind, Surface};

use hypothesis::{Hypothesis, View};
use parts::Form;
use pieces::{NONE, Pieces, Triangles};
use regions::Regions;
use search::Search;
use select::{borders_speak_for, select};

/// Distances, in diagonals of the bounding box, at which vertices still lie on a surface: the precision of an
/// export, then that of kernels which store an approximation.
const LADDER: [f64; 3] = [1e-6, 1e-5, 5e-5];

/// How flat the pieces are, as a share of the tolerance.
const FLAT: f64 = 0.3;
const FLAT2: f64 = 0.3;

/// A patch found.
#[derive(Clone, Debug)]
pub struct Patch {
    /// What it is; `None` for a free form.
    pub surface: Option<Surface>,
    pub evidence: i64,
    pub strong: bool,
    pub form: &'static str,
}

/// The patches of a mesh.
#[derive(Clone, Debug, Default)]
pub struct Partition {
    /// The patch of each face.
    pub of_face: Vec<u32>,
    /// One a patch.
    pub patches: Vec<Patch>,
    /// How many fits were made.
    pub fits: usize,
}

/// Finds the patches of a mesh.
pub fn find(positions: &[DVec3], topology: &Topology) -> Partition {
    let (centre, diagonal) = frame(positions, topology);
    let scaled: Vec<DVec3> = positions.iter().map(|&x| (x - centre) / diagonal).collect();
    let triangles = Triangles::of(&scaled, &topology.triangles);
    let mut fits = 0;
    let nothing = vec![NONE; triangles.areas.len()];
    let mut pieces = Pieces::find(&scaled, topology, &triangles, FLAT * LADDER[0], &nothing, 7);
    let mut regions = Regions::none(pieces.count());
    for (rung, &tolerance) in LADDER.iter().enumerate() {
        if rung > 0 {
            let settled = |&piece: &u32| {
                let taken = regions.owner[piece as usize] != NONE;
                if taken { piece } else { NONE }
            };
            let settled: Vec<u32> = pieces.of_face.iter().map(settled).collect();
            let flat = FLAT2 * tolerance;
            let next = Pieces::find(&scaled, topology, &triangles, flat, &settled, 25);

            regions = regions.moved(&pieces, &next);
            pieces = next;
        }
        let view = View {
            positions: &scaled,
            pieces: &pieces,
        };
        accept_planes(view, &mut regions, tolerance);
        climb(view, topology, &mut regions, rung, tolerance, &mut fits);
        absorb::absorb(view, &mut regions, tolerance);
    }
    let view = View {
        positions: &scaled,
        pieces: &pieces,
    };
    let trusted = trust::trusted(view, topology, &regions);
    {
        let whole: f64 = pieces.areas.iter().sum();
        let planes: f64 = (0..pieces.count()).filter(|&p| pieces.certain[p] && regions.owner[p] == NONE).map(|p| pieces.areas[p]).sum();
        let exact: f64 = regions.alive().filter(|&r| trusted[r as usize] && regions.all[r as usize].is_exact()).map(|r| view.area(&regions.all[r as usize].pieces)).sum();
        let near: f64 = regions.alive().filter(|&r| trusted[r as usize] && !regions.all[r as usize].is_exact()).map(|r| view.area(&regions.all[r as usize].pieces)).sum();
        eprintln!("planes {:.3} exact {:.3} near {:.3}", planes / whole, exact / whole, near / whole);
    }
    if let Ok(path) = std::env::var("DUMP") {
        let mut text = String::new();
        for region in regions.alive() {
            let h = &regions.all[region as usize];
            let vs = view.vertices_of(&h.pieces);
            let mut d: Vec<f64> = vs.iter().map(|&v| h.surface.distance(scaled[v as usize]).abs()).collect();
            d.sort_by(f64::total_cmp);
            let rms = (d.iter().map(|x| x * x).sum::<f64>() / d.len() as f64).sqrt();
            let n = trust::shares(view, topology, &regions, &trusted, region);
            let f: Vec<String> = h.pieces.iter().flat_map(|&p| pieces.faces.row(p)).map(|f| f.to_string()).collect();
            text += &format!("{:?} {} {} {:e} {:e} {:e} {} {:.3} {:.3} {:.5} {:.5} {} {}\n", h.surface.kind, h.evidence, h.strong, rms, d[d.len()-1], h.tolerance, trusted[region as usize], n.0, n.1, h.surface.a, h.surface.b, h.pieces.len(), f.join(","));
        }
        std::fs::write(path, text).unwrap();
    }
    let doubtful: Vec<u32> = regions.alive().filter(|&r| !trusted[r as usize]).collect();
    for region in doubtful {
        regions.dissolve(region);
    }
    let mut parts = parts::parts(view, topology, &regions, LADDER[0]);
    parts::join_islands(view, &regions, &mut parts);
    let mut of_face: Vec<u32> = pieces
        .of_face
        .iter()
        .map(|&p| parts.of_piece[p as usize])
        .collect();
    creases::split(&scaled, topology, &triangles, &parts.forms, &mut of_face);
    Partition {
        of_face,
        patches: parts
            .forms
            .iter()
            .map(|form| Patch {
                surface: match form {
                    Form::Surface(region) => Some(regions.all[*region as usize].surface),
                    _ => None,
                },
                evidence: match form {
                    Form::Surface(region) => regions.all[*region as usize].evidence,
                    _ => 0,
                },
                strong: match form {
                    Form::Surface(region) => regions.all[*region as usize].strong,
                    _ => false,
                },
                form: if *form == Form::Plane { "Plane" } else { "Free" },
            })
            .collect(),
        fits,
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
    ((low + high) / 2.0, (high - low).length())
}

/// Accepts the pieces that are planes whatever lies beside them.
fn accept_planes(view: View, regions: &mut Regions, tolerance: f64) {
    for piece in 0..view.pieces.count() as u32 {
        if view.pieces.certain[piece as usize] && regions.owner[piece as usize] == NONE {
            let plane = Surface {
                kind: Kind::Plane,
                point: view.pieces.centroids[piece as usize],
                axis: view.pieces.normals[piece as usize],
                a: 0.0,
                b: 0.0,
            };
            regions.accept(view.weigh(plane, 1.0, vec![piece], tolerance));
        }
    }
}

/// One rung of the ladder of tolerances.
fn climb(
    view: View,
    topology: &Topology,
    regions: &mut Regions,
    rung: usize,
    tolerance: f64,
    fits: &mut usize,
) {
    let freed = if rung == 0 {
        Vec::new()
    } else {
        let trusted = trust::trusted(view, topology, regions);
        let doubtful: Vec<u32> = regions
            .alive()
            .filter(|&r| !trusted[r as usize] && regions.all[r as usize].evidence < 120)
            .collect();
        doubtful.into_iter().map(|r| regions.dissolve(r)).collect()
    };
    let open: Vec<bool> = (0..view.pieces.count())
        .map(|p| regions.owner[p] == NONE)
        .collect();
    let mut search = Search::new(view, &open, tolerance, 1);
    let found = search.run();
    *fits += search.fits;
    let least = |kind: Kind| match (rung, kind) {
        (0, _) => 1,
        (1, Kind::Cylinder) => 16,
        (1, _) => 40,
        _ => 100,
    };
    let enough = |h: &Hypothesis| {
        h.strong && (rung > 0 || h.is_exact()) && h.evidence >= least(h.surface.kind)
    };
    let mut rest = select(view, regions, found, tolerance, |_, h| enough(h));
    if rung == 0 {
        for _ in 0..3 {
            let before = regions.all.len();
            rest = select(view, regions, rest, tolerance, |regions, h| {
                borders_speak_for(view, topology, regions, h)
            });
            if regions.all.len() == before {
                break;
            }
        }
    }
    for hypothesis in freed {
        let left: Vec<u32> = hypothesis
            .pieces
            .iter()
            .copied()
            .filter(|&p| regions.owner[p as usize] == NONE)
            .collect();
        if 2 * left.len() > hypothesis.pieces.len() {
            let back = view.weigh(hypothesis.surface, hypothesis.sign, left, tolerance);
            regions.accept(back);
        }
    }
}

