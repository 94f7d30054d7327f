//! The search for surfaces: from each smooth piece not yet explained, fits to small neighbourhoods, grown as
//! far as they hold.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use glam::DVec3;

use crate::guess::guesses;
use crate::hypothesis::{Hypothesis, View};
use crate::refine::refine;
use crate::surface::{Kind, Surface};

/// Least cosine between the normals of a neighbourhood and of the piece it surrounds.
const STAR_COS: f64 = 0.7;
const RING_COS: f64 = 0.9;
/// Most pieces in a neighbourhood.
const MOST_IN_RING: usize = 60;
/// Least cosine (18 degrees) between the normals of a disc and of its seed, most pieces in a disc, and by
/// what the next disc is smaller: on dense meshes rings turn too little to tell one surface from another.
const DISC_COS: f64 = 0.95;
const MOST_IN_DISC: usize = 4000;
const DISC_SHRINKS: usize = 4;
/// Pieces of a disc that a fit looks at first.
const DISC_SAMPLE: usize = 40;
/// Most neighbourhoods of three pieces tried for one seed.
const MOST_TRIPLES: usize = 12;
/// After so many seeds in vain one more piece about each further one is none: a large free form takes as many
/// seeds as the root of its pieces.
const IN_A_ROW: usize = 32;
/// A surface looked for on a looser rung has many pieces, so that some seeds among them suffice: about so many
/// for all that is open.
const SEEDS: [usize; 3] = [usize::MAX, 1000, 300];
/// Pieces whose areas differ by more than this factor say nothing of each other.
const ALIKE: f64 = 3.0;
/// Pieces of a strip.
const STRIP: usize = 8;
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
const COVERS: usize = 8;

/// Marks of pieces or vertices that are forgotten all at once.
#[derive(Default)]
struct Marks {
    of: Vec<u32>,
    now: u32,
}

impl Marks {
    fn begin(&mut self, count: usize) {
        self.of.resize(count, 0);
        self.now += 1;
    }

    /// Marks an item; true if it was not marked yet.
    fn mark(&mut self, item: u32) -> bool {
        let was = std::mem::replace(&mut self.of[item as usize], self.now);
        was != self.now
    }
}

/// Finds hypotheses on the pieces that may take part.
pub(crate) struct Search<'a> {
    view: View<'a>,
    rung: usize,
    tolerance: f64,
    /// May a piece take part?
    open: &'a [bool],
    marks: Marks,
    /// Neighbourhoods, by their hash, that were tried for a kind.
    tried: HashSet<(u64, Kind)>,
    /// Pieces in the midst of discs that are on no surface.
    amid_failure: Vec<bool>,
}

impl<'a> Search<'a> {
    pub fn new(view: View<'a>, open: &'a [bool], rung: usize, tolerance: f64) -> Self {
        Self {
            view,
            rung,
            tolerance,
            open,
            marks: Marks::default(),
            tried: HashSet::new(),
            amid_failure: vec![false; open.len()],
        }
    }

    /// All hypotheses worth weighing, in the order their seeds come: from the largest piece down.
    pub fn run(&mut self) -> Vec<Hypothesis> {
        let pieces = self.view.pieces;
        let mut seeds: Vec<u32> = (0..pieces.count() as u32)
            .filter(|&p| self.open[p as usize])
            .filter(|&p| self.neighbours(p).next().is_some())
            .collect();
        let area = |&p: &u32| pieces.areas[p as usize];
        seeds.sort_by(|a, b| area(b).total_cmp(&area(a)));
        let mut covered = vec![false; pieces.count()];
        let mut found = Vec::new();
        let mut failed = vec![false; pieces.count()];
        let mut in_a_row = 0;
        let least = 1 + seeds.len() / SEEDS[self.rung];
        for seed in seeds {
            // Beside a seed that was in vain another of its size rarely is not, and free forms are all such.
            let alike = |p: u32| {
                let ratio = area(&p) / area(&seed);
                (1.0 / ALIKE..=ALIKE).contains(&ratio)
            };
            let in_vain = self.neighbours(seed).any(|p| failed[p as usize] && alike(p));
            if covered[seed as usize] || in_vain {
                continue;
            }
            let hypotheses = self.hypotheses_of(seed);
            if hypotheses.iter().any(|h| h.strong) {
                in_a_row /= 2;
            } else {
                in_a_row += 1;
                self.mark_about(seed, least + in_a_row / IN_A_ROW, &mut failed);
            }
            for hypothesis in hypotheses {
                if hypothesis.strong && hypothesis.pieces.len() >= COVERS {
                    for &piece in &hypothesis.pieces {
                        covered[piece as usize] = true;
                    }
                }
                found.push(hypothesis);
            }
        }
        found
    }

