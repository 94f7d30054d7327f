//! One mesh file into memory: read whole, hashed, parsed, welded.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use seamline_mesh::{
    Format, Markings, MarkingsError, Mesh, ReadError, Wanted, read_bytes, tolerance_from_share,
    weld,
};

use crate::tracker::Stamp;

/// A mesh, and what is told of the file it came from.
#[derive(Clone, Debug)]
pub struct LoadedMesh {
    /// The mesh, welded.
    pub mesh: Arc<Mesh>,
    /// BLAKE3 of the file's bytes, in hexadecimal.
    pub hash: String,
    /// What tells one job's input from another's: the hash, and with markings one of both hashes.
    pub content: String,
    /// The format found.
    pub format: Format,
    /// Length of the file.
    pub bytes_len: u64,
    /// The state of the file that was read.
    pub stamp: Stamp,
    /// How long reading, parsing and welding took, by the clock.
    pub took: Duration,
    /// What another tool has marked on it.
    pub markings: Option<LoadedMarkings>,
}

/// What another tool has marked on a mesh, and the file it came from.
#[derive(Clone, Debug)]
pub struct LoadedMarkings {
    /// Labels or edges.
    pub markings: Arc<Markings>,
    /// The file.
    pub path: PathBuf,
    /// BLAKE3 of its bytes, in hexadecimal.
    pub hash: String,
}

/// Why a file gave no mesh. `Display` is one line without the name of the file.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file system refused.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// A folder, a pipe, a device.
    #[error("is not a regular file")]
    NotAFile,
    /// Somebody wrote to the file while it was read.
    #[error("changed while it was read")]
    Changed,
    /// The bytes are no mesh that can be read.
    #[error("{error}")]
    Mesh {
        /// What is wrong with them.
        error: ReadError,
        /// BLAKE3 of the file's bytes, in hexadecimal.
        hash: String,
    },
    /// The bytes are no markings, or do not fit their mesh.
    #[error("{error}")]
    Markings {
        /// What is wrong with them.
        error: MarkingsError,
        /// BLAKE3 of the file's bytes, in hexadecimal.
        hash: String,
    },
}

impl LoadError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &str {
        match self {
            Self::Io(_) => "check that the file exists and may be read",
            Self::NotAFile => "name a file",
            Self::Changed => "wait until the program that writes it has finished",
            Self::Mesh { error, .. } => error.hint(),
            Self::Markings { error, .. } => error.hint(),
        }
    }

    /// Whether the bytes are at fault, so that trying again cannot help.
    pub fn is_of_content(&self) -> bool {
        matches!(self, Self::Mesh { .. } | Self::Markings { .. })
    }

    /// Whether the bytes say of themselves that more were to come.
    pub fn is_truncated(&self) -> bool {
        match self {
            Self::Mesh { error, .. } => error.is_truncated(),
            Self::Markings { error, .. } => error.is_truncated(),
            _ => false,
        }
    }

    /// The hash of the content, where it was read.
    pub fn hash(&self) -> Option<&str> {
        match self {
            Self::Mesh { hash, .. } | Self::Markings { hash, .. } => Some(hash),
            _ => None,
        }
    }
}

/// Up to which share of the diagonal of the bounding box the settings in force want vertices welded: their
/// `mesh.weld_share`, 0 where there is none.
pub fn weld_share(settings_in_force: &toml::Table) -> f64 {
    let share = settings_in_force
        .get("mesh")
        .and_then(|table| table.get("weld_share"));
    share.and_then(toml::Value::as_float).unwrap_or(0.0)
}

/// The bytes of one file.
#[derive(Clone, Debug)]
pub struct FileBytes {
    /// All of them.
    pub bytes: Vec<u8>,
    /// BLAKE3 of them, in hexadecimal.
    pub hash: String,
    /// The state of the file they were read from.
    pub stamp: Stamp,
    /// How long reading took, by the clock.
    pub took: Duration,
}

/// Reads, hashes, parses and welds one file. Vertices are welded within `weld_share` of the diagonal of the
/// bounding box; at 0 only those at the very same place are.
///
/// # Errors
///
/// [`LoadError`]; [`LoadError::Changed`] if the file is not the same after reading as it was before.
pub fn load(path: &Path, weld_share: f64) -> Result<LoadedMesh, LoadError> {
    mesh_of(read_file(path)?, path, weld_share)
}

/// The first bytes of a file, `most` at most.
///
/// # Errors
///
/// As [`load`] of files that cannot be read.
pub fn read_head(path: &Path, most: usize) -> Result<Vec<u8>, LoadError> {
    let mut head = Vec::new();
    open(path)?.take(most as u64).read_to_end(&mut head)?;
    Ok(head)
}

