//! When has a file been written to its end? A pure state machine: the clock and the facts come from outside.
//!
//! That a writer closed its file is a hint and never proof (copies pause, programs reopen). A file is ready
//! when it has held still: same size, same time of change, same identity, for `stable_for` by a monotonic
//! clock. Times of change are compared with each other only, never with the clock, so that one in the
//! future, or a clock set back, does no harm.

use std::collections::HashMap;
use std::fs::Metadata;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// What tells one state of a file from another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Length in bytes.
    pub size: u64,
    /// Time of change, as the file system has it.
    pub modified: SystemTime,
    /// Device and inode: another file renamed into the place has others.
    pub identity: (u64, u64),
}

impl Stamp {
    /// The stamp of what a path led to.
    pub fn of(metadata: &Metadata) -> Self {
        Self {
            size: metadata.len(),
            modified: metadata.modified().unwrap_or(SystemTime::UNIX_EPOCH),
            identity: (metadata.dev(), metadata.ino()),
        }
    }
}

/// A file as a listing of the folder saw it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFact {
    /// Where it is.
    pub path: PathBuf,
    /// The state it was seen in.
    pub stamp: Stamp,
}

/// A file that has held still long enough, in the state in which it did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadyFile {
    /// Where it is.
    pub path: PathBuf,
    /// The state it was seen in; read something else, and it was not ready after all.
    pub stamp: Stamp,
}

#[derive(Clone, Copy, Debug)]
struct Watched {
    stamp: Stamp,
    still_since: Instant,
    given: bool,
}

/// Follows the files of one folder and gives each out once it holds still.
#[derive(Clone, Debug)]
pub struct StabilityTracker {
    stable_for: Duration,
    files: HashMap<PathBuf, Watched>,
}

impl StabilityTracker {
    /// A tracker that knows no file yet.
    pub fn new(stable_for: Duration) -> Self {
        Self {
            stable_for,
            files: HashMap::new(),
        }
    }

    /// Takes in a listing of the whole folder and gives the files that have become ready, in the order
    /// seen.
    ///
    /// A file is given once for each state it comes to rest in: not again until its stamp differs. A file
    /// that is gone is forgotten, so that it is a new one when it comes back. An empty file waits for
    /// content.
    pub fn step(&mut self, now: Instant, seen: &[FileFact]) -> Vec<ReadyFile> {
        let mut known = std::mem::take(&mut self.files);
        let mut ready = Vec::new();
        for FileFact { path, stamp } in seen {
            let mut file = match known.remove(path) {
                Some(file) if file.stamp == *stamp => file,
                _ => Watched {
                    stamp: *stamp,
                    still_since: now,
                    given: false,
                },
            };
            let still_for = now.saturating_duration_since(file.still_since);
            if !file.given && stamp.size > 0 && still_for >= self.stable_for {
                file.given = true;
                ready.push(ReadyFile {
                    path: path.clone(),
                    stamp: *stamp,
                });
            }
            self.files.insert(path.clone(), file);
        }
        ready
    }

    /// Takes a file back that was given too early in the state `stamp`: it must hold still anew. Of no effect
    /// if the file has been seen in another state since, for which it waits already.
    pub fn take_back(&mut self, now: Instant, path: &Path, stamp: Stamp) {
        if let Some(file) = self.files.get_mut(path).filter(|file| file.stamp == stamp) {
            file.still_since = now;
            file.given = false;
        }
    }

    /// How many files are still to become ready, empty ones apart.
    pub fn unsettled(&self) -> usize {
        let unsettled = |file: &&Watched| !file.given && file.stamp.size > 0;
        self.files.values().filter(unsettled).count()
    }

    /// How many files are empty.
    pub fn empty(&self) -> usize {
        self.files
            .values()
            .filter(|file| file.stamp.size == 0)
            .count()
    }
}

#[cfg(test)]
mod tests;