    /// Marks a seed and the pieces about it, `most` at most.
    fn mark_about(&self, seed: u32, most: usize, failed: &mut [bool]) {
        let mut region = vec![seed];
        failed[seed as usize] = true;
        let mut at = 0;
        while at < region.len() && region.len() < most {
            for across in self.neighbours(region[at]) {
                if !std::mem::replace(&mut failed[across as usize], true) {
                    region.push(across);
                }
            }
            at += 1;
        }
    }

    /// Pieces beside a piece that may take part, over links that are no walls.
    fn neighbours(&self, piece: u32) -> impl Iterator<Item = u32> {
        let open = self.open;
        self.view
            .pieces
            .smooth_links(piece)
            .map(move |link| link.across(piece))
            .filter(move |&p| open[p as usize])
    }

    /// The best hypothesis of each kind that holds the seed.
    fn hypotheses_of(&mut self, seed: u32) -> Vec<Hypothesis> {
        let mut best: [Option<Hypothesis>; 4] = Default::default();
        if self.on_discs(seed, &mut best) {
            return best.into_iter().flatten().collect();
        }
        // At loose tolerances few pieces are on any surface.
        let triples = if self.rung < 2 {
            self.triples(seed)
        } else {
            Vec::new()
        };
        for triple in triples {
            for kind in [Kind::Cylinder, Kind::Cone] {
                if self.settled(&best, kind) {
                    continue;
                }
                self.attempt(seed, kind, &triple, &mut best);
            }
        }
        let strip = self.strip(seed);
        for kind in [Kind::Cylinder, Kind::Cone] {
            if !self.settled(&best, kind) {
                self.attempt(seed, kind, &strip, &mut best);
            }
        }
        let stars = self.stars(seed);
        let mut spoke: [Vec<usize>; 4] = Default::default();
        for (i, star) in stars.iter().enumerate() {
            for kind in Kind::CURVED {
                if !self.settled(&best, kind) && self.attempt(seed, kind, star, &mut best) {
                    spoke[kind as usize - 1].push(i);
                }
            }
        }
        for (i, one) in stars.iter().enumerate() {
            for other in &stars[..i] {
                let mut pair = one.clone();
                pair.extend(other.iter().filter(|p| !one.contains(p)));
                for kind in [Kind::Cone, Kind::Torus] {
                    let refuted = spoke[kind as usize - 1].iter().any(|&j| {
                        j == i || stars[j] == *other
                    });
                    if !refuted && !self.settled(&best, kind) {
                        self.attempt(seed, kind, &pair, &mut best);
                    }
                }
            }
        }
        for rings in [1, 2] {
            let ring = self.rings(seed, rings);
            let holds = |star: &[u32]| star.iter().all(|p| ring.contains(p));
            for kind in Kind::CURVED {
                // What does not fit a part does not fit the whole.
                let refuted = spoke[kind as usize - 1].iter().any(|&i| holds(&stars[i]));
                if !refuted
                    && !self.settled(&best, kind)
                    && self.attempt(seed, kind, &ring, &mut best)
                {
                    // Nor does the next ring.
                    spoke[kind as usize - 1].extend(0..stars.len().min(1));
                }
            }
        }
        self.on_what_came_near(seed, &mut best);
        best.into_iter().flatten().collect()
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
            for kind in [Kind::Cone, Kind::Torus] {
                self.attempt(seed, kind, around, best);
            }
        }
    }

    /// Tries the discs about a seed, the largest first. True if one proved to be of a surface, so that smaller
    /// neighbourhoods can tell nothing more.
    fn on_discs(&mut self, seed: u32, best: &mut [Option<Hypothesis>; 4]) -> bool {
        if self.amid_failure[seed as usize] {
            return false;
        }
        let mut disc = self.disc(seed, DISC_COS, MOST_IN_DISC);
        let inner = disc[..disc.len().min(MOST_IN_RING)].to_vec();
        while disc.len() > MOST_IN_RING {
            let step = disc.len().div_ceil(DISC_SAMPLE);
            let sample: Vec<u32> = disc.iter().copied().step_by(step).collect();
            for kind in Kind::CURVED {
                self.attempt(seed, kind, &sample, best);
                let proved =
                    |h: &Hypothesis| h.strong && h.exact && h.pieces.len() >= disc.len() / 2;
                if best[kind as usize - 1].as_ref().is_some_and(proved) {
                    return true;
                }
            }
            disc.truncate(disc.len() / DISC_SHRINKS);
        }
        for piece in inner {
            self.amid_failure[piece as usize] = true;
        }
        false
    }

    /// The seed and the pieces about it, nearest first, as far as the surface turns little.
    fn disc(&mut self, seed: u32, least_cos: f64, most: usize) -> Vec<u32> {
        let pieces = self.view.pieces;
        let normal = pieces.normals[seed as usize];
        self.marks.begin(pieces.count());
        self.marks.mark(seed);
        let mut disc = vec![seed];
        let mut at = 0;
        while at < disc.len() && disc.len() < most {
            for link in pieces.smooth_links(disc[at]) {
                let across = link.across(disc[at]);
                if self.open[across as usize]
                    && pieces.normals[across as usize].dot(normal) >= least_cos
                    && self.marks.mark(across)
                {
                    disc.push(across);
                }
            }
            at += 1;
        }
        disc
    }

    /// Is more of this kind not to be had?
    fn settled(&self, best: &[Option<Hypothesis>; 4], kind: Kind) -> bool {
        best[kind as usize - 1]
            .as_ref()
            .is_some_and(|h| h.strong && h.pieces.len() >= COVERS)
    }

    /// Fits a kind to a neighbourhood and lets it grow. False if it has too few vertices for that.
    fn attempt(
        &mut self,
        seed: u32,
        kind: Kind,
        around: &[u32],
        best: &mut [Option<Hypothesis>; 4],
    ) -> bool {
        let vertices = self.view.vertices_of(around);
        if vertices.len() < kind.degrees_of_freedom() + 2 {
            return false;
        }
        let mut hasher = DefaultHasher::new();
        around.hash(&mut hasher);
        if !self.tried.insert((hasher.finish(), kind)) {
            return true;
        }
        let points: Vec<DVec3> = vertices
            .iter()
            .step_by(vertices.len().div_ceil(MOST_POINTS))
            .map(|&v| self.view.positions[v as usize])
            .collect();
        let facets = self.view.facets(around);
        let mut first = guesses(kind, &facets.between(&points));
        if matches!(kind, Kind::Cylinder | Kind::Cone) && around.len() == STRIP {
            first.extend(guesses(kind, &facets.paired().between(&points)));
        }
        for guess in first {
            let Some(fit) = refine(guess, &points, self.tolerance) else {
                continue;
            };
            if fit.rms > self.tolerance || is_degenerate(&fit.surface) {
                continue;
            }
            let slot = &mut best[kind as usize - 1];
            if slot.as_ref().is_some_and(|h| {
                self.view.fits(seed, &fit.surface, h.sign, self.tolerance) && {
                    let same = around.iter().all(|p| h.pieces.contains(p));
                    same && h.pieces.len() > around.len()
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
                let Some(fit) = refine(surface, &points, goal * self.tolerance) else {
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
        self.marks.begin(self.view.pieces.count());
        self.marks.mark(seed);
        let mut region = vec![seed];
        let mut at = 0;
        while at < region.len() && region.len() < most {
            let piece = region[at];
            at += 1;
            let pieces = self.view.pieces;
            for link in pieces.smooth_links(piece) {
                let across = link.across(piece);
                if self.open[across as usize]
                    && self.marks.mark(across)
                    && self.view.fits(across, surface, sign, tolerance)
                {
                    region.push(across);
                }
            }
        }
        Some(region)
    }

    /// The seed with two neighbours, and with a neighbour and its neighbour.
    fn triples(&self, seed: u32) -> Vec<Vec<u32>> {
        let near: Vec<u32> = self.neighbours(seed).take(6).collect();
        let mut triples = Vec::new();
        for (i, &a) in near.iter().enumerate() {
            triples.extend(near[..i].iter().map(|&b| vec![seed, a, b]));
        }
        for &a in &near {
            let beyond = self
                .neighbours(a)
                .filter(|p| *p != seed && !near.contains(p));
            triples.extend(beyond.take(3).map(|b| vec![seed, a, b]));
        }
        triples.truncate(MOST_TRIPLES);
        triples
    }

    /// The seed and what goes on from it with the least turns: along a strip of triangles between two rims, of
    /// which every star holds pieces beyond the rims.
    fn strip(&self, seed: u32) -> Vec<u32> {
        let pieces = self.view.pieces;
        let turn = |a: u32, b: u32| {
            let [a, b] = [a, b].map(|p| pieces.normals[p as usize]);
            a.dot(b)
        };
        let mut strip = vec![seed];
        while strip.len() < STRIP {
            let beyond = strip.iter().flat_map(|&from| {
                self.neighbours(from)
                    .filter(|p| !strip.contains(p))
                    .map(move |to| (turn(from, to), to))
            });
            let Some((_, next)) = beyond.max_by(|a, b| a.0.total_cmp(&b.0)) else {
                break;
            };
            strip.push(next);
        }
        strip
    }

    /// The pieces round each vertex of the seed.
    fn stars(&self, seed: u32) -> Vec<Vec<u32>> {
        let pieces = self.view.pieces;
        let vertices = pieces.vertices.row(seed);
        let normal = pieces.normals[seed as usize];
        let mut stars: Vec<Vec<u32>> = vertices
            .iter()
            .step_by(vertices.len().div_ceil(8))
            .map(|&vertex| {
                let round = pieces.of_vertex.row(vertex).iter().copied();
                round
                    .filter(|&p| {
                        self.open[p as usize] && pieces.normals[p as usize].dot(normal) >= STAR_COS
                    })
                    .collect()
            })
            .filter(|star: &Vec<u32>| star.len() >= 3)
            .collect();
        stars.sort_unstable();
        stars.dedup();
        stars
    }

    /// The pieces that share a vertex with the seed, and again.
    fn rings(&mut self, seed: u32, rings: usize) -> Vec<u32> {
        let pieces = self.view.pieces;
        let normal = pieces.normals[seed as usize];
        self.marks.begin(pieces.count());
        self.marks.mark(seed);
        let mut region = vec![seed];
        let mut from = 0;
        for _ in 0..rings {
            let to = region.len();
            for i in from..to {
                for &vertex in pieces.vertices.row(region[i]) {
                    for &piece in pieces.of_vertex.row(vertex) {
                        if region.len() < MOST_IN_RING
                            && self.open[piece as usize]
                            && pieces.normals[piece as usize].dot(normal) >= RING_COS
                            && self.marks.mark(piece)
                        {
                            region.push(piece);
                        }
                    }
                }
            }
            from = to;
        }
        region
    }
}

/// Is a torus a sphere, its circle hardly more than a point?
fn is_degenerate(surface: &Surface) -> bool {
    surface.kind == Kind::Torus && surface.a.abs() < LEAST_TORUS * surface.b.abs()
}

/// Least major radius of a torus, in minor radii.
const LEAST_TORUS: f64 = 0.02;
