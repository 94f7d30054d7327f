//! Looks into the watched folders, when there is reason to, and says which files are ready.

mod root;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::config::{Config, innermost};
use crate::events::{Events, Hint};
use crate::pairs::Unpaired;
use crate::tracker::{FileFact, ReadyFile, Stamp};
use root::Root;

/// How often it is looked whether the folders are there.
const PRESENCE_EVERY: Duration = Duration::from_secs(1);

/// A file that has held still.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ready {
    /// The file.
    pub file: ReadyFile,
    /// Its path within the watched folder.
    pub relative: PathBuf,
    /// What is marked on it, where that is half of the work.
    pub markings: Option<FileFact>,
    /// It is half of a pair that cannot be worked on.
    pub unpaired: Option<Unpaired>,
}

/// What a look has found.
#[derive(Debug, Default)]
pub(super) struct Look {
    /// Files that have become ready.
    pub ready: Vec<Ready>,
    /// How many folders were listed as a whole.
    pub scans: usize,
    /// How often the system has lost count of the changes.
    pub overflows: usize,
    /// With `once`: files that have not held still for as long as is waited for any, and are given up.
    pub restless: Vec<PathBuf>,
}

/// The watched folders, a tracker for each, and the time of the next look.
pub(super) struct Lookout {
    roots: Vec<Root>,
    /// Between looks while a file is still to settle, and the least time between any two.
    glance_every: Duration,
    rescan_every: Duration,
    looked_at: Option<Instant>,
    /// When the next look is due; nothing if that has to be found out anew.
    due: Option<Instant>,
    hinted: bool,
    once: bool,
}

impl Lookout {
    pub(super) fn new(config: &Config, markings: bool, once: bool) -> Self {
        let mut lookout = Self {
            roots: Vec::new(),
            glance_every: Duration::ZERO,
            rescan_every: Duration::ZERO,
            looked_at: None,
            due: None,
            hinted: false,
            once,
        };
        lookout.retarget(config, markings);
        lookout
    }

    /// From now on another configuration holds. What is known of a folder that is watched as before stays
    /// known; every folder is listed anew. With `markings` those of meshes are looked for as well.
    pub(super) fn retarget(&mut self, config: &Config, markings: bool) {
        let mut before = std::mem::take(&mut self.roots);
        for watched in &config.watch {
            let known = before
                .iter()
                .position(|root| root.watched().root == watched.root);
            self.roots.push(match known {
                Some(known) => before.swap_remove(known).with(watched.clone(), markings),
                None => Root::new(watched.clone(), markings),
            });
        }
        let shortest = config.watch.iter().map(|watched| watched.stable_for).min();
        let glance_every = shortest.unwrap_or_default() / 4;
        self.glance_every = glance_every.clamp(Duration::from_millis(10), Duration::from_secs(1));
        self.rescan_every = config.rescan_every;
        self.looked_at = None;
        self.due = None;
    }

    /// Something changed: look soon.
    pub(super) fn hint(&mut self) {
        if !self.hinted {
            self.hinted = true;
            self.due = None;
        }
    }

    /// How long until the next look is due.
    pub(super) fn wait(&mut self, now: Instant) -> Duration {
        let Some(looked_at) = self.looked_at else {
            return Duration::ZERO;
        };
        let due = match self.due {
            Some(due) => due,
            None => *self.due.insert(self.next_look(looked_at)),
        };
        due.saturating_duration_since(now)
    }

    fn next_look(&self, looked_at: Instant) -> Instant {
        let soon = self.hinted || self.roots.iter().any(|root| root.tracker.is_settling());
        let mut due = looked_at
            + if soon {
                self.glance_every
            } else {
                PRESENCE_EVERY
            };
        for root in &self.roots {
            let next = root
                .next_listing
                .into_iter()
                .chain(root.tracker.next_ready());
            due = next.fold(due, Instant::min);
        }
        // However much is due, there is a pause between two looks.
        due.max(looked_at + self.glance_every.min(PRESENCE_EVERY))
    }

    /// Looks wherever there is reason to.
    pub(super) fn look(&mut self, events: &mut Events) -> Look {
        let mut look = Look::default();
        self.hinted = false;
        for hint in events.take() {
            match hint {
                Hint::Changed(path) => self.note(&path),
                Hint::Everything { overflow } => {
                    look.overflows += usize::from(overflow);
                    self.roots.iter_mut().for_each(Root::list_next);
                }
            }
        }
        let first = self.looked_at.is_none();
        for root in &mut self.roots {
            root.check_presence(events);
            // With `once` only what lies there at the first look counts.
            let may_list = first || !self.once;
            if may_list && (first || root.is_listing_due(Instant::now())) {
                let every = if events.is_polled(&root.watched().root) {
                    root.watched().poll_every
                } else {
                    self.rescan_every
                };
                look.scans += 1;
                look.ready.extend(root.list(every));
            } else {
                look.ready.extend(root.glance(may_list));
            }
            if self.once {
                look.restless.extend(root.tracker.give_up(Instant::now()));
            }
        }
        self.looked_at = Some(Instant::now());
        self.due = None;
        look
    }

    fn note(&mut self, path: &Path) {
        if let Some(root) = self.root_of(path) {
            root.note(path);
        }
    }

    fn root_of(&mut self, path: &Path) -> Option<&mut Root> {
        self.due = None;
        innermost(self.roots.iter_mut(), path, |root| root.watched())
    }

    /// Every file that would be taken if it held still.
    pub(super) fn list(&mut self) -> Vec<FileFact> {
        self.roots.iter_mut().flat_map(Root::files).collect()
    }

    /// The file was not ready after all.
    pub(super) fn take_back(&mut self, path: &Path, stamp: Stamp) {
        if let Some(root) = self.root_of(path) {
            root.tracker.take_back(Instant::now(), path, stamp);
        }
    }

    /// The file says that there is more of it to come.
    pub(super) fn ends_early(&mut self, path: &Path, stamp: Stamp) {
        if let Some(root) = self.root_of(path) {
            root.tracker.ends_early(path, stamp);
        }
    }

    /// The file is to be given again.
    pub(super) fn look_again(&mut self, path: &Path) {
        if let Some(root) = self.root_of(path) {
            root.tracker.look_again(Instant::now(), path);
        }
    }

    /// Is nothing known to be at this path, although its folder was looked into?
    pub(super) fn is_missing(&mut self, path: &Path) -> bool {
        self.root_of(path)
            .is_some_and(|root| !root.is_away() && !root.tracker.knows(path))
    }

    /// Is a file there, still in the state in which it became ready?
    pub(super) fn holds(&self, file: &ReadyFile) -> bool {
        let root = innermost(self.roots.iter(), &file.path, |root| root.watched());
        root.is_some_and(|root| root.is_away() || root.tracker.holds(&file.path, file.stamp))
    }

    /// Is no file left that is still to hold still? Empty files, and those that end early, apart.
    pub(super) fn is_settled(&self) -> bool {
        self.looked_at.is_some() && self.roots.iter().all(|root| !root.tracker.is_settling())
    }

    /// How many files are empty.
    pub(super) fn empty(&self) -> usize {
        self.roots.iter().map(|root| root.tracker.empty()).sum()
    }

    /// Every watched folder, and why it is away if it is.
    pub(super) fn presence(&self) -> impl Iterator<Item = (&Path, Option<&str>)> {
        self.roots
            .iter()
            .map(|root| (root.watched().root.as_path(), root.away()))
    }
}
