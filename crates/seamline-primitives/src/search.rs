//! The search for surfaces: from each smooth piece not yet explained, fits to small neighbourhoods, grown as
//! far as they hold.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::ScopeFifo;

use crate::around::{Around, Marks};
use crate::bends;
use crate::grow::Soil;
use crate::hypothesis::{Hypothesis, View};
use crate::scout::{About, Scout, Way};
use crate::seeds::Seeds;
use crate::tried::Tried;

/// Most seeds that are looked at side by side. More keep no more than two cores busy, and more of them turn out to be on
/// what another found.
const LANES: usize = 6;

/// All hypotheses worth weighing on the pieces that are `open`, in the order their seeds come: from the largest
/// piece down.
pub(crate) fn search(
    view: View,
    open: &[bool],
    tried: &Tried,
    rung: usize,
    tolerance: f64,
) -> Vec<Hypothesis> {
    let around = Around::new(view, open);
    let soil = || Soil {
        view,
        rung,
        tolerance,
        around: Around::new(view, open),
        on_it: Marks::default(),
    };
    let seeds = Seeds::new(&around, rung);
    let search = Search {
        around,
        tried,
        rung,
        soils: Mutex::new((0..LANES).map(|_| soil()).collect()),
        queue: Mutex::new(Queue {
            seeds,
            begun: 0,
            noted: 0,
            lanes: 1,
            early: BTreeMap::new(),
            found: Vec::new(),
        }),
    };
    rayon::scope_fifo(|scope| search.begin(&mut locked(&search.queue), scope));
    let Queue {
        mut found, noted, ..
    } = search
        .queue
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner);
    // Only exact ones are believed for it.
    if rung == 0 {
        found.extend(bends::tori(&mut soil(), tried, noted, &found));
    }
    found
}

/// Seeds that are looked at side by side.
///
/// Each begins once the answers of all but the last few before it are noted, and knows of no others, so that results do
/// not depend on the number of threads. How few: one more each time, and half as many when a seed turns out to be on what
/// another has found, as the first ones on a large surface do.
struct Search<'a> {
    around: Around<'a>,
    tried: &'a Tried,
    rung: usize,
    soils: Mutex<Vec<Soil<'a>>>,
    queue: Mutex<Queue>,
}

/// What is to do, and what was found.
struct Queue {
    seeds: Seeds,
    /// Seeds begun so far, and those whose answers are noted.
    begun: usize,
    noted: usize,
    /// How many may be under way.
    lanes: usize,
    /// Answers that wait for those of seeds before them.
    early: BTreeMap<usize, (u32, About)>,
    found: Vec<Hypothesis>,
}

impl Search<'_> {
    /// Begins as many seeds as may be under way now.
    fn begin<'s>(&'s self, queue: &mut Queue, scope: &ScopeFifo<'s>) {
        while queue.begun < queue.noted + queue.lanes {
            let Some(seed) = queue.seeds.next(&self.around) else {
                return;
            };
            let ways = queue.seeds.ways(seed, queue.begun);
            let (turn, known) = (queue.begun, queue.noted);
            queue.begun += 1;
            scope.spawn_fifo(move |scope| {
                let about = self.look(seed, &ways, known);
                let mut queue = locked(&self.queue);
                queue.early.insert(turn, (seed, about));
                self.note_all(&mut queue, scope);
            });
        }
    }

    /// Looks for surfaces about a seed, when so many before it are known.
    fn look(&self, seed: u32, ways: &[Way], known: usize) -> About {
        let mut soil = locked(&self.soils).pop().expect("one for each lane");
        let about = Scout::new(&mut soil, seed, self.tried, known).hypotheses(ways);
        locked(&self.soils).push(soil);
        about
    }

    /// Notes the answers whose turn it is.
    fn note_all<'s>(&'s self, queue: &mut Queue, scope: &ScopeFifo<'s>) {
        while let Some((seed, about)) = queue.early.remove(&queue.noted) {
            let turn = queue.noted;
            queue.noted += 1;
            if queue.seeds.covers(seed) {
                queue.lanes = queue.lanes.div_ceil(2);
            } else {
                queue.lanes = (queue.lanes + 1).min(LANES);
                queue.seeds.note(&self.around, seed, &about);
                self.tried.note(about.tried, self.rung, turn);
                queue.found.extend(about.hypotheses);
            }
            self.begin(queue, scope);
        }
    }
}

fn locked<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
}
