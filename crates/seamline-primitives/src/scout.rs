//! One seed: surfaces fitted to the neighbourhoods of a piece, and grown as far as they hold.

use foldhash::HashMap;

use crate::LOOSEST;
use crate::around::{DISC_SHRINKS, MOST_IN_RING};
use crate::few::a_few;
use crate::grow::Soil;
use crate::hypothesis::Hypothesis;
use crate::look::{Look, MORE_THAN_FREE};
use crate::refine::refine;
use crate::surface::{Kind, Surface};
use crate::tried::{Asked, Question, Tried};

/// Pieces of a disc, or of what came near, that a fit looks at first.
const SAMPLE: usize = 20;
/// Fewest pieces of a surface that only comes near for others to be tried on them, on each rung: the looser the
/// tolerance, the more of all neighbourhoods come near some surface.
const NEAR_PIECES: [usize; 3] = [6, 12, 24];
/// Pieces a strong hypothesis must have to spare its pieces from being seeds.
pub(crate) const COVERS: usize = 8;

/// Neighbourhoods of a seed, in the order they are tried in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    Discs,
    /// Strips, and three pieces.
    Strips,
    Stars,
    /// Pairs of stars, and rings.
    Rings,
}

impl Way {
    /// All ways of a rung. At the loosest tolerance nearly all small neighbourhoods are on some surface, and only large
    /// surfaces are believed: stars and rings have no more to tell there than discs and strips.
    pub fn all(rung: usize) -> &'static [Self] {
        let all = &[Self::Discs, Self::Strips, Self::Stars, Self::Rings];
        if rung == LOOSEST { &all[..2] } else { all }
    }
}

/// What was found about a seed.
pub(crate) struct About {
    /// The best hypothesis of each kind that holds the seed.
    pub hypotheses: Vec<Hypothesis>,
    /// Pieces in the midst of discs that are on no surface.
    pub midst: Vec<u32>,
    /// What was tried, and the least root mean square distance of a fit.
    pub tried: HashMap<Question, f64>,
}

/// Looks for surfaces about one seed.
pub(crate) struct Scout<'s, 'a> {
    soil: &'s mut Soil<'a>,
    seed: u32,
    /// The best hypothesis of each kind so far.
    best: [Option<Hypothesis>; 4],
    /// What was tried before, about other seeds, and how many of them are known.
    before: (&'s Tried, Asked),
    tried: HashMap<Question, f64>,
    fits: bool,
}

impl<'s, 'a> Scout<'s, 'a> {
    pub fn new(soil: &'s mut Soil<'a>, seed: u32, before: &'s Tried, turn: usize) -> Self {
        let asked = Asked {
            rung: soil.rung,
            tolerance: soil.tolerance,
            turn,
        };
        Self {
            soil,
            seed,
            best: Default::default(),
            before: (before, asked),
            tried: HashMap::default(),
            fits: false,
        }
    }

    /// The best hypothesis of each kind that holds the seed, looked for in some ways.
    pub fn hypotheses(mut self, ways: &[Way]) -> About {
        let midst = if ways.contains(&Way::Discs) {
            self.on_discs()
        } else {
            Some(Vec::new())
        };
        if midst.is_some() {
            self.on_neighbourhoods(ways);
            self.on_what_came_near();
        }
        About {
            hypotheses: self.best.into_iter().flatten().collect(),
            midst: midst.unwrap_or_default(),
            tried: self.tried,
        }
    }

    /// Tries the small neighbourhoods.
    fn on_neighbourhoods(&mut self, ways: &[Way]) {
        if ways.contains(&Way::Strips) {
            if !self.is_loosest() {
                self.on_triples();
            }
            for strip in self.soil.around.strips(self.seed, self.soil.rung) {
                let look = Look::along(self.soil.view, &strip);
                self.attempt_all([Kind::Cylinder, Kind::Cone], look);
            }
        }
        let [on_stars, on_rings] = [Way::Stars, Way::Rings].map(|way| ways.contains(&way));
        if !on_stars && !on_rings {
            return;
        }
        let stars = self.soil.around.stars(self.seed);
        let spoke = if on_stars {
            self.on_stars(&stars)
        } else {
            Default::default()
        };
        if on_rings {
            self.on_pairs(&stars, &spoke);
            self.on_rings(&stars, spoke);
        }
    }

