//! Parts that were taken for free forms, and are one surface as a whole.

use glam::DVec3;
use rayon::prelude::*;

use crate::few::a_few;
use crate::guess::{cone_about, guesses};
use crate::hypothesis::{Hypothesis, View};
use crate::parts::{Form, Parts};
use crate::pieces::NONE;
use crate::refine::refine_patiently;
use crate::regions::Regions;
use crate::surface::{Kind, Surface};

/// Sine of the angle up to which two directions are one.
const SAME_DIRECTION: f64 = 1e-6;
/// Most directions beside a part that are tried.
const MOST_AXES: usize = 8;
/// Most vertices a fit looks at.
const MOST_POINTS: usize = 2000;

/// Accepts the free forms that prove to be of one surface as a whole. True if there was any.
pub(crate) fn accept_wholes(
    view: View,
    regions: &mut Regions,
    parts: &Parts,
    tolerance: f64,
) -> bool {
    let pieces_of = parts.pieces();
    let seen: &Regions = regions;
    let found: Vec<Hypothesis> = pieces_of
        .par_iter()
        .zip(&parts.forms)
        .filter(|(_, form)| **form == Form::Free)
        .filter_map(|(pieces, _)| whole(view, seen, pieces, tolerance))
        .filter(|found| found.strong && found.exact)
        .collect();
    let any = !found.is_empty();
    for whole in found {
        regions.accept(whole);
    }
    any
}

/// The surface of a part that was taken for a free form, if one fits all of it: a chamfer is one strip of a cone,
/// which proves nothing as long as one does not know where it ends.
///
/// The simplest that fits is taken: a strip between two circles lies on a sphere and on tori as well.
pub(crate) fn whole(
    view: View,
    regions: &Regions,
    pieces: &[u32],
    tolerance: f64,
) -> Option<Hypothesis> {
    let &first = pieces.first()?;
    if let Some(found) = plane(view, pieces, tolerance) {
        return Some(found);
    }
    let vertices = view.vertices_of(pieces);
    let few = a_few(&vertices, MOST_POINTS);
    let points: Vec<DVec3> = few.map(|&v| view.ground.positions[v as usize]).collect();
    let facets = [view.facets(pieces), view.linked_facets(pieces)];
    let axes = axes_beside(view, regions, pieces);
    for kind in [Kind::Cylinder, Kind::Cone, Kind::Sphere, Kind::Torus] {
        if points.len() <= kind.degrees_of_freedom() {
            continue;
        }
        let mut from = Vec::new();
        if kind == Kind::Cone {
            from.extend(axes.iter().filter_map(|&axis| cone_about(axis, &points)));
        }
        from.extend(
            facets
                .iter()
                .flat_map(|of| guesses(kind, &of.between(&points))),
        );
        for guess in from {
            let Some(fit) = refine_patiently(guess, &points, tolerance) else {
                continue;
            };
            let surface = fit.surface;
            let at = surface.gradient(view.pieces.centroids[first as usize]);
            let sign = at.dot(view.pieces.normals[first as usize]).signum();
            if pieces
                .iter()
                .all(|&p| view.fits(p, &surface, sign, tolerance))
            {
                return Some(view.weigh(surface, sign, pieces.to_vec(), tolerance));
            }
        }
    }
    None
}

/// Directions of the surfaces beside pieces, over walls too: chamfers are about the axes of what they end.
fn axes_beside(view: View, regions: &Regions, pieces: &[u32]) -> Vec<DVec3> {
    let mut beside: Vec<u32> = pieces
        .iter()
        .flat_map(|&p| {
            let links = view.pieces.around.row(p).iter();
            links.map(move |&link| view.pieces.links[link as usize].across(p))
        })
        .map(|p| regions.owner[p as usize])
        .filter(|&owner| owner != NONE)
        .collect();
    beside.sort_unstable();
    beside.dedup();
    let mut axes: Vec<DVec3> = Vec::new();
    for region in beside {
        let surface = &regions.all[region as usize].surface;
        let known = |axis: &DVec3| axis.cross(surface.axis).length() < SAME_DIRECTION;
        if surface.kind != Kind::Sphere && !axes.iter().any(known) {
            axes.push(surface.axis);
        }
    }
    axes.truncate(MOST_AXES);
    axes
}

/// The plane of all pieces, if they lie in one.
fn plane(view: View, pieces: &[u32], tolerance: f64) -> Option<Hypothesis> {
    let area = view.area(pieces);
    let weighed = |of: &[DVec3]| -> DVec3 {
        pieces
            .iter()
            .map(|&p| of[p as usize] * view.pieces.areas[p as usize])
            .sum()
    };
    let surface = Surface {
        kind: Kind::Plane,
        point: weighed(&view.pieces.centroids) / area,
        axis: weighed(&view.pieces.normals).normalize_or_zero(),
        a: 0.0,
        b: 0.0,
    };
    (area > 0.0
        && pieces
            .iter()
            .all(|&p| view.fits(p, &surface, 1.0, tolerance)))
    .then(|| view.weigh(surface, 1.0, pieces.to_vec(), tolerance))
}
