//! One seed: surfaces fitted to the neighbourhoods of a piece, and grown as far as they hold.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use glam::DVec3;

use crate::around::{Around, DISC_SHRINKS, MOST_IN_RING, STRIP};
use crate::guess::{Facets, guesses};
use crate::hypothesis::{Hypothesis, View};
use crate::refine::{Cloud, refine};
use crate::surface::{Kind, Surface};

/// Pieces of a disc that a fit looks at first.
const DISC_SAMPLE: usize = 40;
/// Most vertices a fit looks at; more do not make it better.
const MOST_POINTS: usize = 400;
/// Fewest pieces of a surface that only comes near for others to be tried on them.
const NEAR_PIECES: usize = 6;
/// Most times a surface is fitted again as it grows.
const MOST_ROUNDS: usize = 40;
/// A grown surface is fitted once more, to this share of the tolerance.
const FINAL_SHARE: f64 = 0.1;
/// How much farther from the surface pieces may lie that a fit is tried on.
const WIDER: f64 = 4.0;
/// Pieces a strong hypothesis must have to spare its pieces from being seeds.
pub(crate) const COVERS: usize = 8;

/// What was found about a seed.
pub(crate) struct About {
    /// The best hypothesis of each kind that holds the seed.
    pub hypotheses: Vec<Hypothesis>,
    /// Pieces in the midst of discs that are on no surface.
    pub midst: Vec<u32>,
}

impl About {
    fn of(best: [Option<Hypothesis>; 4], midst: Vec<u32>) -> Self {
        Self {
            hypotheses: best.into_iter().flatten().collect(),
            midst,
        }
    }
}

/// A neighbourhood as all kinds look at it.
struct Look<'p> {
    pieces: &'p [u32],
    hash: u64,
    /// Its distinct vertices.
    vertices: Vec<u32>,
    sample: Option<Sample>,
}

/// What a surface is fitted to.
struct Sample {
    points: Vec<DVec3>,
    cloud: Cloud,
    facets: Facets,
}

impl Look<'_> {
    /// `None` if all points are one.
    fn sample(&mut self, view: View) -> Option<&Sample> {
        if self.sample.is_none() {
            let points: Vec<DVec3> = self
                .vertices
                .iter()
                .step_by(self.vertices.len().div_ceil(MOST_POINTS))
                .map(|&v| view.positions[v as usize])
                .collect();
            self.sample = Some(Sample {
                cloud: Cloud::of(&points)?,
                facets: view.facets(self.pieces),
                points,
            });
        }
        self.sample.as_ref()
    }
}

/// Looks for surfaces about seeds.
pub(crate) struct Scout<'a> {
    view: View<'a>,
    rung: usize,
    tolerance: f64,
    around: Around<'a>,
    /// Neighbourhoods, by their hash, that were tried for a kind.
    tried: HashSet<(u64, Kind)>,
}

impl<'a> Scout<'a> {
    pub fn new(view: View<'a>, open: &'a [bool], rung: usize, tolerance: f64) -> Self {
        Self {
            view,
            rung,
            tolerance,
            around: Around::new(view, open),
            tried: HashSet::new(),
        }
    }

