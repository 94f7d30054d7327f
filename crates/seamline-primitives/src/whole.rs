//! Parts that were taken for free forms, and are one surface as a whole.

use glam::DVec3;
use rayon::prelude::*;

use crate::climb::least_evidence;
use crate::few::a_few;
use crate::guess::{Facets, cone_about, cylinder_about, guesses};
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
const MOST_POINTS: usize = 400;

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
/// The simplest that fits is taken: a strip between two circles lies on a sphere and on tori as well. But a few triangles
/// of a cone about the axis of what lies beside lie on some cylinder that leans, too; it is the cone.
pub(crate) fn whole(
    view: View,
    regions: &Regions,
    pieces: &[u32],
    tolerance: f64,
) -> Option<Hypothesis> {
    Whole::of(view, regions, pieces).within(tolerance)
}

/// A part, what surfaces are fitted to, and the directions of what lies beside it.
struct Whole<'a> {
    view: View<'a>,
    pieces: &'a [u32],
    points: Vec<DVec3>,
    facets: [Facets; 2],
    axes: Vec<DVec3>,
}

impl<'a> Whole<'a> {
    fn of(view: View<'a>, regions: &Regions, pieces: &'a [u32]) -> Self {
        let vertices = view.vertices_of(pieces);
        let few = a_few(&vertices, MOST_POINTS);
        Self {
            view,
            pieces,
            points: few.map(|&v| view.ground.positions[v as usize]).collect(),
            facets: [view.facets(pieces), view.linked_facets(pieces)],
            axes: axes_beside(view, regions, pieces),
        }
    }

    /// The simplest surface that all vertices lie on within a tolerance.
    fn within(&self, tolerance: f64) -> Option<Hypothesis> {
        if let Some(found) = plane(self.view, self.pieces, tolerance) {
            return Some(found);
        }
        if let Some(found) = self.exactly_on(&self.about_axes(cylinder_about), tolerance) {
            return Some(found);
        }
        let guessed = |kind| self.fitting(self.guesses(kind), tolerance);
        let cylinder = guessed(Kind::Cylinder);
        let leans = |h: &Hypothesis| !self.axes.iter().any(|axis| is_along(*axis, h.surface.axis));
        if self.determines(Kind::Cone) && cylinder.as_ref().is_none_or(leans) {
            let cones = self.about_axes(cone_about);
            let cone = self.exactly_on(&cones, tolerance);
            let cone = cone.or_else(|| self.fitting(cones, tolerance));
            if cone.is_some() {
                return cone;
            }
        }
        cylinder
            .or_else(|| guessed(Kind::Cone))
            .or_else(|| guessed(Kind::Sphere))
            .or_else(|| guessed(Kind::Torus))
    }

    /// Surfaces about the axes beside: an axis there is known better than a few triangles can tell.
    fn about_axes(&self, about: fn(DVec3, &[DVec3]) -> Option<Surface>) -> Vec<Surface> {
        let axes = self.axes.iter();
        axes.filter_map(|&axis| about(axis, &self.points)).collect()
    }

    /// Has it more vertices than a surface of a kind has degrees of freedom?
    fn determines(&self, kind: Kind) -> bool {
        self.points.len() > kind.degrees_of_freedom()
    }

    fn guesses(&self, kind: Kind) -> Vec<Surface> {
        let facets = self.facets.iter().filter(|_| self.determines(kind));
        facets
            .flat_map(|of| guesses(kind, &of.between(&self.points)))
            .collect()
    }

    /// The first of some surfaces that all of it lies on once it is fitted.
    fn fitting(&self, from: Vec<Surface>, tolerance: f64) -> Option<Hypothesis> {
        let fitted = |guess| refine_patiently(guess, &self.points, tolerance);
        from.into_iter()
            .find_map(|guess| self.on(fitted(guess)?.surface, tolerance))
    }

    /// The first of some surfaces that all of it lies on exactly, as it is.
    fn exactly_on(&self, surfaces: &[Surface], tolerance: f64) -> Option<Hypothesis> {
        let exact = |s: &&Surface| s.rms(&self.points) <= self.view.ground.precision;
        let known = surfaces.iter().filter(|s| self.determines(s.kind));
        let mut exact = known.filter(exact);
        exact.find_map(|&surface| self.on(surface, tolerance))
    }

    /// All of it on a surface, if it lies there.
    fn on(&self, surface: Surface, tolerance: f64) -> Option<Hypothesis> {
        let Self { view, pieces, .. } = *self;
        let &first = pieces.first()?;
        let at = surface.gradient(view.pieces.centroids[first as usize]);
        let sign = at.dot(view.pieces.normals[first as usize]).signum();
        let fits = |&piece: &u32| view.fits(piece, &surface, sign, tolerance);
        let all = pieces.iter().all(fits);
        all.then(|| view.weigh(surface, sign, pieces.to_vec(), tolerance))
    }
}

fn is_along(a: DVec3, b: DVec3) -> bool {
    a.cross(b).length() < SAME_DIRECTION
}

/// The surface that a free form is told to be: one that fits all of it exactly, or, farther out, with as much evidence as is
/// believed there whatever lies beside it.
pub(crate) fn told(
    view: View,
    regions: &Regions,
    pieces: &[u32],
    [exactly, nearly]: [f64; 2],
) -> Option<Hypothesis> {
    let believed = |h: &Hypothesis| h.strong && h.evidence >= least_evidence(1, h.surface.kind);
    let all = Whole::of(view, regions, pieces);
    all.within(exactly)
        .or_else(|| all.within(nearly).filter(believed))
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
        let known = |axis: &DVec3| is_along(*axis, surface.axis);
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
