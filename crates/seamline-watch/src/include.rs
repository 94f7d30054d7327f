//! Which names are taken from a watched folder.

use std::ffi::OsStr;
use std::path::Path;

use globset::{GlobBuilder, GlobSet, GlobSetBuilder};

/// Ends of names under which programs write files that are not finished yet.
const UNFINISHED: [&str; 5] = [".part", ".tmp", ".filepart", ".crdownload", "~"];

/// Is this the name of a finished file that a person put there? Hidden files (`.name`, and with them the
/// `._name` of macOS) and the temporary names of copying programs are not.
pub fn is_finished_name(name: &OsStr) -> bool {
    let name = name.to_string_lossy().to_lowercase();
    !name.starts_with('.') && UNFINISHED.iter().all(|end| !name.ends_with(end))
}

/// Patterns of file names, in any case of letters.
///
/// One without `/` is held against the name of the file, one with it against the path below the watched
/// folder; there `*` stays within one folder and `**` does not.
#[derive(Clone, Debug)]
pub struct Patterns {
    names: GlobSet,
    paths: GlobSet,
}

impl Patterns {
    /// Reads the patterns; the error is one line and names the pattern.
    pub fn new<S: AsRef<str>>(patterns: &[S]) -> Result<Self, String> {
        let [mut names, mut paths] = [GlobSetBuilder::new(), GlobSetBuilder::new()];
        for pattern in patterns.iter().map(AsRef::as_ref) {
            let glob = GlobBuilder::new(pattern)
                .case_insensitive(true)
                .literal_separator(true)
                .build()
                .map_err(|error| error.to_string())?;
            if pattern.contains('/') {
                paths.add(glob)
            } else {
                names.add(glob)
            };
        }
        let build = |set: GlobSetBuilder| set.build().map_err(|error| error.to_string());
        Ok(Self {
            names: build(names)?,
            paths: build(paths)?,
        })
    }

    /// Is a file taken, by its path below the watched folder?
    pub fn take(&self, relative: &Path) -> bool {
        let name = relative.file_name().unwrap_or_default();
        self.names.is_match(name) || self.paths.is_match(relative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn takes(pattern: &str, path: &str) -> bool {
        Patterns::new(&[pattern]).unwrap().take(Path::new(path))
    }

    #[test]
    fn the_case_of_letters_does_not_matter() {
        assert!(takes("*.stl", "Part.STL"));
        assert!(takes("*.STL", "a/b/part.stl"));
        assert!(!takes("*.stl", "part.stl.bak"));
    }

    #[test]
    fn a_pattern_with_a_slash_is_held_against_the_path() {
        assert!(takes("gears/*.stl", "gears/a.stl"));
        assert!(!takes("gears/*.stl", "gears/old/a.stl"));
        assert!(takes("**/old/*.stl", "gears/old/a.stl"));
    }

    #[test]
    fn a_pattern_that_cannot_be_read_is_named() {
        assert!(Patterns::new(&["[a"]).unwrap_err().contains("[a"));
    }

    #[test]
    fn temporary_and_hidden_names_are_not_finished() {
        for name in [
            "a.stl.part",
            "a.tmp",
            "a.FilePart",
            "a.stl.crdownload",
            "a.stl~",
            "._a.stl",
            ".a.stl",
        ] {
            assert!(!is_finished_name(OsStr::new(name)), "{name}");
        }
        for name in ["a.stl", "part.obj", "~a.stl", "tmp.ply", "partpart"] {
            assert!(is_finished_name(OsStr::new(name)), "{name}");
        }
    }
}