    /// The best hypothesis of each kind that holds the seed.
    pub fn hypotheses_of(&mut self, seed: u32, discs: bool) -> About {
        let mut best: [Option<Hypothesis>; 4] = Default::default();
        let midst = if discs {
            match self.on_discs(seed, &mut best) {
                Some(midst) => midst,
                None => return About::of(best, Vec::new()),
            }
        } else {
            Vec::new()
        };
        // At loose tolerances few pieces are on any surface.
        let triples = if self.rung < 2 {
            self.around.triples(seed)
        } else {
            Vec::new()
        };
        for triple in triples {
            let mut look = self.look(&triple);
            for kind in [Kind::Cylinder, Kind::Cone] {
                if !self.settled(&best, kind) {
                    self.attempt(seed, kind, &mut look, &mut best);
                }
            }
        }
        let strip = self.around.strip(seed);
        let mut look = self.look(&strip);
        for kind in [Kind::Cylinder, Kind::Cone] {
            if !self.settled(&best, kind) {
                self.attempt(seed, kind, &mut look, &mut best);
            }
        }
        let stars = self.around.stars(seed);
        let mut spoke: [Vec<usize>; 4] = Default::default();
        for (i, star) in stars.iter().enumerate() {
            let mut look = self.look(star);
            for kind in Kind::CURVED {
                if !self.settled(&best, kind) && self.attempt(seed, kind, &mut look, &mut best) {
                    spoke[kind as usize - 1].push(i);
                }
            }
        }
        for (i, one) in stars.iter().enumerate() {
            for (j, other) in stars[..i].iter().enumerate() {
                let refuted = |kind: Kind| {
                    let spoke = &spoke[kind as usize - 1];
                    spoke.contains(&i) || spoke.contains(&j)
                };
                let kinds = [Kind::Cone, Kind::Torus].into_iter();
                let mut left = kinds.filter(|&k| !refuted(k)).peekable();
                if left.peek().is_none() {
                    continue;
                }
                let mut pair = one.clone();
                pair.extend(other.iter().filter(|p| !one.contains(p)));
                let mut look = self.look(&pair);
                for kind in left {
                    if !self.settled(&best, kind) {
                        self.attempt(seed, kind, &mut look, &mut best);
                    }
                }
            }
        }
        for rings in [1, 2] {
            let ring = self.around.rings(seed, rings);
            let mut look = self.look(&ring);
            let holds = |star: &[u32]| star.iter().all(|p| ring.contains(p));
            for kind in Kind::CURVED {
                // What does not fit a part does not fit the whole.
                let refuted = spoke[kind as usize - 1].iter().any(|&i| holds(&stars[i]));
                if !refuted
                    && !self.settled(&best, kind)
                    && self.attempt(seed, kind, &mut look, &mut best)
                {
                    // Nor does the next ring.
                    spoke[kind as usize - 1].extend(0..stars.len().min(1));
                }
            }
        }
        self.on_what_came_near(seed, &mut best);
        About::of(best, midst)
    }

    /// The surface of a kind that is fitted to pieces and grows from one of them.
    pub fn of_kind(&mut self, seed: u32, kind: Kind, pieces: &[u32]) -> Option<Hypothesis> {
        let mut best: [Option<Hypothesis>; 4] = Default::default();
        self.attempt(seed, kind, &mut self.look(pieces), &mut best);
        best[kind as usize - 1].take()
    }

    /// A torus looks like a cylinder nearby, and a cone like one too: where a surface only came near, those of more
    /// freedom are tried on all it took in.
    fn on_what_came_near(&mut self, seed: u32, best: &mut [Option<Hypothesis>; 4]) {
        let proved = |h: &Hypothesis| h.strong && h.exact;
        if best.iter().flatten().any(proved) {
            return;
        }
        let near: Vec<Vec<u32>> = best.iter().flatten().map(|h| h.pieces.clone()).collect();
        for around in near.iter().filter(|pieces| pieces.len() >= NEAR_PIECES) {
            let mut look = self.look(around);
            for kind in [Kind::Cone, Kind::Torus] {
                self.attempt(seed, kind, &mut look, best);
            }
        }
    }

    /// Tries the discs about a seed, the largest first. `None` if one proved to be of a surface, so that smaller
    /// neighbourhoods can tell nothing more; else the midst of the discs.
    fn on_discs(&mut self, seed: u32, best: &mut [Option<Hypothesis>; 4]) -> Option<Vec<u32>> {
        let mut disc = self.around.disc(seed);
        let midst = disc[..disc.len().min(MOST_IN_RING)].to_vec();
        while disc.len() > MOST_IN_RING {
            let step = disc.len().div_ceil(DISC_SAMPLE);
            let sample: Vec<u32> = disc.iter().copied().step_by(step).collect();
            let mut look = self.look(&sample);
            for kind in Kind::CURVED {
                self.attempt(seed, kind, &mut look, best);
                let proved =
                    |h: &Hypothesis| h.strong && h.exact && h.pieces.len() >= disc.len() / 2;
                if best[kind as usize - 1].as_ref().is_some_and(proved) {
                    return None;
                }
            }
            disc.truncate(disc.len() / DISC_SHRINKS);
        }
        Some(midst)
    }

