//! The tables of the configuration that belong to the watch folder, with their defaults and ranges.

use std::net::SocketAddr;
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
    /// The folder. It must exist.
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
    /// one that is still being written, until it has held still for this long; then for a broken one.
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

/// `[daemon]`: how the work is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DaemonTable {
    /// Meshes cut at the same time; 0: one a core, four at most.
    pub workers: usize,
    /// Meshes that may wait between two steps: read and not yet cut, cut and not yet written.
    pub queue: usize,
    /// The folders are listed again after this long even if nothing was heard of them.
    pub rescan_ms: u64,
    /// Told to stop, the daemon gives what runs this long to end.
    pub drain_s: u64,
}

impl StepSettings for DaemonTable {
    const TABLE: &'static str = "daemon";

    fn defaults(_: Profile) -> Self {
        Self {
            workers: 0,
            queue: 2,
            rescan_ms: 60_000,
            drain_s: 60,
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
        )?;
        OutOfRange::unless(self.drain_s <= 86_400, "drain_s", "0 to 86400 seconds")
    }
}

/// `[limits]`: what one file, and all that are worked on together, may take.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsTable {
    /// A longer file is refused.
    pub max_file_bytes: u64,
    /// A mesh of more triangles is refused.
    pub max_triangles: u64,
    /// Memory for the meshes in work, by estimate: who does not fit beside the others waits, who would not
    /// fit alone is refused. 0: three quarters of the memory of the machine, or of its container.
    pub memory_limit_bytes: u64,
    /// A mesh that takes longer to be cut is given up; 0: none is.
    pub job_timeout_s: u64,
}

impl StepSettings for LimitsTable {
    const TABLE: &'static str = "limits";

    fn defaults(_: Profile) -> Self {
        Self {
            max_file_bytes: 4 << 30,
            max_triangles: 50_000_000,
            memory_limit_bytes: 0,
            job_timeout_s: 600,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(self.max_file_bytes > 0, "max_file_bytes", "1 byte or more")?;
        OutOfRange::unless(
            self.max_triangles > 0,
            "max_triangles",
            "1 triangle or more",
        )?;
        OutOfRange::unless(
            self.memory_limit_bytes == 0 || self.memory_limit_bytes >= 64 << 20,
            "memory_limit_bytes",
            "67108864 bytes (64 MiB) or more, or 0",
        )?;
        OutOfRange::unless(
            self.job_timeout_s <= 604_800,
            "job_timeout_s",
            "0 (never) to 604800 seconds, a week",
        )
    }
}

/// `[retry]`: what is done when a disk or a network fails, and not the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RetryTable {
    /// A file that could not be read this often goes into quarantine.
    pub attempts: u32,
    /// Wait before the second attempt. Each further wait is twice as long, give or take a quarter.
    pub first_ms: u64,
    /// The longest wait.
    pub most_ms: u64,
}

impl StepSettings for RetryTable {
    const TABLE: &'static str = "retry";

    fn defaults(_: Profile) -> Self {
        Self {
            attempts: 5,
            first_ms: 1000,
            most_ms: 300_000,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (1..=1000).contains(&self.attempts),
            "attempts",
            "1 to 1000 attempts",
        )?;
        OutOfRange::unless(
            (1..=3_600_000).contains(&self.first_ms),
            "first_ms",
            "1 to 3600000 milliseconds",
        )?;
        OutOfRange::unless(
            (self.first_ms..=86_400_000).contains(&self.most_ms),
            "most_ms",
            "from `first_ms` to 86400000 milliseconds, a day",
        )
    }
}

/// `[http]`: health and metrics.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HttpTable {
    /// Address and port of `/health`, `/ready` and `/metrics`, as in `127.0.0.1:9464`; empty: none. There is
    /// no password: keep it on loopback, or behind a wall.
    pub listen: String,
}

impl StepSettings for HttpTable {
    const TABLE: &'static str = "http";

    fn defaults(_: Profile) -> Self {
        Self {
            listen: String::new(),
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let holds = self.listen.is_empty() || self.listen.parse::<SocketAddr>().is_ok();
        OutOfRange::unless(
            holds,
            "listen",
            "address and port, as in `127.0.0.1:9464`, or \"\"",
        )
    }
}

/// How log lines are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LogFormat {
    /// For people.
    Text,
    /// One JSON object a line.
    Json,
}

/// Which log lines are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LogLevel {
    /// What ends the daemon or loses a result.
    Error,
    /// What somebody should look at, too.
    Warn,
    /// What became of each file, too.
    Info,
    /// What is done for it, too.
    Debug,
}

/// `[log]`: what is said on standard error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogTable {
    /// For people or for programs.
    pub format: LogFormat,
    /// How much; `-q` and `-v` on the command line beat it.
    pub level: LogLevel,
}

impl StepSettings for LogTable {
    const TABLE: &'static str = "log";

    fn defaults(_: Profile) -> Self {
        Self {
            format: LogFormat::Text,
            level: LogLevel::Info,
        }
    }
}

fn folder(dir: &std::path::Path) -> Result<(), OutOfRange> {
    OutOfRange::unless(!dir.as_os_str().is_empty(), "dir", "the name of a folder")
}
