//! The tables of the configuration that belong to the watch folder, with their defaults and ranges.

use std::path::PathBuf;

use schemars::JsonSchema;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use serde::{Deserialize, Serialize};

use crate::include;
use crate::outputs::OutputFile;

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

/// One `[[watch]]`: a folder that files are dropped into.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WatchTable {
    /// The folder. It must exist.
    pub root: PathBuf,
    /// Look into folders below it too?
    pub recursive: bool,
    /// Patterns of the files that are taken, in any case of letters. One without `/` is held against the
    /// file's name, one with it against the path below the root.
    pub include: Vec<String>,
    /// A file is taken when its size and time of change have held still for this long.
    pub stable_for_ms: u64,
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
            stable_for_ms: 2000,
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
            (1..=3_600_000).contains(&self.stable_for_ms),
            "stable_for_ms",
            "1 to 3600000 milliseconds",
        )
    }
}

/// `[output]`: where results go, and which.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutputTable {
    /// The folder; `inbox/a/part.stl` gives `out/a/part.stl.seamline/`.
    pub dir: PathBuf,
    /// The files of each result.
    pub write: Vec<OutputFile>,
}

impl StepSettings for OutputTable {
    const TABLE: &'static str = "output";

    fn defaults(_: Profile) -> Self {
        Self {
            dir: "out".into(),
            write: OutputFile::ALL.to_vec(),
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        folder(&self.dir)?;
        OutOfRange::unless(
            !self.write.is_empty(),
            "write",
            "one at least, as in `write = [\"labels\"]`",
        )
    }
}

/// `[state]`: where the daemon keeps what it must remember.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateTable {
    /// The folder.
    pub dir: PathBuf,
}

impl StepSettings for StateTable {
    const TABLE: &'static str = "state";

    fn defaults(_: Profile) -> Self {
        Self {
            dir: "state".into(),
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        folder(&self.dir)
    }
}

/// `[quarantine]`: where files go that could not be cut.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuarantineTable {
    /// The folder; each file has `<name>.error.json` beside it.
    pub dir: PathBuf,
}

impl StepSettings for QuarantineTable {
    const TABLE: &'static str = "quarantine";

    fn defaults(_: Profile) -> Self {
        Self {
            dir: "quarantine".into(),
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        folder(&self.dir)
    }
}

/// `[done]`: where files go after `after = "move"`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DoneTable {
    /// The folder.
    pub dir: PathBuf,
}

impl StepSettings for DoneTable {
    const TABLE: &'static str = "done";

    fn defaults(_: Profile) -> Self {
        Self { dir: "done".into() }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        folder(&self.dir)
    }
}

/// `[daemon]`: how much is done at once.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DaemonTable {
    /// Meshes cut at the same time; 0: one a core, four at most.
    pub workers: usize,
    /// Meshes that may wait between two steps: read and not yet cut, cut and not yet written.
    pub queue: usize,
    /// The folders are listed again after this long even if nothing was heard of them.
    pub rescan_ms: u64,
}

impl StepSettings for DaemonTable {
    const TABLE: &'static str = "daemon";

    fn defaults(_: Profile) -> Self {
        Self {
            workers: 0,
            queue: 2,
            rescan_ms: 10_000,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(self.workers <= 256, "workers", "0 to 256 workers")?;
        OutOfRange::unless(
            (1..=1024).contains(&self.queue),
            "queue",
            "1 to 1024 meshes",
        )?;
        OutOfRange::unless(
            (100..=3_600_000).contains(&self.rescan_ms),
            "rescan_ms",
            "100 to 3600000 milliseconds",
        )
    }
}

fn folder(dir: &std::path::Path) -> Result<(), OutOfRange> {
    OutOfRange::unless(!dir.as_os_str().is_empty(), "dir", "the name of a folder")
}
