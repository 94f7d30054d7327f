//! What a crash left behind, found and deleted.
//!
//! Everything unfinished has a hidden name of one form and is locked by whoever writes it. The lock goes
//! with the process, however it ends: what has such a name and is not locked is a leftover.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use rustix::fs::{FlockOperation, flock};
use tracing::{info, warn};

use super::FOLDER_SUFFIX;

/// What the names of unfinished files and folders begin with.
pub(crate) const TEMPORARY_START: &str = ".seamline-";
/// What they end in.
pub(crate) const TEMPORARY_END: &str = ".tmp";

/// Locks an unfinished file or folder for as long as what is returned lives. Nothing where the file system has
/// no locks; sweeping then leaves everything be.
pub(crate) fn hold(path: &Path) -> io::Result<Option<File>> {
    let file = File::open(path)?;
    let locked = flock(&file, FlockOperation::NonBlockingLockExclusive).is_ok();
    Ok(locked.then_some(file))
}

/// Deletes what crashed runs left unfinished in a folder and the folders below it. Gives how many were
/// deleted. A folder that is not there has no leftovers; what cannot be deleted is said and left.
pub fn sweep_leftovers(folder: &Path) -> usize {
    let Ok(entries) = fs::read_dir(folder) else {
        return 0;
    };
    let mut swept = 0;
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if name.starts_with(TEMPORARY_START) && name.ends_with(TEMPORARY_END) {
            swept += usize::from(sweep_one(&entry.path(), is_folder));
        } else if is_folder && !name.ends_with(FOLDER_SUFFIX) {
            swept += sweep_leftovers(&entry.path());
        }
    }
    swept
}

fn sweep_one(path: &Path, is_folder: bool) -> bool {
    let Ok(Some(_held)) = hold(path) else {
        return false;
    };
    let deleted = if is_folder {
        fs::remove_dir_all(path)
    } else {
        fs::remove_file(path)
    };
    match &deleted {
        Ok(()) => info!(
            "deleted {}, left by a run that did not end well",
            path.display()
        ),
        Err(error) => warn!(
            "{} was left by a run that did not end well: {error}",
            path.display()
        ),
    }
    deleted.is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leftovers_are_swept_and_everything_else_stays() {
        let home = tempfile::tempdir().unwrap();
        let at = |name: &str| home.path().join(name);
        fs::create_dir_all(at("a/.seamline-x1.tmp/deep")).unwrap();
        fs::write(at(".seamline-x2.tmp"), "x").unwrap();
        fs::create_dir_all(at("a/part.stl.seamline")).unwrap();
        fs::write(at("a/part.stl.seamline/.seamline-x3.tmp"), "x").unwrap();
        fs::write(at(".hidden"), "x").unwrap();

        assert_eq!(sweep_leftovers(home.path()), 2);
        assert!(!at("a/.seamline-x1.tmp").exists() && !at(".seamline-x2.tmp").exists());
        assert!(at("a/part.stl.seamline/.seamline-x3.tmp").exists() && at(".hidden").exists());
    }

    #[test]
    fn what_somebody_is_writing_is_not_a_leftover() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join(".seamline-x.tmp");
        fs::create_dir(&path).unwrap();
        let held = hold(&path).unwrap();
        assert!(held.is_some());
        assert_eq!(sweep_leftovers(home.path()), 0);
        drop(held);
        assert_eq!(sweep_leftovers(home.path()), 1);
    }

    #[test]
    fn a_folder_that_is_not_there_has_no_leftovers() {
        assert_eq!(sweep_leftovers(Path::new("no/such/folder")), 0);
    }
}
