//! A disk that fails, as the program sees it: a library loaded before the C library, which answers the
//! system call `read` for files of a certain name.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use super::Home;

/// Says that a test, or a part of one, cannot run here.
pub fn skipped(why: &str) {
    eprintln!("SKIPPED: {why}");
}

/// Reading files of a certain name fails, or hangs, for as long as it is told to.
pub struct FailingDisk {
    library: PathBuf,
    folder: PathBuf,
}

impl FailingDisk {
    /// Builds the library. `None`, and a word on standard error, where there is no C compiler.
    ///
    /// # Panics
    ///
    /// If there is one and it refuses.
    pub fn new(home: &Home) -> Option<Self> {
        let folder = home.at("failing-disk");
        fs::create_dir(&folder).unwrap();
        let library = folder.join("failing_disk.so");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/daemon/failing_disk.c");
        let built = Command::new("cc")
            .args(["-shared", "-fPIC", "-O1", "-Wall", "-Werror", "-o"])
            .arg(&library)
            .arg(&source)
            .args(["-ldl", "-lpthread"])
            .output();
        match built {
            Ok(output) => {
                let said = String::from_utf8_lossy(&output.stderr);
                assert!(output.status.success(), "{said}");
                Some(Self { library, folder })
            }
            Err(error) => {
                skipped(&format!("no C compiler `cc`: {error}"));
                None
            }
        }
    }

    /// The command sees this disk: reading a file whose path contains `part` fails with `errno`, once for
    /// each call granted by [`FailingDisk::fail`].
    pub fn under<'c>(&self, command: &'c mut Command, part: &str, errno: i32) -> &'c mut Command {
        command
            .env("LD_PRELOAD", &self.library)
            .env("FAILING_DISK", &self.folder)
            .env("FAILING_DISK_PART", part)
            .env("FAILING_DISK_ERRNO", errno.to_string())
    }

    /// The next so many reads fail.
    pub fn fail(&self, times: usize) {
        fs::write(self.folder.join("fail"), vec![b'x'; times]).unwrap();
    }

    /// Reads succeed again.
    pub fn repair(&self) {
        self.fail(0);
    }

    /// When each read failed, by a monotonic clock.
    pub fn failures(&self) -> Vec<Duration> {
        let failed = fs::read_to_string(self.folder.join("failed")).unwrap_or_default();
        let times = failed.lines().map(|line| line.parse().unwrap());
        times.map(Duration::from_millis).collect()
    }

    /// The next read hangs until it is let go.
    pub fn hold(&self) {
        let _ = fs::remove_file(self.folder.join("holding"));
        fs::write(self.folder.join("hold"), "").unwrap();
    }

    /// Does a read hang?
    pub fn is_holding(&self) -> bool {
        self.folder.join("holding").exists()
    }

    /// Lets it go.
    pub fn let_go(&self) {
        fs::remove_file(self.folder.join("hold")).unwrap();
    }
}
