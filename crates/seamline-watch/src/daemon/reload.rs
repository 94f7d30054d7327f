//! The configuration file, read anew when it changes or when that is asked for.

use std::fs;
use std::path::PathBuf;

use crate::setup::Setup;
use crate::tracker::Stamp;

/// Where the configuration comes from, so that it can be read anew.
pub struct Reload {
    file: PathBuf,
    read: Box<dyn FnMut() -> Result<Setup, String>>,
    known: Option<Stamp>,
    settling: Option<Stamp>,
}

impl Reload {
    /// The configuration in `file`, which `read` reads; its error is one line.
    pub fn new(
        file: impl Into<PathBuf>,
        read: impl FnMut() -> Result<Setup, String> + 'static,
    ) -> Self {
        let file = file.into();
        Self {
            known: stamp(&file),
            file,
            read: Box::new(read),
            settling: None,
        }
    }

    /// Has the file changed since it was read, and held still from the last time this was asked to now?
    pub(super) fn is_due(&mut self) -> bool {
        let now = stamp(&self.file);
        if now == self.known || now.is_none() {
            self.settling = None;
            return false;
        }
        let held_still = now == self.settling;
        self.settling = now;
        held_still
    }

    /// Reads the file. What is wrong with it is said once, until it changes again.
    pub(super) fn read(&mut self) -> Result<Setup, String> {
        self.known = stamp(&self.file);
        self.settling = None;
        (self.read)()
    }
}

fn stamp(file: &PathBuf) -> Option<Stamp> {
    fs::metadata(file).ok().map(|found| Stamp::of(&found))
}
