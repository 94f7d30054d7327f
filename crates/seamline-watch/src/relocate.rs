//! Files put in another place without ever taking the place of another file.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use rustix::fs::{CWD, RenameFlags, renameat_with};
use rustix::io::Errno;

use crate::fitted::fitted;
use crate::outputs::{TEMPORARY_END, TEMPORARY_START, hold};
use crate::pairs::stem;
use crate::tracker::Stamp;

/// How many names are tried before it is taken for a mistake.
const MOST_NAMES: u32 = 10_000;

/// Moves a file to `wanted`, or, if something has that name, to the first free one of `part-1.stl`,
/// `part-2.stl`, ... Makes the folders above it. The time of change is kept. Gives the place it is at.
///
/// Across devices the file is copied, the copy brought to disk, and only then the original deleted.
///
/// # Errors
///
/// Whatever the file system refuses; the file is then where it was.
pub fn move_aside(source: &Path, wanted: &Path) -> io::Result<PathBuf> {
    move_aside_with(source, wanted, &|_| Ok(()))
}

/// As [`move_aside`]; `prepare` is called with each free place before the file is moved there.
pub(crate) fn move_aside_with(
    source: &Path,
    wanted: &Path,
    prepare: &dyn Fn(&Path) -> io::Result<()>,
) -> io::Result<PathBuf> {
    if let Some(folder) = wanted.parent() {
        fs::create_dir_all(folder)?;
    }
    for number in 0..MOST_NAMES {
        let place = numbered(wanted, number);
        if fs::symlink_metadata(&place).is_ok() {
            continue;
        }
        prepare(&place)?;
        match rename_new(source, &place) {
            Ok(()) => return Ok(place),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) if error.kind() == io::ErrorKind::CrossesDevices => {
                match copy_then_delete(source, &place) {
                    Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                    done => return done.map(|()| place),
                }
            }
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::new(
        io::ErrorKind::AlreadyExists,
        "too many files of this name",
    ))
}

/// `part.stl`, `part-1.stl`, `part-2.stl`, ... The number is the stem's, which halves of a pair have in common:
/// `part-1.edges.txt`.
fn numbered(path: &Path, number: u32) -> PathBuf {
    if number == 0 {
        return path.to_owned();
    }
    let whole = path.file_name().unwrap_or_default();
    let mut name = OsString::from(stem(path).file_name().unwrap_or_default());
    let end = OsStr::from_bytes(&whole.as_bytes()[name.len()..]);
    name.push(format!("-{number}"));
    name.push(end);
    path.with_file_name(fitted(&name, ""))
}

/// Renames, and fails if something has the new name already.
pub(crate) fn rename_new(from: &Path, to: &Path) -> io::Result<()> {
    match renameat_with(CWD, from, CWD, to, RenameFlags::NOREPLACE) {
        // The file system knows plain renames only.
        Err(Errno::INVAL | Errno::NOSYS) => {
            if fs::symlink_metadata(to).is_ok() {
                return Err(io::ErrorKind::AlreadyExists.into());
            }
            fs::rename(from, to)
        }
        done => Ok(done?),
    }
}

fn copy_then_delete(source: &Path, place: &Path) -> io::Result<()> {
    let folder = place.parent().unwrap_or(Path::new("."));
    let before = fs::metadata(source)?;
    let modified = before.modified()?;
    let mut copy = tempfile::Builder::new()
        .prefix(TEMPORARY_START)
        .suffix(TEMPORARY_END)
        .tempfile_in(folder)?;
    let _held = hold(copy.path())?;
    io::copy(&mut File::open(source)?, copy.as_file_mut())?;
    fs::set_permissions(copy.path(), fs::metadata(source)?.permissions())?;
    copy.as_file().set_modified(modified)?;
    copy.as_file().sync_all()?;
    if Stamp::of(&fs::metadata(source)?) != Stamp::of(&before) {
        return Err(io::Error::other("it changed while it was copied"));
    }
    copy.persist_noclobber(place).map_err(|error| error.error)?;
    sync_folder(folder)?;
    fs::remove_file(source)
}

/// Brings the names in a folder to disk, where the file system can.
pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(()),
        done => done,
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, SystemTime};

    use super::*;

    fn old_file(path: &Path, text: &str) -> SystemTime {
        let long_ago = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000);
        fs::write(path, text).unwrap();
        File::options()
            .write(true)
            .open(path)
            .unwrap()
            .set_modified(long_ago)
            .unwrap();
        long_ago
    }

    #[test]
    fn a_moved_file_keeps_its_time_of_change() {
        let home = tempfile::tempdir().unwrap();
        let source = home.path().join("part.stl");
        let long_ago = old_file(&source, "x");
        let place = move_aside(&source, &home.path().join("done/a/part.stl")).unwrap();
        assert_eq!(place, home.path().join("done/a/part.stl"));
        assert_eq!(fs::metadata(&place).unwrap().modified().unwrap(), long_ago);
        assert!(!source.exists());
    }

    #[test]
    fn a_name_that_is_taken_gets_a_number() {
        let home = tempfile::tempdir().unwrap();
        let wanted = home.path().join("done/part.stl");
        for (text, name) in [("1", "part.stl"), ("2", "part-1.stl"), ("3", "part-2.stl")] {
            let source = home.path().join("part.stl");
            fs::write(&source, text).unwrap();
            let place = move_aside(&source, &wanted).unwrap();
            assert_eq!(place, wanted.with_file_name(name));
            assert_eq!(fs::read_to_string(place).unwrap(), text);
        }
    }

    #[test]
    fn markings_are_numbered_as_the_mesh_they_belong_to() {
        for (name, next) in [
            ("a.edges.txt", "a-1.edges.txt"),
            ("a.seg", "a-1.seg"),
            ("a.b.stl", "a.b-1.stl"),
            ("notes.txt", "notes-1.txt"),
            ("none", "none-1"),
        ] {
            assert_eq!(numbered(Path::new(name), 1), Path::new(next));
        }
    }

    #[test]
    fn a_copy_across_devices_keeps_content_and_time_and_replaces_nothing() {
        let home = tempfile::tempdir().unwrap();
        let (source, place) = (home.path().join("part.stl"), home.path().join("copy.stl"));
        let long_ago = old_file(&source, "x");
        copy_then_delete(&source, &place).unwrap();
        assert_eq!(fs::metadata(&place).unwrap().modified().unwrap(), long_ago);
        assert!(!source.exists());

        fs::write(&source, "y").unwrap();
        let refused = copy_then_delete(&source, &place).unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read_to_string(&place).unwrap(), "x");
        assert!(source.exists());
    }
}