/// Reads and hashes one file.
///
/// # Errors
///
/// As [`load`], but for what the bytes say.
pub fn read_file(path: &Path) -> Result<FileBytes, LoadError> {
    let started = Instant::now();
    let mut file = open(path)?;
    let before = Stamp::of(&file.metadata()?);
    let mut bytes = Vec::new();
    // No more than there was: a file that grows faster than it is read would have no end.
    let read = file
        .by_ref()
        .take(before.size + 1)
        .read_to_end(&mut bytes)?;
    let stamp = Stamp::of(&file.metadata()?);
    if before != stamp || read as u64 != stamp.size {
        return Err(LoadError::Changed);
    }
    Ok(FileBytes {
        hash: blake3::hash(&bytes).to_hex().to_string(),
        bytes,
        stamp,
        took: started.elapsed(),
    })
}

/// Parses and welds what was read from `path`, as [`load`] does.
///
/// # Errors
///
/// [`LoadError::Mesh`].
pub fn mesh_of(file: FileBytes, path: &Path, weld_share: f64) -> Result<LoadedMesh, LoadError> {
    let started = Instant::now();
    let FileBytes {
        bytes,
        hash,
        stamp,
        took,
    } = file;
    let polygons = match read_bytes(&bytes, path) {
        Ok(polygons) => polygons,
        Err(error) => return Err(LoadError::Mesh { error, hash }),
    };
    drop(bytes);
    let format = polygons.format;
    let tolerance = tolerance_from_share(&polygons, weld_share);
    let mesh = Arc::new(weld(polygons, tolerance));
    Ok(LoadedMesh {
        mesh,
        content: hash.clone(),
        hash,
        format,
        bytes_len: stamp.size,
        stamp,
        took: took + started.elapsed(),
        markings: None,
    })
}

/// One hash of a mesh and its markings, out of those of both.
pub fn content_of_pair(mesh: &str, markings: &str) -> String {
    let both = format!("{mesh}+{markings}");
    blake3::hash(both.as_bytes()).to_hex().to_string()
}

/// Reads what another tool has marked on a mesh.
///
/// # Errors
///
/// As [`load`] of files that cannot be read, and [`LoadError::Markings`].
pub fn load_markings(
    path: &Path,
    wanted: Wanted<'_>,
    mesh: &Mesh,
) -> Result<LoadedMarkings, LoadError> {
    markings_of(read_file(path)?, path, wanted, mesh)
}

/// Reads markings out of what was read from `path`, as [`load_markings`] does.
///
/// # Errors
///
/// [`LoadError::Markings`].
pub fn markings_of(
    file: FileBytes,
    path: &Path,
    wanted: Wanted<'_>,
    mesh: &Mesh,
) -> Result<LoadedMarkings, LoadError> {
    let hash = file.hash;
    match Markings::read(&file.bytes, path, wanted, mesh) {
        Ok(markings) => Ok(LoadedMarkings {
            markings: Arc::new(markings),
            path: path.to_owned(),
            hash,
        }),
        Err(error) => Err(LoadError::Markings { error, hash }),
    }
}

fn open(path: &Path) -> Result<File, LoadError> {
    // Before opening: to open a pipe would wait for somebody to write into it.
    if !fs::metadata(path)?.is_file() {
        return Err(LoadError::NotAFile);
    }
    Ok(File::open(path)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 1e-6\nf 1 2 3\nf 2 1 4\n";

    fn loaded(text: &str, weld_share: f64) -> Result<LoadedMesh, LoadError> {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("part.obj");
        fs::write(&path, text).unwrap();
        load(&path, weld_share)
    }

    #[test]
    fn a_file_is_read_hashed_and_welded() {
        let mesh = loaded(TRIANGLE, 0.0).unwrap();
        assert_eq!(
            mesh.hash,
            blake3::hash(TRIANGLE.as_bytes()).to_hex().as_str()
        );
        assert_eq!(mesh.bytes_len, TRIANGLE.len() as u64);
        assert_eq!(mesh.format, Format::Obj);
        assert_eq!(mesh.mesh.positions().len(), 4);
    }

    #[test]
    fn welding_reaches_as_far_as_its_share_of_the_diagonal() {
        assert_eq!(loaded(TRIANGLE, 1e-5).unwrap().mesh.positions().len(), 3);
    }

    #[test]
    fn the_share_is_that_of_the_settings_in_force() {
        assert_eq!(
            weld_share(&"[mesh]\nweld_share = 1e-6\n".parse().unwrap()),
            1e-6
        );
        assert_eq!(weld_share(&toml::Table::new()), 0.0);
    }

    #[test]
    fn content_that_is_no_mesh_is_told_with_its_hash() {
        let error = loaded("v 0 0 0\nf 1 2 3\n", 0.0).unwrap_err();
        assert!(error.is_of_content() && error.hash().is_some());
        assert!(!error.to_string().contains('\n') && !error.hint().is_empty());
    }

    #[test]
    fn a_folder_is_not_a_file() {
        let home = tempfile::tempdir().unwrap();
        assert!(matches!(load(home.path(), 0.0), Err(LoadError::NotAFile)));
    }

    #[test]
    fn a_file_that_is_not_there_is_no_fault_of_content() {
        let error = load(Path::new("no/such/file.stl"), 0.0).unwrap_err();
        assert!(!error.is_of_content());
    }
}
