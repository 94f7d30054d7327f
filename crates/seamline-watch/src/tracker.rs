//! When has a file been written to its end? A pure state machine: the clock and the facts come from outside.
//!
//! That a writer closed its file is a hint and never proof (copies pause, programs reopen). A file is ready
//! when it has held still: same size, same times of change, same identity, for `stable_for` by a monotonic
//! clock. Times of change are compared with each other only, never with the clock, so that one in the
//! future, or a clock set back, does no harm.

mod stamp;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

pub use stamp::Stamp;

/// A file as a look into the folder saw it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFact {
    /// Where it is.
    pub path: PathBuf,
    /// The state it was seen in.
    pub stamp: Stamp,
}

/// What a look into a folder found.
#[derive(Clone, Copy, Debug)]
pub enum Facts<'a> {
    /// Everything that is there: what is not among it is gone.
    All(&'a [FileFact]),
    /// What was found, and what was not, where one has looked; nothing is known of the rest.
    Some {
        /// The files that are there.
        found: &'a [FileFact],
        /// Files and folders that are not; with a folder goes all that was below it.
        gone: &'a [PathBuf],
    },
}

/// A file that has held still long enough, in the state in which it did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadyFile {
    /// Where it is.
    pub path: PathBuf,
    /// The state it was seen in; read something else, and it was not ready after all.
    pub stamp: Stamp,
    /// It was given before, said of itself that it ends early, and has held still for `max_wait` since.
    pub overdue: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Ready after `stable_for`.
    Settling,
    /// Ready after `max_wait`, then overdue.
    EndsEarly,
    Given,
}

#[derive(Clone, Copy, Debug)]
struct Watched {
    stamp: Stamp,
    still_since: Instant,
    /// Since when it has not come to rest, in whatever state it was.
    restless_since: Instant,
    phase: Phase,
}

/// Follows the files of one folder and gives each out once it holds still.
#[derive(Clone, Debug)]
pub struct StabilityTracker {
    stable_for: Duration,
    max_wait: Duration,
    files: BTreeMap<PathBuf, Watched>,
    /// Those that are still to be given, empty ones apart: what a step costs when nothing changes.
    unsettled: BTreeSet<PathBuf>,
}

impl StabilityTracker {
    /// A tracker that knows no file yet.
    pub fn new(stable_for: Duration, max_wait: Duration) -> Self {
        Self {
            stable_for,
            max_wait,
            files: BTreeMap::new(),
            unsettled: BTreeSet::new(),
        }
    }

    /// From now on other waits hold.
    pub fn set_waits(&mut self, stable_for: Duration, max_wait: Duration) {
        (self.stable_for, self.max_wait) = (stable_for, max_wait);
    }

    /// Takes in what was seen and gives the files that have become ready, by path.
    ///
    /// A file is given once for each state it comes to rest in: not again until its stamp differs. A file
    /// that is gone is forgotten, so that it is a new one when it comes back. An empty file waits for
    /// content.
    pub fn step(&mut self, now: Instant, facts: Facts<'_>) -> Vec<ReadyFile> {
        match facts {
            Facts::All(found) => {
                let seen: BTreeSet<&Path> = found.iter().map(|file| file.path.as_path()).collect();
                self.files.retain(|path, _| seen.contains(path.as_path()));
                self.unsettled.retain(|path| seen.contains(path.as_path()));
                found.iter().for_each(|file| self.see(now, file));
            }
            Facts::Some { found, gone } => {
                gone.iter().for_each(|path| self.lose(path));
                found.iter().for_each(|file| self.see(now, file));
            }
        }
        self.give(now)
    }

    fn see(&mut self, now: Instant, FileFact { path, stamp }: &FileFact) {
        let known = self.files.get(path);
        if known.is_some_and(|known| known.stamp == *stamp) {
            return;
        }
        let restless = known.filter(|known| known.phase == Phase::Settling);
        let fresh = Watched {
            stamp: *stamp,
            still_since: now,
            restless_since: restless.map_or(now, |known| known.restless_since),
            phase: Phase::Settling,
        };
        self.files.insert(path.clone(), fresh);
        if stamp.size > 0 {
            self.unsettled.insert(path.clone());
        } else {
            self.unsettled.remove(path);
        }
    }

