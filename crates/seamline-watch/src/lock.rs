//! One daemon a state folder.
//!
//! The lock is the kernel's (`flock` on the file `lock`): it goes with the process that holds it, however
//! that ends. The file holds the number of the process and stays when it ends; without the lock it means
//! nothing.

use std::fs::{self, File, Metadata, OpenOptions, TryLockError};
use std::io::{self, Seek, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Somebody who only asks ([`holder`]) has the lock for an instant; one who holds it has it for long.
const TRIES: u32 = 20;
const BETWEEN_TRIES: Duration = Duration::from_millis(10);

/// The right to work with a state folder, until it is dropped or the process ends.
#[derive(Debug)]
pub struct InstanceLock {
    file: File,
    path: PathBuf,
}

/// Why the lock was not given. `Display` is one line.
#[derive(Debug, thiserror::Error)]
pub enum LockError {
    /// Another process has it.
    #[error("another seamline{} works with {}", in_brackets(*.pid), .state.display())]
    Held {
        /// Its number, where it could be read.
        pid: Option<u32>,
        /// The state folder.
        state: PathBuf,
    },
    /// The file system refused.
    #[error("{} cannot be locked: {error}", .path.display())]
    Io {
        /// The file or the folder.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
}

impl LockError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Held { .. } => "stop it, or give this one another `state.dir`",
            Self::Io { .. } => "name a `state.dir` on a local disk that may be written",
        }
    }
}

fn in_brackets(pid: Option<u32>) -> String {
    pid.map_or_else(String::new, |pid| format!(" (process {pid})"))
}

impl InstanceLock {
    /// Takes the lock of a state folder; creates the folder if it is not there.
    ///
    /// # Errors
    ///
    /// Another process has the lock, or the folder cannot be written.
    pub fn take(state_folder: &Path) -> Result<Self, LockError> {
        let path = place(state_folder);
        let refused = |error| LockError::Io {
            path: place(state_folder),
            error,
        };
        fs::create_dir_all(state_folder).map_err(refused)?;
        // Not emptied on opening: it may be another's.
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .map_err(refused)?;
        for _ in 0..TRIES {
            match file.try_lock() {
                Ok(()) => {
                    sign(&mut file).map_err(refused)?;
                    return Ok(Self { file, path });
                }
                Err(TryLockError::WouldBlock) => std::thread::sleep(BETWEEN_TRIES),
                Err(TryLockError::Error(error)) => return Err(refused(error)),
            }
        }
        Err(LockError::Held {
            pid: signed(&path),
            state: state_folder.to_owned(),
        })
    }

    /// Is the lock still the one that others would find? Not if the state folder was deleted or replaced: then
    /// others may work there, and what is written is lost.
    pub fn is_in_place(&self) -> bool {
        let identity = |found: Metadata| (found.dev(), found.ino());
        let held = self.file.metadata().map(identity).ok();
        held.is_some() && held == fs::metadata(&self.path).map(identity).ok()
    }
}

/// The number of the living process that works with a state folder. Nothing if there is none, or if that
/// cannot be told. Does not get into the way of the one that does, nor of one that begins to.
pub fn holder(state_folder: &Path) -> Option<u32> {
    let path = place(state_folder);
    for _ in 0..TRIES {
        let file = File::open(&path).ok()?;
        match file.try_lock_shared() {
            Ok(()) | Err(TryLockError::Error(_)) => return None,
            Err(TryLockError::WouldBlock) => {}
        }
        if let Some(pid) = signed(&path) {
            return Some(pid);
        }
        // It has the lock and is about to sign.
        std::thread::sleep(BETWEEN_TRIES);
    }
    None
}

fn place(state_folder: &Path) -> PathBuf {
    state_folder.join("lock")
}

fn sign(file: &mut File) -> io::Result<()> {
    file.set_len(0)?;
    file.rewind()?;
    writeln!(file, "{}", std::process::id())
}