    /// Is more of this kind not to be had?
    fn settled(&self, best: &[Option<Hypothesis>; 4], kind: Kind) -> bool {
        best[kind as usize - 1]
            .as_ref()
            .is_some_and(|h| h.strong && h.pieces.len() >= COVERS)
    }

    fn look<'p>(&self, pieces: &'p [u32]) -> Look<'p> {
        let mut hasher = DefaultHasher::new();
        pieces.hash(&mut hasher);
        Look {
            pieces,
            hash: hasher.finish(),
            vertices: self.view.vertices_of(pieces),
            sample: None,
        }
    }

    /// Fits a kind to a neighbourhood and lets it grow. False if it has too few vertices for that.
    fn attempt(
        &mut self,
        seed: u32,
        kind: Kind,
        look: &mut Look,
        best: &mut [Option<Hypothesis>; 4],
    ) -> bool {
        if look.vertices.len() < kind.degrees_of_freedom() + 2 {
            return false;
        }
        if !self.tried.insert((look.hash, kind)) {
            return true;
        }
        let around = look.pieces;
        let Some(sample) = look.sample(self.view) else {
            return true;
        };
        let Sample {
            points,
            cloud,
            facets,
        } = sample;
        let mut first = guesses(kind, &facets.between(points));
        if matches!(kind, Kind::Cylinder | Kind::Cone) && around.len() == STRIP {
            first.extend(guesses(kind, &facets.paired().between(points)));
        }
        for guess in first {
            let Some(fit) = refine(guess, cloud, self.tolerance) else {
                continue;
            };
            if fit.rms > self.tolerance || is_degenerate(&fit.surface) {
                continue;
            }
            let slot = &mut best[kind as usize - 1];
            if slot.as_ref().is_some_and(|h| {
                self.view.fits(seed, &fit.surface, h.sign, self.tolerance) && {
                    let larger = h.pieces.len() > around.len() && around.len() <= MOST_IN_RING;
                    larger && around.iter().all(|p| h.pieces.contains(p))
                }
            }) {
                continue;
            }
            if let Some(grown) = self.grow(seed, fit.surface, around.len()) {
                let larger = slot
                    .as_ref()
                    .is_none_or(|h| grown.pieces.len() > h.pieces.len());
                if larger {
                    *slot = Some(grown);
                }
            }
        }
        true
    }

    /// Grows a surface from its seed; whenever the region has doubled it is fitted again, so that the error
    /// of extrapolation stays below the tolerance.
    fn grow(&mut self, seed: u32, mut surface: Surface, fitted: usize) -> Option<Hypothesis> {
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
        if !self.view.fits(seed, surface, sign, tolerance) {
            return None;
        }
        self.around.marks.begin(self.view.pieces.count());
        self.around.marks.mark(seed);
        let mut region = vec![seed];
        let mut at = 0;
        while at < region.len() && region.len() < most {
            let piece = region[at];
            at += 1;
            let pieces = self.view.pieces;
            for link in pieces.smooth_links(piece) {
                let across = link.across(piece);
                if self.around.open[across as usize]
                    && self.around.marks.mark(across)
                    && self.view.fits(across, surface, sign, tolerance)
                {
                    region.push(across);
                }
            }
        }
        Some(region)
    }
}

/// Is a torus a sphere, its circle hardly more than a point?
fn is_degenerate(surface: &Surface) -> bool {
    surface.kind == Kind::Torus && surface.a.abs() < LEAST_TORUS * surface.b.abs()
}

/// Least major radius of a torus, in minor radii.
const LEAST_TORUS: f64 = 0.02;
