//! What was tried already, on this rung of the ladder of tolerances and on those before.

use std::sync::{PoisonError, RwLock};

use foldhash::HashMap;

use crate::surface::Kind;

/// A neighbourhood, by the key of its pieces, and a kind of surface.
pub(crate) type Question = (u64, Kind);

/// What became of a question.
#[derive(Clone, Copy, Debug)]
struct Answer {
    rung: usize,
    /// When it was known: after so many seeds of this rung.
    turn: usize,
    /// Least root mean square distance of a fit.
    rms: f64,
}

/// When somebody asks: on which rung, with what tolerance, and after how many seeds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    pub rung: usize,
    pub tolerance: f64,
    pub turn: usize,
}

/// The neighbourhoods that were tried. Seeds are looked at side by side: each knows of what was known when it
/// began, and of nothing later, so that results do not depend on which is done first.
#[derive(Debug, Default)]
pub(crate) struct Tried {
    answers: RwLock<HashMap<Question, Answer>>,
}

impl Tried {
    /// Need a question not be asked? On the same rung it was; on one before, with a smaller tolerance, a fit came to
    /// an end farther off than now is asked, and would so again.
    pub fn knows(&self, question: Question, asked: Asked) -> bool {
        let answers = self.answers.read().unwrap_or_else(PoisonError::into_inner);
        answers.get(&question).is_some_and(|known| {
            if known.rung == asked.rung {
                known.turn < asked.turn
            } else {
                known.rms > asked.tolerance
            }
        })
    }

    /// Notes what a seed found out, the `turn`th of a rung.
    pub fn note(&self, answers: HashMap<Question, f64>, rung: usize, turn: usize) {
        let mut known = self.answers.write().unwrap_or_else(PoisonError::into_inner);
        for (question, rms) in answers {
            let answer = Answer { rung, turn, rms };
            let entry = known.entry(question).or_insert(answer);
            if entry.rung != rung {
                *entry = answer;
            }
        }
    }
}

/// A key with another, in this order.
pub(crate) fn mixed(key: u64, with: u64) -> u64 {
    (key.rotate_left(5) ^ with).wrapping_mul(MIXER)
}

/// Two to the 64 over the golden ratio: its products fill all bits.
const MIXER: u64 = 0x9e37_79b9_7f4a_7c15;

#[cfg(test)]
mod tests {
    use super::*;

    const QUESTION: Question = (7, Kind::Torus);

    fn asked(rung: usize, tolerance: f64, turn: usize) -> Asked {
        Asked {
            rung,
            tolerance,
            turn,
        }
    }

    fn known(rung: usize, turn: usize, rms: f64) -> Tried {
        let tried = Tried::default();
        tried.note([(QUESTION, rms)].into_iter().collect(), rung, turn);
        tried
    }

    #[test]
    fn a_seed_knows_what_was_known_when_it_began_and_nothing_later() {
        let tried = known(0, 3, 0.5);
        assert!(!tried.knows(QUESTION, asked(0, 1.0, 3)));
        assert!(tried.knows(QUESTION, asked(0, 1.0, 4)));
        assert!(!tried.knows((8, Kind::Torus), asked(0, 1.0, 4)));
    }

    #[test]
    fn on_the_next_rung_it_is_asked_again_only_if_it_came_near_enough() {
        let tried = known(0, 3, 0.5);
        assert!(tried.knows(QUESTION, asked(1, 0.4, 0)));
        assert!(!tried.knows(QUESTION, asked(1, 0.6, 0)));
        tried.note([(QUESTION, 0.5)].into_iter().collect(), 1, 0);
        assert!(tried.knows(QUESTION, asked(1, 0.6, 1)));
    }

    #[test]
    fn keys_depend_on_the_order() {
        let key = |of: [u64; 3]| of.into_iter().fold(0, mixed);
        assert_ne!(key([1, 2, 3]), key([3, 2, 1]));
    }
}
