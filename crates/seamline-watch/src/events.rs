//! Hints that something changed in a watched folder.
//!
//! What the operating system tells is taken as "look here soon" and as nothing more: events get lost, come
//! twice, come before the writing is done. What is true is found by looking ([`mod@crate::scan`]).
//!
//! Each folder is either heard by events of the system or polled, which is the business of the caller
//! ([`Events::is_polled`]). A folder on a share is polled ([`crate::mounts`]), and so is one of which the
//! system refuses to tell: to lose files would be worse than to look often.

mod heard;
mod listener;
mod refusal;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use crossbeam_channel::{Receiver, Sender, bounded};
use tracing::{info, warn};

use crate::config::{Watched, Watcher};
use crate::mounts::trusts_events;
use listener::Listener;

/// Where to look.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hint {
    /// This path appeared, changed or went away. A folder stands for all that is or was below it.
    Changed(PathBuf),
    /// Anything may have changed, in any folder that is not polled.
    Everything {
        /// More changed than the system, or this program, could keep in mind; otherwise listening failed.
        overflow: bool,
    },
}

/// Listens to the watched folders for as long as it lives.
pub struct Events {
    roots: Vec<Root>,
    wake: Sender<()>,
    woken: Receiver<()>,
    /// What was said of folders that are polled: each thing once.
    said: HashSet<String>,
}

struct Root {
    watched: Watched,
    ear: Ear,
}

enum Ear {
    Native(Listener),
    Polled,
    /// The folder was not there to be listened to.
    Waiting,
}

impl Events {
    /// Starts to listen. List the folders after this: what changes from now on is heard of.
    ///
    /// A folder that is not there is no error; it is polled until [`Events::hear_again`]. One line is said for
    /// each folder that is polled without being meant to, with the reason and what to do about it.
    pub fn listen(watched: &[Watched]) -> Self {
        let (wake, woken) = bounded(1);
        let mut events = Self {
            roots: Vec::new(),
            wake,
            woken,
            said: HashSet::new(),
        };
        events.retarget(watched);
        events
    }

    /// Has a message when there is something to [`Events::take`]. One message stands for any number of changes.
    pub fn hints(&self) -> &Receiver<()> {
        &self.woken
    }

    /// What changed since this was called last, each path once, in no order; or [`Hint::Everything`] alone.
    ///
    /// By the time a new folder is named here, it is listened to with all below it: list it, and what comes
    /// later is heard of.
    pub fn take(&mut self) -> Vec<Hint> {
        let mut paths = HashSet::new();
        let mut overflow = None;
        for at in 0..self.roots.len() {
            let root = &mut self.roots[at];
            let Ear::Native(listener) = &mut root.ear else {
                continue;
            };
            let (heard, kept_up) = listener.take();
            if let Some(missed) = heard.missed() {
                overflow = Some(overflow == Some(true) || missed);
            }
            if heard.root_is_lost {
                paths.insert(root.watched.root.clone());
                self.begin(at);
            } else if let Err(error) = kept_up {
                // Not all of it is listened to any more: look at all of it once, and poll from now on.
                paths.insert(root.watched.root.clone());
                self.fall_back(at, &error);
            }
            paths.extend(heard.paths);
        }
        match overflow {
            Some(overflow) => vec![Hint::Everything { overflow }],
            None => paths.into_iter().map(Hint::Changed).collect(),
        }
    }

    /// Is this root one that has to be listed again and again, because nothing is heard of it?
    pub fn is_polled(&self, root: &Path) -> bool {
        !matches!(self.ear(root), Some(Ear::Native(_)))
    }

    fn ear(&self, root: &Path) -> Option<&Ear> {
        let mut roots = self.roots.iter();
        let root = roots.find(|known| known.watched.root == root)?;
        Some(&root.ear)
    }

    /// Listens anew to a root that went away and came back, or in whose place there is another folder (what
    /// is listened to is the folder and not its name). Looks again whether events can be trusted there. List
    /// the root after this. A root that is not among those listened to is passed over.
    pub fn hear_again(&mut self, watched: &Watched) {
        let mut roots = self.roots.iter();
        if let Some(at) = roots.position(|known| known.watched.root == watched.root) {
            self.roots[at].watched = watched.clone();
            self.begin(at);
        }
    }

    /// Listens to these roots and to no others. Those that are listened to already in the same way are left
    /// alone; list the others after this.
    pub fn retarget(&mut self, watched: &[Watched]) {
        let mut before = std::mem::take(&mut self.roots);
        for watched in watched {
            let known = before.iter().position(|root| {
                root.watched.root == watched.root
                    && root.watched.recursive == watched.recursive
                    && root.watched.watcher == watched.watcher
            });
            let ear = known.map_or(Ear::Waiting, |at| before.swap_remove(at).ear);
            let watched = watched.clone();
            self.roots.push(Root { watched, ear });
            if known.is_none() {
                self.begin(self.roots.len() - 1);
            }
        }
    }

    fn begin(&mut self, at: usize) {
        // Before the new one asks for its watches, the old one begins to give its own back.
        self.roots[at].ear = Ear::Waiting;
        let watched = self.roots[at].watched.clone();
        if watched.watcher == Watcher::Poll {
            self.roots[at].ear = Ear::Polled;
            return;
        }
        if !watched.root.is_dir() {
            return;
        }
        if watched.watcher == Watcher::Auto
            && let Err(share) = trusts_events(&watched.root)
            // Without recursion, what is mounted below is not looked at.
            && (watched.recursive || watched.root.starts_with(&share.mount_point))
        {
            let text = format!("{}: {share}", polled(&watched));
            if self.said.insert(text.clone()) {
                info!("{text}");
            }
            self.roots[at].ear = Ear::Polled;
            return;
        }
        match Listener::start(&watched.root, watched.recursive, self.wake.clone()) {
            Ok(listener) => self.roots[at].ear = Ear::Native(listener),
            // Gone in this very moment.
            Err(_) if !watched.root.exists() => {}
            Err(error) => self.fall_back(at, &error),
        }
    }

    fn fall_back(&mut self, at: usize, error: &notify::Error) {
        let root = &mut self.roots[at];
        root.ear = Ear::Polled;
        let text = format!(
            "{}: {}",
            polled(&root.watched),
            refusal::in_plain_words(error)
        );
        if self.said.insert(text.clone()) {
            warn!("{text}");
        }
    }
}

fn polled(watched: &Watched) -> String {
    let every = watched.poll_every.as_millis();
    format!("{} is listed every {every} ms", watched.root.display())
}

#[cfg(test)]
mod tests;
