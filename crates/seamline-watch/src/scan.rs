//! What lies in a watched folder right now.
//!
//! Links to files are followed: the file behind the link is what is looked at. Links to folders are not,
//! so that a loop of links ends. Pipes, sockets and devices are passed over, as are hidden folders and
//! names that are not finished ([`crate::include`]). A folder that may not be read is reported and does not
//! keep the others from being read.

use std::fs::{self, DirEntry};
use std::io;
use std::path::{Path, PathBuf};

use crate::include::{Patterns, is_finished_name};
use crate::tracker::{FileFact, Stamp};

/// A listing of one watched folder.
#[derive(Debug, Default)]
pub struct Listing {
    /// The files that are taken, by path.
    pub files: Vec<FileFact>,
    /// What could not be looked at, and why.
    pub unreadable: Vec<(PathBuf, io::Error)>,
}

/// Lists a folder.
///
/// # Errors
///
/// The folder itself cannot be read: nothing is known of its files, which is not the same as none there.
pub fn scan(root: &Path, recursive: bool, include: &Patterns) -> io::Result<Listing> {
    let mut listing = Listing::default();
    let mut folders = Vec::new();
    let mut entries = fs::read_dir(root)?;
    loop {
        for entry in entries {
            match entry {
                Ok(entry) => look_at(&entry, root, include, recursive, &mut folders, &mut listing),
                Err(error) => listing.unreadable.push((root.to_owned(), error)),
            }
        }
        entries = loop {
            let Some(folder) = folders.pop() else {
                listing.files.sort_by(|a, b| a.path.cmp(&b.path));
                return Ok(listing);
            };
            match fs::read_dir(&folder) {
                Ok(entries) => break entries,
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => listing.unreadable.push((folder, error)),
            }
        };
    }
}

fn look_at(
    entry: &DirEntry,
    root: &Path,
    include: &Patterns,
    recursive: bool,
    folders: &mut Vec<PathBuf>,
    listing: &mut Listing,
) {
    let path = entry.path();
    if !is_finished_name(&entry.file_name()) {
        return;
    }
    if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
        if recursive {
            folders.push(path);
        }
        return;
    }
    if !include.take(path.strip_prefix(root).unwrap_or(&path)) {
        return;
    }
    match fs::metadata(&path) {
        Ok(metadata) if metadata.is_file() => {
            listing.files.push(FileFact {
                path,
                stamp: Stamp::of(&metadata),
            });
        }
        Ok(_) => {}
        // Gone since the folder was listed, or a link that leads nowhere.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        Err(error) => listing.unreadable.push((path, error)),
    }
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    fn folder() -> tempfile::TempDir {
        let home = tempfile::tempdir().unwrap();
        let root = home.path();
        fs::create_dir_all(root.join("a/b")).unwrap();
        fs::create_dir_all(root.join(".trash")).unwrap();
        for name in [
            "one.stl",
            "TWO.STL",
            "a/b/three.obj",
            "a/notes.txt",
            "a/four.stl.part",
            ".trash/x.stl",
            "._one.stl",
        ] {
            fs::write(root.join(name), "x").unwrap();
        }
        home
    }

    fn names(root: &Path, recursive: bool) -> Vec<String> {
        let include = Patterns::new(&["*.stl", "*.obj", "*.part"]).unwrap();
        let listing = scan(root, recursive, &include).unwrap();
        assert!(listing.unreadable.is_empty());
        let relative = |file: FileFact| file.path.strip_prefix(root).unwrap().display().to_string();
        listing.files.into_iter().map(relative).collect()
    }

    #[test]
    fn finished_files_that_match_are_listed_in_order() {
        assert_eq!(
            names(folder().path(), true),
            ["TWO.STL", "a/b/three.obj", "one.stl"]
        );
    }

    #[test]
    fn without_recursion_only_the_folder_itself_is_listed() {
        assert_eq!(names(folder().path(), false), ["TWO.STL", "one.stl"]);
    }

    #[test]
    fn links_to_files_are_followed_and_links_to_folders_are_not() {
        let home = folder();
        symlink(home.path(), home.path().join("a/loop")).unwrap();
        symlink(home.path().join("one.stl"), home.path().join("a/link.stl")).unwrap();
        symlink(home.path().join("nowhere"), home.path().join("broken.stl")).unwrap();
        assert_eq!(
            names(home.path(), true),
            ["TWO.STL", "a/b/three.obj", "a/link.stl", "one.stl"]
        );
    }

    #[test]
    fn pipes_and_folders_with_the_name_of_a_mesh_are_passed_over() {
        let home = folder();
        fs::create_dir(home.path().join("folder.stl")).unwrap();
        let made = std::process::Command::new("mkfifo")
            .arg(home.path().join("pipe.stl"))
            .status();
        assert!(made.is_ok_and(|status| status.success()));
        assert_eq!(
            names(home.path(), true),
            ["TWO.STL", "a/b/three.obj", "one.stl"]
        );
    }

    #[test]
    fn odd_names_are_names() {
        let home = tempfile::tempdir().unwrap();
        for name in ["zwei Teile.stl", "neue\nZeile.stl", "Größe 1.stl"] {
            fs::write(home.path().join(name), "x").unwrap();
        }
        assert_eq!(names(home.path(), true).len(), 3);
    }

    #[test]
    fn a_root_that_is_gone_is_an_error_and_not_an_empty_folder() {
        let include = Patterns::new(&["*"]).unwrap();
        assert!(scan(Path::new("no/such/folder"), true, &include).is_err());
    }
}