/// The number in the file; nothing while it is being written, which its line end tells.
fn signed(path: &Path) -> Option<u32> {
    fs::read_to_string(path)
        .ok()?
        .strip_suffix('\n')?
        .parse()
        .ok()
}

#[cfg(test)]
mod tests {
    use std::io::{BufRead, BufReader};
    use std::process::{Child, Command, Stdio};
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;

    const STATE: &str = "SEAMLINE_TEST_STATE";

    /// Not a test by itself: the other process of the tests below, which holds the lock until it is killed.
    #[test]
    fn another_process_holds_the_lock() {
        let Some(state) = std::env::var_os(STATE) else {
            return;
        };
        let _lock = InstanceLock::take(Path::new(&state)).unwrap();
        println!("\nheld");
        std::thread::sleep(Duration::from_secs(60));
    }

    fn other_process(state: &Path) -> Child {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args([
                "--exact",
                "lock::tests::another_process_holds_the_lock",
                "--nocapture",
            ])
            .env(STATE, state)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stdout.as_mut().unwrap()).lines();
        assert!(lines.any(|line| line.unwrap() == "held"));
        child
    }

    #[test]
    fn a_second_process_is_refused_by_the_number_of_the_first() {
        let home = tempfile::tempdir().unwrap();
        let mut other = other_process(home.path());
        let error = InstanceLock::take(home.path()).unwrap_err();
        let expected = format!(
            "another seamline (process {}) works with {}",
            other.id(),
            home.path().display()
        );
        assert_eq!(error.to_string(), expected);
        assert!(error.hint().contains("state.dir"));
        assert_eq!(holder(home.path()), Some(other.id()));
        other.kill().unwrap();
        other.wait().unwrap();
    }

    #[test]
    fn what_a_killed_process_left_is_no_lock() {
        let home = tempfile::tempdir().unwrap();
        let mut other = other_process(home.path());
        other.kill().unwrap();
        other.wait().unwrap();
        assert!(signed(&place(home.path())).is_some());
        assert_eq!(holder(home.path()), None);
        let _lock = InstanceLock::take(home.path()).unwrap();
        assert_eq!(holder(home.path()), Some(std::process::id()));
    }

    #[test]
    fn a_lock_that_was_dropped_can_be_taken_again() {
        let home = tempfile::tempdir().unwrap();
        let state = home.path().join("not/there/yet");
        assert_eq!(holder(&state), None);
        drop(InstanceLock::take(&state).unwrap());
        assert_eq!(holder(&state), None);
        let lock = InstanceLock::take(&state).unwrap();
        assert!(InstanceLock::take(&state).is_err());
        drop(lock);
    }

    #[test]
    fn a_longer_number_from_before_leaves_nothing_behind() {
        let home = tempfile::tempdir().unwrap();
        fs::write(place(home.path()), "99999999999999999999\nand more\n").unwrap();
        let _lock = InstanceLock::take(home.path()).unwrap();
        let text = fs::read_to_string(place(home.path())).unwrap();
        assert_eq!(text, format!("{}\n", std::process::id()));
    }

    #[test]
    fn who_asks_all_the_time_is_not_in_the_way_of_who_begins() {
        let home = tempfile::tempdir().unwrap();
        let ended = AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !ended.load(Ordering::Relaxed) {
                    holder(home.path());
                }
            });
            let taken = (0..200)
                .filter(|_| InstanceLock::take(home.path()).is_ok())
                .count();
            ended.store(true, Ordering::Relaxed);
            assert_eq!(taken, 200);
        });
    }

    #[test]
    fn a_state_folder_that_is_a_file_is_told() {
        let home = tempfile::tempdir().unwrap();
        let file = home.path().join("file");
        fs::write(&file, "").unwrap();
        let error = InstanceLock::take(&file).unwrap_err();
        assert!(matches!(error, LockError::Io { .. }) && !error.to_string().contains('\n'));
    }
}