    fn is_loosest(&self) -> bool {
        self.soil.rung == LOOSEST
    }

    /// Tries each three pieces, of which three triangles have too few vertices.
    fn on_triples(&mut self) {
        let fewest = Kind::Cylinder.degrees_of_freedom() + MORE_THAN_FREE;
        for triple in self.soil.around.triples(self.seed) {
            if self.soil.around.most_vertices(&triple) >= fewest {
                let look = Look::at(self.soil.view, &triple);
                self.attempt_all([Kind::Cylinder, Kind::Cone], look);
            }
        }
    }

    /// Tries the pieces round each vertex of the seed. Gives, for each kind, the stars that had enough vertices.
    fn on_stars(&mut self, stars: &[Vec<u32>]) -> [Vec<usize>; 4] {
        let mut spoke: [Vec<usize>; 4] = Default::default();
        for (i, star) in stars.iter().enumerate() {
            let mut look = Look::at(self.soil.view, star);
            for kind in Kind::CURVED {
                if !self.settled(kind) && self.attempt(kind, &mut look) {
                    spoke[kind as usize - 1].push(i);
                }
            }
        }
        spoke
    }

    /// Tries each two stars together, for kinds that neither could tell of.
    fn on_pairs(&mut self, stars: &[Vec<u32>], spoke: &[Vec<usize>; 4]) {
        for (i, one) in stars.iter().enumerate() {
            for (j, other) in stars[..i].iter().enumerate() {
                let open = |&kind: &Kind| {
                    let spoke = &spoke[kind as usize - 1];
                    !spoke.contains(&i) && !spoke.contains(&j) && !self.settled(kind)
                };
                let kinds = [Kind::Cone, Kind::Torus].into_iter().filter(open);
                let kinds: Vec<Kind> = kinds.collect();
                if !kinds.is_empty() {
                    let mut pair = one.clone();
                    pair.extend(other.iter().filter(|p| !one.contains(p)));
                    let look = Look::at(self.soil.view, &pair);
                    self.attempt_all(kinds, look);
                }
            }
        }
    }

    /// Tries the ring about the seed, and two.
    fn on_rings(&mut self, stars: &[Vec<u32>], mut spoke: [Vec<usize>; 4]) {
        for rings in [1, 2] {
            let ring = self.soil.around.rings(self.seed, rings);
            let mut look = Look::at(self.soil.view, &ring);
            let holds = |star: &[u32]| star.iter().all(|p| ring.contains(p));
            for kind in Kind::CURVED {
                let spoke = &mut spoke[kind as usize - 1];
                // What does not fit a part does not fit the whole.
                let refuted = spoke.iter().any(|&i| holds(&stars[i]));
                if !refuted && !self.settled(kind) && self.attempt(kind, &mut look) {
                    // Nor does the next ring.
                    spoke.extend(0..stars.len().min(1));
                }
            }
        }
    }

    /// The surface of a kind that is fitted to pieces and grows from one of them.
    pub fn of_kind(mut self, kind: Kind, pieces: &[u32]) -> Option<Hypothesis> {
        self.attempt(kind, &mut Look::at(self.soil.view, pieces));
        self.best[kind as usize - 1].take()
    }

    /// A torus looks like a cylinder nearby, and a cone like one too: where a surface only came near, those of more
    /// freedom are tried on all it took in.
    fn on_what_came_near(&mut self) {
        let proved = |h: &Hypothesis| h.strong && h.exact;
        if self.best.iter().flatten().any(proved) {
            return;
        }
        let near: Vec<Vec<u32>> = self
            .best
            .iter()
            .flatten()
            .map(|h| h.pieces.clone())
            .collect();
        let least = NEAR_PIECES[self.soil.rung];
        for around in near.iter().filter(|pieces| pieces.len() >= least) {
            let some: Vec<u32> = a_few(around, SAMPLE).copied().collect();
            let mut look = Look::at(self.soil.view, &some);
            for kind in [Kind::Cone, Kind::Torus] {
                self.attempt(kind, &mut look);
            }
        }
    }

