//! Events of the system for one folder.
//!
//! Each folder is given to `notify` by itself and not as a tree. A tree ends at the first folder that may not
//! be read or that vanishes while it is walked, with the rest of it unheard; and what is made in a new folder
//! before `notify` has got to it is never heard of. Here a new folder is listened to before it is named to
//! anybody, so that who lists it then misses nothing.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crossbeam_channel::Sender;
use notify::{Config, ErrorKind, Event, RecommendedWatcher, RecursiveMode, Watcher};
use tracing::debug;

use super::heard::Heard;
use crate::include::is_finished_name;

/// Listens to one root for as long as it lives. A watcher of the system for each root: one that is gone, or
/// that met a limit, is dropped without touching the others.
pub(super) struct Listener {
    root: PathBuf,
    recursive: bool,
    heard: Arc<Mutex<Heard>>,
    watcher: RecommendedWatcher,
}

impl Listener {
    /// # Errors
    ///
    /// The system has no watcher to give, or not for all folders below the root.
    pub fn start(root: &Path, recursive: bool, wake: Sender<()>) -> notify::Result<Self> {
        let heard = Arc::new(Mutex::new(Heard::default()));
        let (to, at) = (Arc::clone(&heard), root.to_owned());
        let hear = move |event: notify::Result<Event>| {
            if lock(&to).note(&at, event) {
                // Full: it wakes already.
                let _ = wake.try_send(());
            }
        };
        let mut listener = Self {
            root: root.to_owned(),
            recursive,
            heard,
            watcher: RecommendedWatcher::new(hear, Config::default())?,
        };
        listener.watch(root)?;
        Ok(listener)
    }

    /// What was heard since the last call; new folders are listened to by the time this returns.
    ///
    /// The second is an error if a new folder cannot be listened to: the listener is of no more use then.
    pub fn take(&mut self) -> (Heard, notify::Result<()>) {
        let heard = lock(&self.heard).take();
        let kept_up = self.keep_up(&heard);
        (heard, kept_up)
    }

    fn keep_up(&mut self, heard: &Heard) -> notify::Result<()> {
        if !self.recursive || heard.root_is_lost {
            return Ok(());
        }
        if heard.missed().is_some() {
            return self.watch(&self.root.clone());
        }
        for path in &heard.perhaps_folders {
            if fs::symlink_metadata(path).is_ok_and(|found| found.is_dir()) {
                self.watch(path)?;
            }
        }
        Ok(())
    }

    /// Listens to a folder and, with recursion, to those below it that are looked into. Folders that may not
    /// be read are left out: the listing says so, and a change of their rights is heard.
    fn watch(&mut self, folder: &Path) -> notify::Result<()> {
        let mut folders = vec![folder.to_owned()];
        while let Some(folder) = folders.pop() {
            if let Err(error) = self.watcher.watch(&folder, RecursiveMode::NonRecursive) {
                if folder != self.root && is_of_this_folder(&error) {
                    debug!("{} is not listened to: {error}", folder.display());
                    continue;
                }
                return Err(error);
            }
            // After it is listened to: what is made in it from now on is heard of.
            if self.recursive {
                folders.extend(folders_in(&folder));
            }
        }
        Ok(())
    }

    #[cfg(test)]
    pub fn deafen(&self) -> MutexGuard<'_, Heard> {
        lock(&self.heard)
    }
}

fn lock(heard: &Mutex<Heard>) -> MutexGuard<'_, Heard> {
    heard.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The folders in this one that are looked into; links are not followed.
fn folders_in(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let folders = entries.filter(|entry| {
        is_finished_name(&entry.file_name()) && entry.file_type().is_ok_and(|kind| kind.is_dir())
    });
    folders.map(|entry| entry.path()).collect()
}

/// Gone, or not to be read, which says nothing of the others.
fn is_of_this_folder(error: &notify::Error) -> bool {
    match &error.kind {
        ErrorKind::PathNotFound => true,
        ErrorKind::Io(error) => matches!(
            error.kind(),
            io::ErrorKind::NotFound | io::ErrorKind::PermissionDenied
        ),
        _ => false,
    }
}
