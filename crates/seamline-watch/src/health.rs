//! Whether the daemon is alive, and whether it is ready for work; two different things.
//!
//! A daemon that is not alive should be killed and started again. One that is not ready waits for somebody
//! to mount a folder or clear a disk, and goes on by itself then: to kill it would help nobody.

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::shown;

/// The daemon counts as dead when the thread that keeps its books gave no sign of life for this long. That
/// thread beats every second or so; a slow disk under the ledger may hold it up for some seconds.
pub const BEAT_LIMIT: Duration = Duration::from_secs(30);

/// A reason not to be ready. Troubles are equal when they are of one kind and about one thing.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Trouble {
    /// The first look into the watched folders has not ended.
    Starting,
    /// The daemon is told to stop.
    Stopping,
    /// A watched folder is not there.
    FolderAway(PathBuf),
    /// The disk of a folder that is written to is full.
    DiskFull(PathBuf),
    /// A folder that is written to cannot be.
    NotWritable(PathBuf),
    /// The ledger cannot be written.
    Ledger(PathBuf),
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Starting => write!(f, "starting: the watched folders are not listed yet"),
            Self::Stopping => write!(f, "stopping"),
            Self::FolderAway(root) => write!(f, "the watched folder {} is away", shown(root)),
            Self::DiskFull(folder) => write!(f, "the disk of {} is full", shown(folder)),
            Self::NotWritable(folder) => write!(f, "{} cannot be written to", shown(folder)),
            Self::Ledger(file) => write!(f, "the ledger {} cannot be written", shown(file)),
        }
    }
}

/// How the daemon is. One thread beats and enters troubles, others ask.
#[derive(Debug)]
pub struct Health(Mutex<Inner>);

#[derive(Debug)]
struct Inner {
    beat: Instant,
    troubles: BTreeMap<Trouble, String>,
}

impl Default for Health {
    fn default() -> Self {
        Self::new()
    }
}

impl Health {
    /// Alive, and [`Trouble::Starting`].
    pub fn new() -> Self {
        Self(Mutex::new(Inner {
            beat: Instant::now(),
            troubles: BTreeMap::from([(Trouble::Starting, String::new())]),
        }))
    }

    /// A sign of life.
    pub fn beat(&self) {
        self.beat_at(Instant::now());
    }

    pub(crate) fn beat_at(&self, now: Instant) {
        self.inner().beat = now;
    }

    /// From now on there is this trouble, until it is cleared. `why` is what the system says about it, and may
    /// be empty; that of an earlier call is forgotten.
    pub fn raise(&self, trouble: Trouble, why: &str) {
        self.inner().troubles.insert(trouble, one_line(why));
    }

    /// There is this trouble no more. Nothing happens if there was not.
    pub fn clear(&self, trouble: &Trouble) {
        self.inner().troubles.remove(trouble);
    }

    /// Whether there was a sign of life within [`BEAT_LIMIT`] before `now`. The clock is the monotonic one, which
    /// stands still while the machine sleeps.
    pub fn is_alive(&self, now: Instant) -> bool {
        self.silence(now) <= BEAT_LIMIT
    }

    /// How long before `now` the last sign of life was.
    pub fn silence(&self, now: Instant) -> Duration {
        now.saturating_duration_since(self.inner().beat)
    }

    /// Why the daemon is not ready at `now`, one line a reason, in a fixed order; empty: it is. To be dead is a
    /// reason too, as a dead daemon clears no troubles and raises none.
    pub fn troubles(&self, now: Instant) -> Vec<String> {
        let silence = self.silence(now);
        let dead =
            (silence > BEAT_LIMIT).then(|| format!("no sign of life for {} s", silence.as_secs()));
        let inner = self.inner();
        let others = inner.troubles.iter().map(|(trouble, why)| {
            if why.is_empty() {
                trouble.to_string()
            } else {
                format!("{trouble}: {why}")
            }
        });
        dead.into_iter().chain(others).collect()
    }

    /// What is in there is whole after every step, so that a panic elsewhere does not spoil it.
    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn one_line(text: &str) -> String {
    text.split(char::is_control).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_not_ready_until_the_first_look_has_ended() {
        let health = Health::new();
        let now = Instant::now();
        assert_eq!(
            health.troubles(now),
            ["starting: the watched folders are not listed yet"]
        );
        assert!(health.is_alive(now));
        health.clear(&Trouble::Starting);
        assert!(health.troubles(now).is_empty());
    }

    #[test]
    fn it_is_alive_for_the_limit_after_a_beat_and_no_longer() {
        let health = Health::new();
        health.clear(&Trouble::Starting);
        let beat = Instant::now();
        health.beat_at(beat);
        let just = beat + BEAT_LIMIT;
        assert!(health.is_alive(just));
        assert!(health.troubles(just).is_empty());

        let late = beat + BEAT_LIMIT + Duration::from_secs(12);
        assert!(!health.is_alive(late));
        assert_eq!(health.troubles(late), ["no sign of life for 42 s"]);

        health.beat_at(late);
        assert!(health.is_alive(late));
        assert!(health.troubles(late).is_empty());
    }

    #[test]
    fn a_beat_after_the_question_was_asked_counts() {
        let health = Health::new();
        let asked = Instant::now();
        health.beat_at(asked + Duration::from_secs(1));
        assert!(health.is_alive(asked));
    }

    #[test]
    fn each_trouble_is_cleared_on_its_own() {
        let health = Health::new();
        health.clear(&Trouble::Starting);
        let [a, b] = ["/in/a", "/in/b"].map(PathBuf::from);
        health.raise(Trouble::FolderAway(b.clone()), "");
        health.raise(Trouble::FolderAway(a.clone()), "");
        health.raise(Trouble::DiskFull(a.clone()), "");
        let now = Instant::now();
        assert_eq!(
            health.troubles(now),
            [
                "the watched folder /in/a is away",
                "the watched folder /in/b is away",
                "the disk of /in/a is full"
            ]
        );
        health.clear(&Trouble::FolderAway(a.clone()));
        health.clear(&Trouble::FolderAway(a.clone()));
        health.clear(&Trouble::DiskFull(b));
        assert_eq!(
            health.troubles(now),
            [
                "the watched folder /in/b is away",
                "the disk of /in/a is full"
            ]
        );
    }

    #[test]
    fn a_trouble_raised_again_is_one_trouble_with_the_last_reason() {
        let health = Health::new();
        health.clear(&Trouble::Starting);
        let trouble = || Trouble::Ledger("/state/ledger.sqlite".into());
        health.raise(trouble(), "disk I/O error");
        health.raise(trouble(), "database is locked");
        let lines = health.troubles(Instant::now());
        assert_eq!(
            lines,
            ["the ledger /state/ledger.sqlite cannot be written: database is locked"]
        );
        health.clear(&trouble());
        assert!(health.troubles(Instant::now()).is_empty());
    }

    #[test]
    fn every_reason_is_one_line() {
        let health = Health::new();
        health.clear(&Trouble::Starting);
        health.raise(
            Trouble::NotWritable("/o\nut".into()),
            "denied\nby the system",
        );
        assert_eq!(
            health.troubles(Instant::now()),
            ["/o\\nut cannot be written to: denied by the system"]
        );
    }
}
