//! How the work is done, what it may take, and what is done when it fails: `[daemon]`, `[limits]`, `[retry]`.

use schemars::JsonSchema;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use serde::{Deserialize, Serialize};

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
    /// Memory of the whole program. Three quarters of it are for the meshes in work, by estimate: who does not
    /// fit beside the others waits, who would not fit alone is refused. 0: three quarters of the memory of the
    /// machine, or of its container.
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