    /// Tries the discs about a seed, the smallest first: what does not fit a part does not fit the whole. `None` if one
    /// proved to be of a surface, so that smaller neighbourhoods can tell nothing more; else the midst of the discs.
    fn on_discs(&mut self) -> Option<Vec<u32>> {
        let disc = self.soil.around.disc(self.seed);
        let mut sizes = vec![disc.len()];
        while sizes[0] > MOST_IN_RING * DISC_SHRINKS {
            sizes.insert(0, sizes[0] / DISC_SHRINKS);
        }
        let mut kinds = Kind::CURVED.to_vec();
        for size in sizes.into_iter().filter(|&size| size > MOST_IN_RING) {
            let step = size.div_ceil(SAMPLE);
            let sample: Vec<u32> = disc[..size].iter().copied().step_by(step).collect();
            let mut look = Look::at(self.soil.view, &sample);
            let mut fitting = Vec::new();
            for kind in kinds {
                self.fits = false;
                self.attempt(kind, &mut look);
                let proved = |h: &Hypothesis| h.strong && h.exact && h.pieces.len() >= size / 2;
                if self.best[kind as usize - 1].as_ref().is_some_and(proved) {
                    return None;
                }
                if self.fits {
                    fitting.push(kind);
                }
            }
            kinds = fitting;
        }
        Some(disc[..disc.len().min(MOST_IN_RING)].to_vec())
    }

    /// Is more of this kind not to be had?
    fn settled(&self, kind: Kind) -> bool {
        self.best[kind as usize - 1]
            .as_ref()
            .is_some_and(|h| h.strong && h.pieces.len() >= COVERS)
    }

    /// Fits the kinds of which there is more to be had.
    fn attempt_all(&mut self, kinds: impl IntoIterator<Item = Kind>, mut look: Look) {
        for kind in kinds {
            if !self.settled(kind) {
                self.attempt(kind, &mut look);
            }
        }
    }

    /// Fits a kind to a neighbourhood and lets it grow. False if it has too few vertices for that.
    fn attempt(&mut self, kind: Kind, look: &mut Look) -> bool {
        if !look.can_tell(kind) {
            return false;
        }
        let question = (look.key, kind);
        let (before, asked) = self.before;
        if before.knows(question, asked) || self.tried.contains_key(&question) {
            return true;
        }
        let around = look.pieces;
        let Soil {
            view, tolerance, ..
        } = *self.soil;
        let Some(sample) = look.sample(view) else {
            self.tried.insert(question, f64::INFINITY);
            return true;
        };
        let mut nearest = f64::INFINITY;
        for guess in sample.guesses(kind) {
            let Some(fit) = refine(guess, &sample.cloud, tolerance) else {
                continue;
            };
            nearest = nearest.min(fit.rms);
            if fit.rms > tolerance || is_degenerate(&fit.surface) {
                continue;
            }
            self.fits = true;
            let slot = &mut self.best[kind as usize - 1];
            if slot.as_ref().is_some_and(|h| {
                view.fits(self.seed, &fit.surface, h.sign, tolerance) && {
                    let larger = h.pieces.len() > around.len() && around.len() <= MOST_IN_RING;
                    larger && around.iter().all(|p| h.pieces.contains(p))
                }
            }) {
                continue;
            }
            if let Some(grown) = self.soil.grow(self.seed, fit.surface, around.len()) {
                let larger = slot
                    .as_ref()
                    .is_none_or(|h| grown.pieces.len() > h.pieces.len());
                if larger {
                    *slot = Some(grown);
                }
            }
        }
        self.tried.insert(question, nearest);
        true
    }
}

/// Is a torus a sphere, its circle hardly more than a point?
fn is_degenerate(surface: &Surface) -> bool {
    surface.kind == Kind::Torus && surface.a.abs() < LEAST_TORUS * surface.b.abs()
}

/// Least major radius of a torus, in minor radii.
const LEAST_TORUS: f64 = 0.02;
