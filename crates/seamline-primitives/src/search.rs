//! The search for surfaces: from each smooth piece not yet explained, fits to small neighbourhoods, grown as
//! far as they hold.

use rayon::prelude::*;

use crate::LOOSEST;
use crate::around::{Around, Marks};
use crate::bends;
use crate::climb::least_evidence;
use crate::grow::Soil;
use crate::hypothesis::{Hypothesis, View};
use crate::scout::{About, COVERS, Scout, Tried};

/// After so many seeds in vain one more piece about each further one is none: a large free form takes as many
/// seeds as the root of its pieces. With 8 small patches are passed over (`smooth_cube-fine` of the bench has 29 for
/// 26), 32 finds no more.
const IN_A_ROW: usize = 16;
/// A surface looked for on a looser rung has many pieces, so that some seeds among them suffice: about so many
/// for all that is open.
const SEEDS: [usize; 3] = [usize::MAX, 1000, 300];
/// Pieces whose areas differ by more than this factor say nothing of each other.
const ALIKE: f64 = 3.0;
/// Most seeds that are looked at side by side.
const LANES: usize = 8;

/// All hypotheses worth weighing on the pieces that are `open`, in the order their seeds come: from the largest
/// piece down.
///
/// Seeds are looked at side by side, one more each time, and half as many for each that turned out to be on
/// what another had found. How many depends on the seeds alone, so that results do not depend on the number of
/// threads.
pub(crate) fn search(view: View, open: &[bool], rung: usize, tolerance: f64) -> Vec<Hypothesis> {
    let pieces = view.pieces;
    let around = Around::new(view, open);
    let area = |p: u32| pieces.areas[p as usize];
    let mut seeds: Vec<u32> = (0..pieces.count() as u32)
        .filter(|&p| open[p as usize] && around.neighbours(p).next().is_some())
        .collect();
    seeds.sort_by(|&a, &b| area(b).total_cmp(&area(a)));
    let mut state = State {
        covered: vec![false; pieces.count()],
        failed: vec![false; pieces.count()],
        amid_failure: vec![false; pieces.count()],
        in_a_row: 0,
        rung,
        least: 1 + seeds.len() / SEEDS[rung],
    };
    let soil = || Soil {
        view,
        rung,
        tolerance,
        around: Around::new(view, open),
        on_it: Marks::default(),
    };
    let mut lanes: Vec<Soil> = Vec::new();
    let mut tried = Tried::new();
    let mut found = Vec::new();
    let mut left = seeds.into_iter();
    let mut side_by_side = 1;
    loop {
        let batch: Vec<u32> = left
            .by_ref()
            .filter(|&seed| state.wants(&around, seed))
            .take(side_by_side)
            .collect();
        if batch.is_empty() {
            // Only exact ones are believed for it.
            if rung == 0 {
                found.extend(bends::tori(&mut soil(), &tried, &found));
            }
            return found;
        }
        if lanes.len() < batch.len() {
            lanes.resize_with(batch.len(), soil);
        }
        let about: Vec<About> = batch
            .par_iter()
            .zip(&mut lanes)
            .with_max_len(1)
            .map(|(&seed, soil)| {
                Scout::new(soil, seed, &tried).hypotheses(!state.amid_failure[seed as usize])
            })
            .collect();
        side_by_side = (side_by_side + 1).min(LANES);
        for (seed, mut about) in batch.into_iter().zip(about) {
            if state.covered[seed as usize] {
                side_by_side = side_by_side.div_ceil(2);
            } else {
                tried.extend(about.tried.drain());
                state.note(&around, seed, &about);
                found.extend(about.hypotheses);
            }
        }
    }
}

/// What is known of the pieces so far.
struct State {
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

impl State {
    /// Is a piece to be a seed? Beside a seed that was in vain another of its size rarely is not, and free forms
    /// are all such.
    fn wants(&self, around: &Around, seed: u32) -> bool {
        let area = |p: u32| around.view.pieces.areas[p as usize];
        let alike = |p: u32| (1.0 / ALIKE..=ALIKE).contains(&(area(p) / area(seed)));
        let mut neighbours = around.neighbours(seed);
        !self.covered[seed as usize] && !neighbours.any(|p| self.failed[p as usize] && alike(p))
    }

    fn note(&mut self, around: &Around, seed: u32, found: &About) {
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
