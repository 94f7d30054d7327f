//! Where results, state and sources go: `[output]`, `[state]`, `[quarantine]`, `[done]`.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use serde::{Deserialize, Serialize};

use crate::outputs::OutputFile;

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

fn folder(dir: &Path) -> Result<(), OutOfRange> {
    OutOfRange::unless(!dir.as_os_str().is_empty(), "dir", "the name of a folder")
}
