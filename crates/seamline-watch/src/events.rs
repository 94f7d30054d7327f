//! Hints that something changed in a watched folder.
//!
//! What the operating system tells is taken as "look soon" and as nothing more: events get lost, come
//! twice, come before the writing is done. What is true is found by listing the folder ([`mod@crate::scan`]).

use crossbeam_channel::{Receiver, bounded, never};
use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use tracing::warn;

use crate::config::Watched;

/// Listens to the watched folders for as long as it lives.
pub struct Events {
    hints: Receiver<()>,
    _watcher: Option<RecommendedWatcher>,
}

impl Events {
    /// Starts to listen. Where the system cannot, this is said once, and the periodic listing is left to
    /// find what changes.
    pub fn listen(watched: &[Watched]) -> Self {
        match start(watched) {
            Ok(events) => events,
            Err(error) => {
                warn!(
                    "changes are not heard of, folders are listed from time to time instead: {error}"
                );
                Self {
                    hints: never(),
                    _watcher: None,
                }
            }
        }
    }

    /// One message stands for any number of changes since the last one was taken.
    pub fn hints(&self) -> &Receiver<()> {
        &self.hints
    }
}

fn start(watched: &[Watched]) -> notify::Result<Events> {
    let (sender, hints) = bounded(1);
    let mut watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
        if event.is_err() || event.is_ok_and(|event| may_matter(event.kind)) {
            // Full: a hint is waiting already.
            let _ = sender.try_send(());
        }
    })?;
    for folder in watched {
        let mode = if folder.recursive {
            RecursiveMode::Recursive
        } else {
            RecursiveMode::NonRecursive
        };
        watcher.watch(&folder.root, mode)?;
    }
    Ok(Events {
        hints,
        _watcher: Some(watcher),
    })
}

/// Reading is no change: listing the folder would otherwise be the reason to list it again.
fn may_matter(kind: EventKind) -> bool {
    use notify::event::{AccessKind, AccessMode};
    match kind {
        EventKind::Access(AccessKind::Close(AccessMode::Write)) => true,
        EventKind::Access(_) => false,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::config::{After, Watcher};
    use crate::include::Patterns;

    #[test]
    fn a_new_file_gives_a_hint_and_reading_the_folder_gives_none() {
        let home = tempfile::tempdir().unwrap();
        let watched = Watched {
            root: home.path().to_owned(),
            recursive: true,
            include: Patterns::new(&["*"]).unwrap(),
            exclude: Patterns::new::<&str>(&[]).unwrap(),
            stable_for: Duration::from_millis(1),
            max_wait: Duration::from_millis(1),
            watcher: Watcher::Native,
            poll_every: Duration::from_millis(1),
            after: After::Keep,
        };
        let events = Events::listen(&[watched]);
        std::fs::write(home.path().join("part.stl"), "x").unwrap();
        assert!(events.hints().recv_timeout(Duration::from_secs(10)).is_ok());

        while events
            .hints()
            .recv_timeout(Duration::from_millis(200))
            .is_ok()
        {}
        std::fs::read(home.path().join("part.stl")).unwrap();
        let _ = std::fs::read_dir(home.path()).unwrap().count();
        assert!(
            events
                .hints()
                .recv_timeout(Duration::from_millis(200))
                .is_err()
        );
    }
}
