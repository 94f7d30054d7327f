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
use crate::whole::whole;

/// Most vertices the last fit looks at.
const MOST_POINTS: usize = 2000;

/// Evidence below which a surface is told as the simplest its vertices lie on.
const LITTLE_EVIDENCE: i64 = 10;
/// How much farther from a simpler surface vertices may lie.
const AS_WELL: f64 = 1.2;

/// The surface of each patch, of which the part is given.
pub(crate) fn surfaces(
    view: View,
    regions: &Regions,
    parts: &Parts,
    part_of: &[u32],
    tolerance: f64,
) -> Vec<Option<Fitted>> {
    let pieces_of = parts.pieces();
    let of_part = |part: u32| match parts.forms.get(part as usize) {
        Some(Form::Surface(region)) => {
            let region = &regions.all[*region as usize];
            // What proves little is told as the simplest it may be.
            let simplest = (!region.strong || region.evidence < LITTLE_EVIDENCE)
                .then(|| whole(view, regions, &region.pieces, tolerance))
                .flatten();
            Some(fitted(view, simplest.as_ref().unwrap_or(region)))
        }
        Some(Form::Plane) => Some(plane(view, pieces_of[part as usize][0])),
        Some(Form::Free) => whole(view, regions, &pieces_of[part as usize], tolerance)
            .map(|found| fitted(view, &found)),
        // Creases cut free forms, and number them beyond the parts.
        None => None,
    };
    part_of.par_iter().map(|&part| of_part(part)).collect()
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

fn fitted(view: View, region: &Hypothesis) -> Fitted {
    let vertices = view.vertices_of(&region.pieces);
    let points: Vec<DVec3> = vertices
        .iter()
        .map(|&v| view.ground.positions[v as usize])
        .collect();
    let few: Vec<DVec3> = a_few(&points, MOST_POINTS).copied().collect();
    let rms = |surface: &Surface| surface.rms(&points);
    let again = refine_patiently(region.surface, &few, 0.0).map(|fit| fit.surface);
    let mut surface = again
        .filter(|surface| rms(surface) <= rms(&region.surface))
        .unwrap_or(region.surface);
    // A cone that a cylinder explains as well is one.
    if surface.kind == Kind::Cone {
        let straight = Surface {
            kind: Kind::Cylinder,
            b: 0.0,
            ..surface
        };
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
