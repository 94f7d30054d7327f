//! A folder that appears under its name whole or not at all.

use std::fs::{self, File, Permissions};
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use rustix::fs::{CWD, RenameFlags, renameat_with};
use rustix::io::Errno;
use tempfile::TempDir;

use super::{OutputError, TEMPORARY_END, TEMPORARY_START, hold};
use crate::relocate::{rename_new, sync_folder};

/// A folder in the making, under a hidden name beside its place. Dropped before [`WholeFolder::commit`] it is
/// deleted; left by a crash it is found by [`super::sweep_leftovers`].
pub(super) struct WholeFolder {
    place: PathBuf,
    temporary: TempDir,
    _held: Option<File>,
}

impl WholeFolder {
    /// Makes the hidden folder, and the folders above it.
    pub(super) fn begin(place: &Path) -> Result<Self, OutputError> {
        let parent = place.parent().unwrap_or(Path::new("."));
        let begin = || {
            fs::create_dir_all(parent)?;
            let temporary = tempfile::Builder::new()
                .prefix(TEMPORARY_START)
                .suffix(TEMPORARY_END)
                .permissions(Permissions::from_mode(0o777))
                .tempdir_in(parent)?;
            let _held = hold(temporary.path())?;
            Ok(Self {
                place: place.to_owned(),
                temporary,
                _held,
            })
        };
        begin().map_err(OutputError::io(place))
    }

    /// Where its files are to be written for now.
    pub(super) fn path(&self) -> &Path {
        self.temporary.path()
    }

    /// Gives it its name. What had the name before is deleted.
    pub(super) fn commit(self) -> Result<(), OutputError> {
        let Self {
            place,
            temporary,
            _held,
        } = self;
        let parent = place.parent().unwrap_or(Path::new("."));
        let io = |error| OutputError::Io {
            path: place.clone(),
            error,
        };
        sync_folder(temporary.path()).map_err(io)?;
        match rename_new(temporary.path(), &place) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                if !fs::symlink_metadata(&place).is_ok_and(|found| found.is_dir()) {
                    return Err(OutputError::InTheWay { path: place });
                }
                exchange(temporary.path(), &place).map_err(io)?;
                sync_folder(parent).map_err(io)?;
                // The hidden name now is that of the old results.
                temporary.close().map_err(io)
            }
            Err(error) => Err(io(error)),
            Ok(()) => {
                // Nothing is left under the hidden name to be deleted.
                let _ = temporary.keep();
                sync_folder(parent).map_err(io)
            }
        }
    }
}

/// Gives two folders each other's name.
fn exchange(fresh: &Path, place: &Path) -> io::Result<()> {
    match renameat_with(CWD, fresh, CWD, place, RenameFlags::EXCHANGE) {
        Err(Errno::INVAL | Errno::NOSYS) => exchange_in_steps(fresh, place),
        done => Ok(done?),
    }
}

/// For file systems that cannot exchange: for a moment there is no folder of that name, but never half of
/// one.
fn exchange_in_steps(fresh: &Path, place: &Path) -> io::Result<()> {
    let parent = place.parent().unwrap_or(Path::new("."));
    let aside = tempfile::Builder::new()
        .prefix(TEMPORARY_START)
        .suffix(TEMPORARY_END)
        .tempdir_in(parent)?;
    let old = aside.path().join("old");
    fs::rename(place, &old)?;
    if let Err(error) = fs::rename(fresh, place) {
        fs::rename(&old, place)?;
        return Err(error);
    }
    fs::rename(&old, fresh)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(place: &Path, text: &str) -> Result<(), OutputError> {
        let folder = WholeFolder::begin(place)?;
        fs::write(folder.path().join("file"), text).unwrap();
        folder.commit()
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect()
    }

    #[test]
    fn a_folder_appears_with_its_files_and_nothing_else_stays() {
        let home = tempfile::tempdir().unwrap();
        let place = home.path().join("a/part.seamline");
        write(&place, "one").unwrap();
        assert_eq!(fs::read_to_string(place.join("file")).unwrap(), "one");
        assert_eq!(names(place.parent().unwrap()), ["part.seamline"]);
    }

    #[test]
    fn an_earlier_folder_is_exchanged_with_all_that_is_in_it() {
        let home = tempfile::tempdir().unwrap();
        let place = home.path().join("part.seamline");
        write(&place, "one").unwrap();
        fs::write(place.join("older"), "x").unwrap();
        write(&place, "two").unwrap();
        assert_eq!(names(&place), ["file"]);
        assert_eq!(fs::read_to_string(place.join("file")).unwrap(), "two");
        assert_eq!(names(home.path()), ["part.seamline"]);
    }

    #[test]
    fn exchanging_in_steps_comes_to_the_same() {
        let home = tempfile::tempdir().unwrap();
        let [fresh, place] = ["fresh", "place"].map(|name| home.path().join(name));
        for folder in [&fresh, &place] {
            fs::create_dir(folder).unwrap();
            fs::write(folder.join(folder.file_name().unwrap()), "x").unwrap();
        }
        exchange_in_steps(&fresh, &place).unwrap();
        assert_eq!(names(&place), ["fresh"]);
        assert_eq!(names(&fresh), ["place"]);
        assert_eq!(names(home.path()).len(), 2);
    }

    #[test]
    fn a_folder_that_is_given_up_leaves_no_trace() {
        let home = tempfile::tempdir().unwrap();
        drop(WholeFolder::begin(&home.path().join("part.seamline")).unwrap());
        assert!(names(home.path()).is_empty());
    }

    #[test]
    fn a_file_of_the_same_name_is_not_replaced() {
        let home = tempfile::tempdir().unwrap();
        let place = home.path().join("part.seamline");
        fs::write(&place, "mine").unwrap();
        assert!(matches!(
            write(&place, "two"),
            Err(OutputError::InTheWay { .. })
        ));
        assert_eq!(fs::read_to_string(&place).unwrap(), "mine");
        assert_eq!(names(home.path()), ["part.seamline"]);
    }

    #[test]
    fn others_may_look_into_a_result_as_the_umask_has_it() {
        let home = tempfile::tempdir().unwrap();
        let plain = home.path().join("plain");
        fs::create_dir(&plain).unwrap();
        let place = home.path().join("part.seamline");
        write(&place, "one").unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&place), mode(&plain));
    }
}
