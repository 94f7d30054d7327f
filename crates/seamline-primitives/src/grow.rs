//! Surfaces grown from a seed over the pieces beside it, as far as they hold.

use crate::around::{Around, Marks};
use crate::hypothesis::{Hypothesis, NORMALS_AGREE, View};
use crate::refine::{Cloud, refine};
use crate::surface::Surface;

/// Most vertices a fit looks at; more do not make it better.
pub(crate) const MOST_POINTS: usize = 400;
/// Most times a surface is fitted again as it grows.
const MOST_ROUNDS: usize = 40;
/// A grown surface is fitted once more, to this share of the tolerance.
const FINAL_SHARE: f64 = 0.1;
/// How much farther from the surface pieces may lie that a fit is tried on.
const WIDER: f64 = 4.0;

/// What surfaces grow on, on which rung of the ladder of tolerances, and how exactly.
pub(crate) struct Soil<'a> {
    pub view: View<'a>,
    pub rung: usize,
    pub tolerance: f64,
    pub around: Around<'a>,
    /// Vertices on the surface that grows.
    pub on_it: Marks,
}

impl Soil<'_> {
    /// Grows a surface from its seed; whenever the region has doubled it is fitted again, so that the error
    /// of extrapolation stays below the tolerance.
    pub fn grow(&mut self, seed: u32, mut surface: Surface, fitted: usize) -> Option<Hypothesis> {
        let normal = self.view.pieces.normals[seed as usize];
        let gradient = surface.gradient(self.view.pieces.centroids[seed as usize]);
        let sign = gradient.dot(normal).signum();
        let mut fitted = fitted;
        let mut region = self.flood(seed, &surface, sign, self.tolerance, usize::MAX)?;
        for _ in 0..MOST_ROUNDS {
            // Small regions determine little of what lies beyond: a wider look, believed only once the fit to
            // all of it is exact again.
            let wider = if region.len() < 2 * fitted {
                let most = (2 * fitted).max(region.len() + 2);
                self.flood(seed, &surface, sign, WIDER * self.tolerance, most)?
            } else {
                region.clone()
            };
            let look = [wider, region.clone()];
            let mut grown = false;
            for (among, goal) in look.into_iter().zip([1.0, FINAL_SHARE]) {
                let points = self.view.some_points(&among, MOST_POINTS);
                let fit = Cloud::of(&points)
                    .and_then(|cloud| refine(surface, &cloud, goal * self.tolerance));
                let Some(fit) = fit else {
                    continue;
                };
                if fit.rms > self.tolerance {
                    continue;
                }
                let next = self.flood(seed, &fit.surface, sign, self.tolerance, usize::MAX);
                if let Some(next) = next
                    && next.len() >= region.len()
                {
                    surface = fit.surface;
                    grown = next.len() > region.len();
                    region = next;
                    fitted = among.len();
                }
                if grown {
                    break;
                }
            }
            if !grown {
                break;
            }
        }
        let hypothesis = self.view.weigh(surface, sign, region, self.tolerance);
        (hypothesis.evidence >= 1).then_some(hypothesis)
    }

    /// The pieces that fit, connected to the seed.
    fn flood(
        &mut self,
        seed: u32,
        surface: &Surface,
        sign: f64,
        tolerance: f64,
        most: usize,
    ) -> Option<Vec<u32>> {
        let view = self.view;
        if !view.fits(seed, surface, sign, tolerance) {
            return None;
        }
        // Most vertices of a piece are known from those before it.
        let on_it = &mut self.on_it;
        on_it.begin(view.ground.positions.len());
        let mut lies = |v: u32| {
            on_it.holds(v)
                || surface.distance(view.ground.positions[v as usize]).abs() <= tolerance
                    && on_it.mark(v)
        };
        self.around.marks.begin(view.pieces.count());
        self.around.marks.mark(seed);
        let mut region = vec![seed];
        let mut at = 0;
        while at < region.len() && region.len() < most {
            let piece = region[at];
            at += 1;
            let pieces = view.pieces;
            for link in pieces.smooth_links(piece) {
                let across = link.across(piece);
                if self.around.open[across as usize]
                    && self.around.marks.mark(across)
                    && pieces.vertices.row(across).iter().all(|&v| lies(v))
                    && view.faces_as(across, surface, sign, NORMALS_AGREE)
                {
                    region.push(across);
                }
            }
        }
        Some(region)
    }
}
