//! Which pieces surfaces are looked for about, and in what ways.

use crate::LOOSEST;
use crate::around::Around;
use crate::climb::least_evidence;
use crate::hypothesis::Hypothesis;
use crate::scout::{About, COVERS, Way};

/// After so many seeds in vain one more piece about each further one is none: a large free form takes as many
/// seeds as the root of its pieces. With 8 small patches are passed over (`smooth_cube-fine` of the bench has 29 for
/// 26), 32 finds no more.
const IN_A_ROW: usize = 16;
/// After so many seeds in vain, and on looser rungs from the beginning, each further one is looked at in every second way
/// only, and after so many in every fourth: in turn, so that a surface of many pieces is looked for in all of them. It
/// saves a fifth of the time over the bench; scores over it and two sets of 132 and 161 meshes stay within .001.
const HALF: usize = 48;
const QUARTER: usize = 128;
/// A surface looked for on a looser rung has many pieces, so that some seeds among them suffice: about so many
/// for all that is open.
const SEEDS: [usize; 3] = [usize::MAX, 1500, 200];
/// Pieces whose areas differ by more than this factor say nothing of each other.
const ALIKE: f64 = 3.0;

/// The pieces that may be seeds, and what is known of them so far.
pub(crate) struct Seeds {
    /// Pieces that are none so far, the largest last.
    left: Vec<u32>,
    /// Is a piece on a strong hypothesis?
    covered: Vec<bool>,
    /// Was a seed here, or near here, in vain?
    failed: Vec<bool>,
    /// Is a piece in the midst of discs that are on no surface?
    amid_failure: Vec<bool>,
    /// Seeds in vain one after the other.
    in_a_row: usize,
    /// The rung of the ladder of tolerances.
    rung: usize,
    /// Pieces about a seed in vain that are none either.
    least: usize,
}

impl Seeds {
    /// All pieces `around` may take part, as far as they have neighbours.
    pub fn new(around: &Around, rung: usize) -> Self {
        let pieces = around.view.pieces;
        let area = |p: u32| pieces.areas[p as usize];
        let mut all: Vec<u32> = (0..pieces.count() as u32)
            .filter(|&p| around.open[p as usize] && around.neighbours(p).next().is_some())
            .collect();
        all.sort_unstable_by(|&a, &b| area(a).total_cmp(&area(b)).then(b.cmp(&a)));
        Self {
            least: 1 + all.len() / SEEDS[rung],
            left: all,
            covered: vec![false; pieces.count()],
            failed: vec![false; pieces.count()],
            amid_failure: vec![false; pieces.count()],
            in_a_row: 0,
            rung,
        }
    }

    /// The next piece to be a seed.
    pub fn next(&mut self, around: &Around) -> Option<u32> {
        while let Some(seed) = self.left.pop() {
            if self.wants(around, seed) {
                return Some(seed);
            }
        }
        None
    }

    /// Is a piece on a strong hypothesis?
    pub fn covers(&self, piece: u32) -> bool {
        self.covered[piece as usize]
    }

    /// Is a piece to be a seed? Beside a seed that was in vain another of its size rarely is not, and free forms
    /// are all such.
    fn wants(&self, around: &Around, seed: u32) -> bool {
        let tells = |p: u32| self.failed[p as usize] && around.are_alike(p, seed, ALIKE);
        !self.covered[seed as usize] && !around.neighbours(seed).any(tells)
    }

    /// In what ways surfaces are looked for about a seed, the `turn`th.
    pub fn ways(&self, seed: u32, turn: usize) -> Vec<Way> {
        let all = Way::all(self.rung);
        let groups = match (self.rung, self.in_a_row) {
            (_, QUARTER..) => 4,
            (0, ..HALF) => 1,
            _ => 2,
        };
        let groups = all.len().min(groups);
        let numbered = all.iter().copied().enumerate();
        numbered
            .filter(|&(i, way)| {
                let discs = !self.amid_failure[seed as usize];
                i * groups / all.len() == turn % groups && (discs || way != Way::Discs)
            })
            .map(|(_, way)| way)
            .collect()
    }

    /// Notes what was found about a seed.
    pub fn note(&mut self, around: &Around, seed: u32, found: &About) {
        for &piece in &found.midst {
            self.amid_failure[piece as usize] = true;
        }
        // What is not exact, or too little at the loosest tolerance, is not believed for itself.
        let counts = |h: &Hypothesis| match self.rung {
            0 => h.exact,
            LOOSEST => h.evidence >= least_evidence(LOOSEST, h.surface.kind),
            _ => true,
        };
        if found.hypotheses.iter().any(|h| h.strong && counts(h)) {
            self.in_a_row /= 2;
        } else {
            self.in_a_row += 1;
            self.mark_about(around, seed, self.least + self.in_a_row / IN_A_ROW);
        }
        let covers = |h: &&Hypothesis| h.strong && h.pieces.len() >= COVERS;
        for hypothesis in found.hypotheses.iter().filter(covers) {
            for &piece in &hypothesis.pieces {
                self.covered[piece as usize] = true;
            }
        }
    }

    /// Marks a seed in vain and the pieces about it, `most` at most.
    fn mark_about(&mut self, around: &Around, seed: u32, most: usize) {
        let mut region = vec![seed];
        self.failed[seed as usize] = true;
        let mut at = 0;
        while at < region.len() && region.len() < most {
            for across in around.neighbours(region[at]) {
                if !std::mem::replace(&mut self.failed[across as usize], true) {
                    region.push(across);
                }
            }
            at += 1;
        }
    }
}
