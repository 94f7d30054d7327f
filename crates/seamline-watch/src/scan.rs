//! What lies in a watched folder right now.
//!
//! Links to files are followed: the file behind the link is what is looked at. Links to folders are not,
//! so that a loop of links ends. Pipes, sockets and devices are passed over, as are hidden folders and
//! names that are not finished ([`crate::include`]). A folder that may not be read is reported and does not
//! keep the others from being read.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::include::{Patterns, is_finished_name};
use crate::outputs::FOLDER_SUFFIX;
use crate::pairs::markings_in;
use crate::tracker::{FileFact, Stamp};

/// What one look found.
#[derive(Debug, Default)]
pub struct Listing {
    /// The files that are taken, by path.
    pub files: Vec<FileFact>,
    /// Where nothing was found; only of a look at one place.
    pub gone: Vec<PathBuf>,
    /// What could not be looked at, and why.
    pub unreadable: Vec<(PathBuf, io::Error)>,
}

/// Which files of a folder are looked for.
#[derive(Clone, Copy, Debug)]
pub struct Search<'a> {
    /// The folder.
    pub root: &'a Path,
    /// Look into folders below it too?
    pub recursive: bool,
    /// Which files are taken.
    pub include: &'a Patterns,
    /// Which are not, all the same.
    pub exclude: &'a Patterns,
    /// Are markings of meshes ([`crate::pairs`]) looked for as well, whatever is included?
    pub markings: bool,
}

impl Search<'_> {
    /// Lists the whole folder.
    ///
    /// # Errors
    ///
    /// The folder itself cannot be read: nothing is known of its files, which is not the same as none there.
    pub fn all(&self) -> io::Result<Listing> {
        let mut listing = Listing::default();
        let mut folders = Vec::new();
        self.list(self.root, &mut folders, &mut listing)?;
        self.descend(folders, &mut listing);
        listing.files.sort_by(|a, b| a.path.cmp(&b.path));
        Ok(listing)
    }

    /// Looks at one place below the root, of which something was heard: a file, a folder with all below
    /// it, or nothing any more. What is added to `listing` is what [`Search::all`] would have found there.
    pub fn at(&self, path: &Path, listing: &mut Listing) {
        let Ok(relative) = path.strip_prefix(self.root) else {
            return;
        };
        let finished = |part| matches!(part, Component::Normal(name) if is_finished_name(name));
        let in_results = relative.ancestors().skip(1).any(is_result);
        if in_results || relative.as_os_str().is_empty() || !relative.components().all(finished) {
            return;
        }
        match fs::symlink_metadata(path) {
            Ok(found) if found.is_dir() => {
                if self.recursive && !is_result(path) {
                    self.descend(vec![path.to_owned()], listing);
                }
            }
            Ok(_) if !self.recursive && relative.components().count() > 1 => {}
            Ok(_) => self.look_at_file(path, listing),
            Err(error) if is_absent(&error) => listing.gone.push(path.to_owned()),
            Err(error) => listing.unreadable.push((path.to_owned(), error)),
        }
    }

    fn descend(&self, mut folders: Vec<PathBuf>, listing: &mut Listing) {
        while let Some(folder) = folders.pop() {
            match self.list(&folder, &mut folders, listing) {
                Err(error) if is_absent(&error) => listing.gone.push(folder),
                Err(error) => listing.unreadable.push((folder, error)),
                Ok(()) => {}
            }
        }
    }

    fn list(
        &self,
        folder: &Path,
        below: &mut Vec<PathBuf>,
        listing: &mut Listing,
    ) -> io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let entry = match entry {
                Ok(entry) => entry,
                Err(error) => {
                    listing.unreadable.push((folder.to_owned(), error));
                    continue;
                }
            };
            if !is_finished_name(&entry.file_name()) {
                continue;
            }
            if !entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                self.look_at_file(&entry.path(), listing);
            } else if self.recursive && !is_result(&entry.path()) {
                below.push(entry.path());
            }
        }
        Ok(())
    }

    fn look_at_file(&self, path: &Path, listing: &mut Listing) {
        let relative = path.strip_prefix(self.root).unwrap_or(path);
        let is_markings = self.markings && markings_in(relative).is_some();
        if !(is_markings || self.include.take(relative)) || self.exclude.take(relative) {
            return;
        }
        match fs::metadata(path) {
            Ok(metadata) => listing.files.extend(fact(path, &metadata)),
            // Gone since the folder was listed, or a link that leads nowhere.
            Err(error) if is_absent(&error) => listing.gone.push(path.to_owned()),
            Err(error) => listing.unreadable.push((path.to_owned(), error)),
        }
    }
}

/// A folder of results, copied into the inbox with the part: what is in it is not input, and its own results would
/// have to lie inside those of the part.
fn is_result(folder: &Path) -> bool {
    let name = folder.file_name().unwrap_or_default();
    name.as_encoded_bytes().ends_with(FOLDER_SUFFIX.as_bytes())
}

fn fact(path: &Path, metadata: &Metadata) -> Option<FileFact> {
    metadata.is_file().then(|| FileFact {
        path: path.to_owned(),
        stamp: Stamp::of(metadata),
    })
}

fn is_absent(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
    )
}

#[cfg(test)]
mod tests;
