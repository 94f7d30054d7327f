//! What was heard of one folder and not yet taken.

use std::collections::HashSet;
use std::mem;
use std::path::{Path, PathBuf};

use notify::event::{AccessKind, AccessMode, CreateKind, ModifyKind, RenameMode};
use notify::{Event, EventKind};

use crate::include::is_finished_name;

/// Beyond this many it is cheaper to list the folder than to look at each path.
pub(super) const MOST_PATHS: usize = 10_000;

/// Changes since the last look. However many there are, this stays small.
#[derive(Debug, Default)]
pub(super) struct Heard {
    /// What changed.
    pub paths: HashSet<PathBuf>,
    /// Those among them that may be folders not listened to yet.
    pub perhaps_folders: HashSet<PathBuf>,
    /// The folder that is watched went away, or another one is in its place.
    pub root_is_lost: bool,
    overflow: bool,
    failed: bool,
}

impl Heard {
    /// Were changes missed? Then whether because there were too many.
    pub fn missed(&self) -> Option<bool> {
        (self.overflow || self.failed).then_some(self.overflow)
    }

    /// Takes in what the system tells of the folder `root`, and says whether it matters.
    pub fn note(&mut self, root: &Path, event: notify::Result<Event>) -> bool {
        let event = match event {
            Ok(event) => event,
            Err(_) => {
                self.failed = true;
                return true;
            }
        };
        if event.need_rescan() {
            self.overflow = true;
        } else if !may_matter(event.kind) {
            return false;
        }
        for path in event.paths {
            self.note_path(root, path, event.kind);
        }
        if self.paths.len() > MOST_PATHS {
            self.overflow = true;
        }
        if self.overflow {
            self.paths = HashSet::new();
            self.perhaps_folders = HashSet::new();
        }
        self.overflow || self.root_is_lost || !self.paths.is_empty()
    }

    fn note_path(&mut self, root: &Path, path: PathBuf, kind: EventKind) {
        if path == root {
            self.root_is_lost |= matches!(
                kind,
                EventKind::Remove(_) | EventKind::Modify(ModifyKind::Name(_))
            );
        } else if !path.file_name().is_some_and(is_finished_name) {
            // Neither a mesh nor a folder that is looked into: a copy that is under way changes often.
            return;
        }
        if may_be_a_new_folder(kind) {
            self.perhaps_folders.insert(path.clone());
        }
        self.paths.insert(path);
    }

    pub fn take(&mut self) -> Self {
        mem::take(self)
    }
}

/// Reading is no change: listing the folder would otherwise be the reason to list it again.
fn may_matter(kind: EventKind) -> bool {
    match kind {
        EventKind::Access(AccessKind::Close(AccessMode::Write)) => true,
        EventKind::Access(_) => false,
        _ => true,
    }
}

/// Made here, moved here, or now readable where it was not. The system does not always say what it is.
fn may_be_a_new_folder(kind: EventKind) -> bool {
    match kind {
        EventKind::Create(kind) => kind != CreateKind::File,
        EventKind::Modify(ModifyKind::Name(mode)) => mode != RenameMode::From,
        EventKind::Modify(ModifyKind::Metadata(_)) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use notify::event::{DataChange, Flag, MetadataKind, RemoveKind};

    use super::*;

    fn event(kind: EventKind, path: &str) -> notify::Result<Event> {
        Ok(Event::new(kind).add_path(path.into()))
    }

    fn heard(kind: EventKind, path: &str) -> Heard {
        let mut heard = Heard::default();
        let matters = heard.note(Path::new("/in"), event(kind, path));
        assert_eq!(matters, !heard.paths.is_empty());
        heard
    }

    const WRITTEN: EventKind = EventKind::Modify(ModifyKind::Data(DataChange::Any));

    #[test]
    fn reading_opening_and_unfinished_names_do_not_matter() {
        use AccessKind::{Close, Open, Read};
        for kind in [Read, Open(AccessMode::Any), Close(AccessMode::Read)] {
            assert!(heard(EventKind::Access(kind), "/in/a.stl").paths.is_empty());
        }
        assert!(heard(WRITTEN, "/in/a.stl.part").paths.is_empty());
        let closed = EventKind::Access(Close(AccessMode::Write));
        for kind in [
            closed,
            WRITTEN,
            EventKind::Any,
            EventKind::Remove(RemoveKind::File),
        ] {
            assert_eq!(heard(kind, "/in/a.stl").paths.len(), 1, "{kind:?}");
        }
    }

    #[test]
    fn both_names_of_a_move_have_changed() {
        let both = EventKind::Modify(ModifyKind::Name(RenameMode::Both));
        let moved = Event::new(both)
            .add_path("/in/a".into())
            .add_path("/in/b".into());
        let mut heard = Heard::default();
        assert!(heard.note(Path::new("/in"), Ok(moved)));
        assert_eq!(heard.paths, ["/in/a", "/in/b"].map(PathBuf::from).into());
    }

    #[test]
    fn what_may_be_a_new_folder_is_kept_apart() {
        let metadata = EventKind::Modify(ModifyKind::Metadata(MetadataKind::Any));
        let arrived = EventKind::Modify(ModifyKind::Name(RenameMode::To));
        for kind in [EventKind::Create(CreateKind::Folder), arrived, metadata] {
            assert_eq!(heard(kind, "/in/a").perhaps_folders.len(), 1, "{kind:?}");
        }
        assert!(heard(WRITTEN, "/in/a").perhaps_folders.is_empty());
    }

    #[test]
    fn an_overflow_without_paths_and_an_error_mean_that_changes_were_missed() {
        let mut heard = Heard::default();
        let overflow = Event::new(EventKind::Other).set_flag(Flag::Rescan);
        assert!(heard.note(Path::new("/in"), Ok(overflow)));
        assert_eq!(heard.take().missed(), Some(true));
        assert!(heard.note(Path::new("/in"), Err(notify::Error::generic("x"))));
        assert_eq!(heard.take().missed(), Some(false));
        assert_eq!(heard.missed(), None);
    }

    #[test]
    fn too_many_paths_are_an_overflow_and_take_no_room() {
        let mut heard = Heard::default();
        for number in 0..3 * MOST_PATHS {
            assert!(heard.note(Path::new("/in"), event(WRITTEN, &format!("/in/{number}"))));
        }
        assert_eq!(heard.missed(), Some(true));
        assert!(heard.paths.is_empty());
    }

    #[test]
    fn only_the_end_of_the_root_itself_is_its_end() {
        let removed = EventKind::Remove(RemoveKind::Folder);
        assert!(heard(removed, "/in").root_is_lost);
        assert!(heard(EventKind::Modify(ModifyKind::Name(RenameMode::From)), "/in").root_is_lost);
        assert!(!heard(removed, "/in/a").root_is_lost);
        let metadata = EventKind::Modify(ModifyKind::Metadata(MetadataKind::Any));
        assert!(!heard(metadata, "/in").root_is_lost);
    }
}
