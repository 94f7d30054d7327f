//! One watched folder: what is known of it, and where to look next.

use std::collections::{BTreeSet, HashSet};
use std::fs;
use std::io;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use tracing::{info, warn};

use super::Ready;
use crate::config::Watched;
use crate::events::Events;
use crate::mounts::is_mount_point;
use crate::scan::{Listing, Search};
use crate::shown;
use crate::tracker::{Facts, FileFact, ReadyFile, StabilityTracker};

pub(super) struct Root {
    watched: Watched,
    /// Are markings of meshes looked for as well?
    markings: bool,
    pub tracker: StabilityTracker,
    /// When the folder is to be listed as a whole; nothing if it is away.
    pub next_listing: Option<Instant>,
    /// Where something has changed.
    noted: BTreeSet<PathBuf>,
    /// Why it is away.
    away: Option<String>,
    was_mounted: bool,
    /// Device and inode.
    identity: Option<(u64, u64)>,
    /// What could not be read at the last look: each is said once.
    unreadable: HashSet<PathBuf>,
}

impl Root {
    pub(super) fn new(watched: Watched, markings: bool) -> Self {
        Self {
            markings,
            tracker: StabilityTracker::new(watched.stable_for, watched.max_wait),
            was_mounted: is_mount_point(&watched.root).unwrap_or(false),
            watched,
            next_listing: None,
            noted: BTreeSet::new(),
            away: None,
            identity: None,
            unreadable: HashSet::new(),
        }
    }

    pub(super) fn with(mut self, watched: Watched, markings: bool) -> Self {
        self.markings = markings;
        self.tracker.set_waits(watched.stable_for, watched.max_wait);
        self.watched = watched;
        self
    }

    pub(super) fn watched(&self) -> &Watched {
        &self.watched
    }

    pub(super) fn away(&self) -> Option<&str> {
        self.away.as_deref()
    }

    pub(super) fn is_away(&self) -> bool {
        self.away.is_some()
    }

    /// List the whole folder at the next look.
    pub(super) fn list_next(&mut self) {
        self.next_listing = Some(Instant::now());
    }

    /// Something changed at this path.
    pub(super) fn note(&mut self, path: &Path) {
        if path == self.watched.root {
            self.list_next();
        } else {
            self.noted.insert(path.to_owned());
        }
    }

    pub(super) fn is_listing_due(&self, now: Instant) -> bool {
        self.next_listing.is_some_and(|next| next <= now)
    }

    /// Is the folder there, and is it the one it was? Says when it goes and when it comes back.
    pub(super) fn check_presence(&mut self, events: &mut Events) {
        let identity = match self.identity_now() {
            Ok(identity) => identity,
            Err(why) => {
                if self.away.is_none() {
                    warn!(
                        "{}: {why}; waiting for it to come back",
                        shown(&self.watched.root)
                    );
                }
                self.away = Some(why);
                self.next_listing = None;
                return;
            }
        };
        let returned = self.away.take().is_some();
        if returned {
            info!("{} is back", shown(&self.watched.root));
            self.was_mounted = is_mount_point(&self.watched.root).unwrap_or(false);
        }
        let replaced = self.identity.is_some_and(|known| known != identity);
        if returned || replaced {
            events.hear_again(&self.watched);
            self.list_next();
        }
        self.identity = Some(identity);
    }

    fn identity_now(&self) -> Result<(u64, u64), String> {
        let root = &self.watched.root;
        let gone = |error: io::Error| format!("the folder cannot be looked into: {error}");
        let found = fs::metadata(root).map_err(gone)?;
        if !found.is_dir() {
            return Err("is no folder any more".to_owned());
        }
        // An empty mount point looks like a folder from which everything was taken.
        if self.was_mounted && !is_mount_point(root).map_err(gone)? {
            return Err("nothing is mounted there any more".to_owned());
        }
        Ok((found.dev(), found.ino()))
    }

    /// Lists the whole folder; the next listing is due after `every`.
    pub(super) fn list(&mut self, every: Duration) -> Vec<Ready> {
        if self.is_away() {
            return Vec::new();
        }
        self.next_listing = Some(Instant::now() + every);
        self.noted.clear();
        match self.search().all() {
            Ok(listing) => {
                let now = Instant::now();
                let ready = self.tracker.step(now, Facts::All(&listing.files));
                self.say(&listing);
                self.ready(ready)
            }
            Err(error) => {
                let root = self.watched.root.clone();
                let unreadable = vec![(root, error)];
                self.say(&Listing {
                    unreadable,
                    ..Listing::default()
                });
                Vec::new()
            }
        }
    }

    /// Looks where something changed and at what is still to settle; with `news` false only at the latter.
    pub(super) fn glance(&mut self, news: bool) -> Vec<Ready> {
        if self.is_away() {
            return Vec::new();
        }
        let mut noted = std::mem::take(&mut self.noted);
        if !news {
            noted.clear();
        }
        noted.extend(self.tracker.unsettled().cloned());
        let mut listing = Listing::default();
        for path in &noted {
            self.search().at(path, &mut listing);
        }
        let facts = Facts::Some {
            found: &listing.files,
            gone: &listing.gone,
        };
        let ready = self.tracker.step(Instant::now(), facts);
        self.ready(ready)
    }

    /// All files that would be taken if they held still.
    pub(super) fn files(&mut self) -> Vec<FileFact> {
        let mut listing = self.search().all().unwrap_or_default();
        self.say(&listing);
        listing.files.retain(|file| file.stamp.size > 0);
        listing.files
    }

    fn search(&self) -> Search<'_> {
        Search {
            root: &self.watched.root,
            recursive: self.watched.recursive,
            include: &self.watched.include,
            exclude: &self.watched.exclude,
            markings: self.markings,
        }
    }

    fn ready(&self, files: Vec<ReadyFile>) -> Vec<Ready> {
        let root = &self.watched.root;
        files
            .into_iter()
            .map(|file| Ready {
                relative: file
                    .path
                    .strip_prefix(root)
                    .unwrap_or(&file.path)
                    .to_owned(),
                markings: None,
                unpaired: None,
                file,
            })
            .collect()
    }

    /// What cannot be read is said when it begins and when it ends.
    fn say(&mut self, listing: &Listing) {
        let unreadable = &listing.unreadable;
        let fresh = |path: &&(PathBuf, io::Error)| !self.unreadable.contains(&path.0);
        for (path, error) in unreadable.iter().filter(fresh) {
            warn!("{} cannot be read: {error}", shown(path));
        }
        let now: HashSet<_> = unreadable.iter().map(|(path, _)| path.clone()).collect();
        for path in self.unreadable.difference(&now) {
            info!("{} can be read again", shown(path));
        }
        self.unreadable = now;
    }
}
