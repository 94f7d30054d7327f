//! Looks into the watched folders, when there is reason to, and says which files are ready.

use std::collections::HashSet;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use tracing::{info, warn};

use super::job::Job;
use crate::config::{Config, Watched};
use crate::scan::{Listing, scan};
use crate::tracker::StabilityTracker;

/// The watched folders, a tracker for each, and the time of the next look.
pub(super) struct Lookout {
    roots: Vec<Root>,
    /// Between looks while a file is still to settle, and the least time between any two.
    glance_every: Duration,
    rescan_every: Duration,
    looked_at: Option<Instant>,
    hinted: bool,
    /// With `--once`: the files of the first look, the only ones that count.
    only: Option<HashSet<PathBuf>>,
    once: bool,
}

struct Root {
    watched: Watched,
    tracker: StabilityTracker,
    /// What could not be read at the last look: each is said once.
    unreadable: HashSet<PathBuf>,
}

impl Lookout {
    pub(super) fn new(config: &Config, once: bool) -> Self {
        let root = |watched: &Watched| Root {
            watched: watched.clone(),
            tracker: StabilityTracker::new(watched.stable_for),
            unreadable: HashSet::new(),
        };
        let shortest = config.watch.iter().map(|watched| watched.stable_for).min();
        let glance_every = shortest.unwrap_or_default() / 4;
        Self {
            roots: config.watch.iter().map(root).collect(),
            glance_every: glance_every.clamp(Duration::from_millis(10), Duration::from_secs(1)),
            rescan_every: config.rescan_every,
            looked_at: None,
            hinted: false,
            only: None,
            once,
        }
    }

    /// Something changed: look soon.
    pub(super) fn hint(&mut self) {
        self.hinted = true;
    }

    /// How long until the next look is due.
    pub(super) fn wait(&self, now: Instant) -> Duration {
        let Some(looked_at) = self.looked_at else {
            return Duration::ZERO;
        };
        let soon = self.hinted || !self.is_settled();
        let every = if soon {
            self.glance_every
        } else {
            self.rescan_every
        };
        (looked_at + every).saturating_duration_since(now)
    }

    /// Looks into every folder; gives the files that became ready.
    pub(super) fn look(&mut self) -> Vec<Job> {
        self.hinted = false;
        let mut ready = Vec::new();
        let mut seen = HashSet::new();
        for (number, root) in self.roots.iter_mut().enumerate() {
            let Some(mut listing) = root.list() else {
                continue;
            };
            match &self.only {
                Some(only) => listing.files.retain(|file| only.contains(&file.path)),
                None if self.once => {
                    seen.extend(listing.files.iter().map(|file| file.path.clone()))
                }
                None => {}
            }
            let now = Instant::now();
            ready.extend(
                root.tracker
                    .step(now, &listing.files)
                    .into_iter()
                    .map(|file| Job {
                        relative: root.relative(&file.path),
                        path: file.path,
                        stamp: file.stamp,
                        root: number,
                        since: now,
                    }),
            );
        }
        if self.once {
            self.only.get_or_insert(seen);
        }
        self.looked_at = Some(Instant::now());
        ready
    }

    /// Every file that would be taken if it held still.
    pub(super) fn list(&mut self) -> Vec<PathBuf> {
        let listings = self.roots.iter_mut().filter_map(Root::list);
        let files = listings.flat_map(|listing| listing.files);
        files
            .filter(|file| file.stamp.size > 0)
            .map(|file| file.path)
            .collect()
    }

    /// The job's file was not ready after all.
    pub(super) fn take_back(&mut self, job: &Job) {
        self.roots[job.root]
            .tracker
            .take_back(Instant::now(), &job.path, job.stamp);
    }

    /// Is no file left that is still to become ready? Empty files, which wait for content, apart.
    pub(super) fn is_settled(&self) -> bool {
        self.roots.iter().all(|root| root.tracker.unsettled() == 0)
    }

    /// How many files are empty.
    pub(super) fn empty(&self) -> usize {
        self.roots.iter().map(|root| root.tracker.empty()).sum()
    }
}

impl Root {
    fn relative(&self, path: &Path) -> PathBuf {
        path.strip_prefix(&self.watched.root)
            .unwrap_or(path)
            .to_owned()
    }

    /// Lists the folder; nothing if it cannot be read. What cannot is said when it begins and when it ends.
    fn list(&mut self) -> Option<Listing> {
        let listed = scan(
            &self.watched.root,
            self.watched.recursive,
            &self.watched.include,
        );
        let (listing, unreadable) = match listed {
            Ok(mut listing) => {
                let unreadable = std::mem::take(&mut listing.unreadable);
                (Some(listing), unreadable)
            }
            Err(error) => (None, vec![(self.watched.root.clone(), error)]),
        };
        self.say(&unreadable);
        listing
    }

    fn say(&mut self, unreadable: &[(PathBuf, io::Error)]) {
        for (path, error) in unreadable
            .iter()
            .filter(|(path, _)| !self.unreadable.contains(path))
        {
            warn!("{} cannot be read: {error}", path.display());
        }
        let now: HashSet<_> = unreadable.iter().map(|(path, _)| path.clone()).collect();
        for path in self.unreadable.difference(&now) {
            info!("{} can be read again", path.display());
        }
        self.unreadable = now;
    }
}
