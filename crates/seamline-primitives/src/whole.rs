//! Parts that were taken for free forms, and are one surface as a whole.

use glam::DVec3;

use crate::guess::guesses;
use crate::hypothesis::{Hypothesis, View};
use crate::parts::{Form, Parts};
use crate::refine::refine_patiently;
use crate::regions::Regions;
use crate::surface::Kind;

/// Most vertices a fit looks at.
const MOST_POINTS: usize = 2000;

/// Accepts the free forms that prove to be of one surface as a whole. True if there was any.
pub(crate) fn accept_wholes(
    view: View,
    regions: &mut Regions,
    parts: &Parts,
    tolerance: f64,
) -> bool {
    let before = regions.all.len();
    for (part, pieces) in parts.pieces().into_iter().enumerate() {
        if parts.forms[part] == Form::Free
            && let Some(found) = whole(view, &pieces, tolerance)
            && found.strong
            && found.exact
        {
            regions.accept(found);
        }
    }
    regions.all.len() > before
}

/// The surface of a part that was taken for a free form, if one fits all of it: a chamfer is one strip of a cone,
/// which proves nothing as long as one does not know where it ends.
pub(crate) fn whole(view: View, pieces: &[u32], tolerance: f64) -> Option<Hypothesis> {
    let vertices = view.vertices_of(pieces);
    let few = vertices
        .iter()
        .step_by(vertices.len().div_ceil(MOST_POINTS));
    let points: Vec<DVec3> = few.map(|&v| view.positions[v as usize]).collect();
    let facets = view.facets(pieces);
    [Kind::Cylinder, Kind::Cone, Kind::Sphere, Kind::Torus]
        .into_iter()
        .filter(|kind| points.len() > kind.degrees_of_freedom())
        .flat_map(|kind| guesses(kind, &facets.between(&points)))
        .filter_map(|guess| refine_patiently(guess, &points, tolerance))
        .find_map(|fit| {
            let surface = fit.surface;
            let normal = view.pieces.normals[pieces[0] as usize];
            let at = surface.gradient(view.pieces.centroids[pieces[0] as usize]);
            let sign = at.dot(normal).signum();
            let fits = |&p: &u32| view.fits(p, &surface, sign, tolerance);
            pieces
                .iter()
                .all(fits)
                .then(|| view.weigh(surface, sign, pieces.to_vec(), tolerance))
        })
}
