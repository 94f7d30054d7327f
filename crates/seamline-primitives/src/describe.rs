//! What is told of patches: the surface of each, fitted to all its vertices once more.

use glam::DVec3;
use rayon::prelude::*;

use crate::Fitted;
use crate::few::a_few;
use crate::hypothesis::{Hypothesis, View};
use crate::parts::{Form, Parts};
use crate::refine::refine_patiently;
use crate::regions::Regions;
use crate::surface::{Kind, Surface};
use crate::whole::{told, whole};

/// Most vertices the last fit looks at.
const MOST_POINTS: usize = 2000;

/// Evidence below which a surface is told as the simplest its vertices lie on. With 10 chamfers of a hole are told as
/// cylinders that lean (178 types wrong of 9,160 patches in 229 meshes, 120 with this), 100 finds one more.
const LITTLE_EVIDENCE: i64 = 40;
/// How much farther from a simpler surface vertices may lie.
const AS_WELL: f64 = 1.2;

/// The surface of each patch. Given are the patch of each face, the part of each patch, and two tolerances: of what is
/// exact, and of what is near.
pub(crate) fn surfaces(
    view: View,
    regions: &Regions,
    parts: &Parts,
    (of_face, part_of): (&[u32], &[u32]),
    tolerances: [f64; 2],
) -> Vec<Option<Fitted>> {
    let pieces_of = parts.pieces();
    // Creases cut free forms, and number them beyond the parts.
    let cut = pieces_of_patches(view, of_face, part_of.len());
    let told = |pieces| {
        let found = told(view, regions, pieces, tolerances);
        found.map(|found| as_it_is(view, &found))
    };
    let of_patch = |(patch, &part): (usize, &u32)| match parts.forms.get(part as usize) {
        Some(Form::Surface(region)) => {
            let region = &regions.all[*region as usize];
            // What proves little is told as the simplest it may be.
            let simplest = (!region.strong || region.evidence < LITTLE_EVIDENCE)
                .then(|| whole(view, regions, &region.pieces, tolerances[0]))
                .flatten();
            Some(match simplest {
                Some(simplest) => as_it_is(view, &simplest),
                None => fitted(view, region),
            })
        }
        Some(Form::Plane) => Some(plane(view, pieces_of[part as usize][0])),
        Some(Form::Free) => told(&pieces_of[part as usize]),
        None => told(&cut[patch]),
    };
    part_of.par_iter().enumerate().map(of_patch).collect()
}

/// The pieces of each patch; none of a patch whose border, a crease, runs through a piece.
fn pieces_of_patches(view: View, of_face: &[u32], count: usize) -> Vec<Vec<u32>> {
    let mut pieces_of = vec![Vec::new(); count];
    let mut torn = Vec::new();
    for piece in 0..view.pieces.count() as u32 {
        let faces = view.pieces.faces.row(piece).iter();
        let patches = faces.map(|&face| of_face[face as usize]);
        let first = of_face[view.pieces.faces.row(piece)[0] as usize];
        if patches.clone().all(|patch| patch == first) {
            pieces_of[first as usize].push(piece);
        } else {
            torn.extend(patches);
        }
    }
    for patch in torn {
        pieces_of[patch as usize].clear();
    }
    pieces_of
}

fn plane(view: View, piece: u32) -> Fitted {
    fitted(
        view,
        &view.weigh(
            view.plane_of(piece),
            1.0,
            vec![piece],
            view.ground.precision,
        ),
    )
}

/// A region's surface, fitted to all its vertices once more.
fn fitted(view: View, region: &Hypothesis) -> Fitted {
    let points = points(view, region);
    let few: Vec<DVec3> = a_few(&points, MOST_POINTS).copied().collect();
    let again = refine_patiently(region.surface, &few, 0.0).map(|fit| fit.surface);
    let surface = again
        .filter(|surface| surface.rms(&points) <= region.surface.rms(&points))
        .unwrap_or(region.surface);
    described(view, region, surface, &points)
}

/// A surface that fits as it is.
fn as_it_is(view: View, found: &Hypothesis) -> Fitted {
    described(view, found, found.surface, &points(view, found))
}

fn points(view: View, region: &Hypothesis) -> Vec<DVec3> {
    let vertices = view.vertices_of(&region.pieces).into_iter();
    vertices
        .map(|v| view.ground.positions[v as usize])
        .collect()
}

/// What is told of the surface of a region's vertices. A cone that a cylinder explains as well is one.
fn described(view: View, region: &Hypothesis, mut surface: Surface, points: &[DVec3]) -> Fitted {
    let rms = |surface: &Surface| surface.rms(points);
    if surface.kind == Kind::Cone {
        let straight = Surface {
            kind: Kind::Cylinder,
            b: 0.0,
            ..surface
        };
        let few: Vec<DVec3> = a_few(points, MOST_POINTS).copied().collect();
        let explains = |s: &Surface| rms(s) <= view.ground.precision.max(AS_WELL * rms(&surface));
        surface = refine_patiently(straight, &few, 0.0)
            .map(|fit| fit.surface)
            .filter(explains)
            .unwrap_or(surface);
    }
    let residual = rms(&surface);
    Fitted {
        surface: surface.with_positive_radii(),
        convex: region.sign > 0.0,
        residual,
        exact: residual <= view.ground.precision,
        evidence: region.evidence.max(0) as u32,
    }
}

impl Fitted {
    /// In coordinates `x * scale + centre`.
    pub(crate) fn moved(self, centre: DVec3, scale: f64) -> Self {
        let mut surface = Surface {
            point: self.surface.point * scale + centre,
            a: self.surface.a * scale,
            ..self.surface
        };
        if surface.kind == Kind::Torus {
            surface.b *= scale;
        }
        Self {
            surface,
            residual: self.residual * scale,
            ..self
        }
    }
}