    /// Paths are in order by their parts, so that all below a folder come right after it.
    fn lose(&mut self, path: &Path) {
        let below: Vec<PathBuf> = self
            .files
            .range(path.to_owned()..)
            .map(|(known, _)| known)
            .take_while(|known| known.starts_with(path))
            .cloned()
            .collect();
        for lost in below {
            self.files.remove(&lost);
            self.unsettled.remove(&lost);
        }
    }

    fn give(&mut self, now: Instant) -> Vec<ReadyFile> {
        let mut ready = Vec::new();
        for path in &self.unsettled {
            let Some(file) = self.files.get_mut(path) else {
                continue;
            };
            let wait = if file.phase == Phase::EndsEarly {
                self.max_wait
            } else {
                self.stable_for
            };
            if now.saturating_duration_since(file.still_since) >= wait {
                ready.push(ReadyFile {
                    path: path.clone(),
                    stamp: file.stamp,
                    overdue: file.phase == Phase::EndsEarly,
                });
                file.phase = Phase::Given;
            }
        }
        for given in &ready {
            self.unsettled.remove(&given.path);
        }
        ready
    }

    /// Takes a file back that was given in the state `stamp`: it must hold still anew. Of no effect if the
    /// file has been seen in another state since, for which it waits already.
    pub fn take_back(&mut self, now: Instant, path: &Path, stamp: Stamp) {
        if let Some(file) = self.files.get_mut(path).filter(|file| file.stamp == stamp) {
            file.still_since = now;
            file.restless_since = now;
            file.phase = Phase::Settling;
            self.unsettled.insert(path.to_owned());
        }
    }

    /// Takes a file back that was given in the state `stamp` and says of itself that there is more of it to
    /// come: it is given again when it has changed and settled, or as overdue when it has held still
    /// for `max_wait`. Of no effect if it has been seen in another state since.
    pub fn ends_early(&mut self, path: &Path, stamp: Stamp) {
        if let Some(file) = self.files.get_mut(path).filter(|file| file.stamp == stamp) {
            file.phase = Phase::EndsEarly;
            self.unsettled.insert(path.to_owned());
        }
    }

    /// Waits no longer for the files that have not come to rest for `max_wait`, and gives their paths.
    pub fn give_up(&mut self, now: Instant) -> Vec<PathBuf> {
        let (files, max_wait) = (&self.files, self.max_wait);
        let is_restless = |path: &PathBuf| {
            files.get(path).is_some_and(|file| {
                file.phase == Phase::Settling
                    && now.saturating_duration_since(file.restless_since) >= max_wait
            })
        };
        self.unsettled.extract_if(.., is_restless).collect()
    }

    /// Gives a file again once it has held still anew, whatever became of it before.
    pub fn look_again(&mut self, now: Instant, path: &Path) {
        if let Some(stamp) = self.files.get(path).map(|file| file.stamp) {
            self.take_back(now, path, stamp);
        }
    }

    /// Was a file given out in the state `stamp`, and has not been seen in another since?
    pub fn holds(&self, path: &Path, stamp: Stamp) -> bool {
        self.files
            .get(path)
            .is_some_and(|file| file.stamp == stamp && file.phase != Phase::Settling)
    }

    /// Is there a file at this path?
    pub fn knows(&self, path: &Path) -> bool {
        self.files.contains_key(path)
    }

    /// The files that are still to become ready, empty ones apart.
    pub fn unsettled(&self) -> impl Iterator<Item = &PathBuf> {
        self.unsettled.iter()
    }

    /// When the next file becomes ready if nothing changes; nothing if none waits.
    pub fn next_ready(&self) -> Option<Instant> {
        let of = |path: &PathBuf| {
            let file = self.files.get(path)?;
            Some(match file.phase {
                Phase::EndsEarly => file.still_since + self.max_wait,
                _ => file.still_since + self.stable_for,
            })
        };
        self.unsettled.iter().filter_map(of).min()
    }

    /// Does a file still have to hold still for `stable_for`?
    pub fn is_settling(&self) -> bool {
        let settling = |path| {
            self.files
                .get(path)
                .is_some_and(|file: &Watched| file.phase == Phase::Settling)
        };
        self.unsettled.iter().any(settling)
    }

    /// How many files are empty.
    pub fn empty(&self) -> usize {
        let empty = |file: &&Watched| file.stamp.size == 0;
        self.files.values().filter(empty).count()
    }
}

#[cfg(test)]
mod tests;
