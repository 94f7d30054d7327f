//! `[[watch]]`: the folders that files are dropped into.

use std::path::PathBuf;

use schemars::JsonSchema;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use serde::{Deserialize, Serialize};

use crate::include;

/// What becomes of an input file once its results are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum After {
    /// It stays where it is.
    Keep,
    /// It is moved to the folder of `[done]`, under its path within the watched folder.
    Move,
    /// It is deleted.
    Delete,
}

/// How changes in a watched folder are noticed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Watcher {
    /// By events of the system where they can be trusted, by polling on network file systems.
    Auto,
    /// By events of the system.
    Native,
    /// By listing the folder every `poll_ms`.
    Poll,
}

/// One `[[watch]]`: a folder that files are dropped into.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WatchTable {
    /// The folder. While it is not there it is waited for.
    pub root: PathBuf,
    /// Look into folders below it too?
    pub recursive: bool,
    /// Patterns of the files that are taken, in any case of letters. One without `/` is held against the
    /// file's name, one with it against the path below the root.
    pub include: Vec<String>,
    /// Patterns of files that are not taken, whatever `include` says; of the same form.
    pub exclude: Vec<String>,
    /// A file is taken when its size and time of change have held still for this long.
    pub stable_for_ms: u64,
    /// A file that ends early by its own word (a binary STL shorter than its header promises) is taken for
    /// one that is still being written, until it has held still for this long; then for a broken one. With
    /// `--once` a file that changes for this long is left as it is.
    pub max_wait_ms: u64,
    /// How changes are noticed.
    pub watcher: Watcher,
    /// Where folders are polled: how often they are listed.
    pub poll_ms: u64,
    /// What becomes of a file once its results are written.
    pub after: After,
}

impl StepSettings for WatchTable {
    const TABLE: &'static str = "watch";

    fn defaults(_: Profile) -> Self {
        Self {
            root: PathBuf::new(),
            recursive: true,
            include: ["*.stl", "*.obj", "*.ply"].map(str::to_owned).to_vec(),
            exclude: Vec::new(),
            stable_for_ms: 2000,
            max_wait_ms: 600_000,
            watcher: Watcher::Auto,
            poll_ms: 5000,
            after: After::Keep,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            !self.root.as_os_str().is_empty(),
            "root",
            "the folder to watch, as in `root = \"inbox\"`",
        )?;
        let patterns = !self.include.is_empty() && include::Patterns::new(&self.include).is_ok();
        OutOfRange::unless(
            patterns,
            "include",
            "one pattern at least, as in `include = [\"*.stl\"]`",
        )?;
        OutOfRange::unless(
            include::Patterns::new(&self.exclude).is_ok(),
            "exclude",
            "patterns, as in `exclude = [\"*_backup.stl\"]`",
        )?;
        OutOfRange::unless(
            (1..=3_600_000).contains(&self.stable_for_ms),
            "stable_for_ms",
            "1 to 3600000 milliseconds",
        )?;
        OutOfRange::unless(
            (self.stable_for_ms..=604_800_000).contains(&self.max_wait_ms),
            "max_wait_ms",
            "from `stable_for_ms` to 604800000 milliseconds, a week",
        )?;
        OutOfRange::unless(
            (20..=3_600_000).contains(&self.poll_ms),
            "poll_ms",
            "20 to 3600000 milliseconds",
        )
    }
}
