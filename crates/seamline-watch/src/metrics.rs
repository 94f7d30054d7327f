//! What the daemon counts and times, for Prometheus and its like.
//!
//! Every series is there from the start, at nought, so that the first event is seen as a rise; and no label
//! takes a value from outside, so that the number of series never grows.

use std::time::Duration;

use prometheus_client::encoding::text;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};
use seamline_ecs::Stage;

use crate::ledger::JobState;

/// The content type of [`Metrics::encode`].
pub const CONTENT_TYPE: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// The stages before and after those of the pipeline.
const AROUND: [&str; 3] = ["read", "write", "settle"];
/// The stage of what has another name than those known.
const OTHER: &str = "other";

/// Bounds of the times, in seconds, from 1 ms (the stages of a part of some thousand triangles) to 10 min
/// (when a job is given up by default). Times spread evenly over the powers of ten, so the bounds do too: three
/// a power, so that a quantile read off them is wrong by 2.5 at most, and 21 series a stage are not many.
const BOUNDS: [f64; 19] = [
    0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0,
    200.0, 300.0, 600.0,
];

type Label = [(&'static str, &'static str); 1];

/// What came of a job, or of one try at it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutcomeKind {
    /// Its results are written.
    Done,
    /// Its content was cut under these settings before; nothing was computed.
    SameContent,
    /// It failed for good, otherwise than by taking too long.
    Quarantined,
    /// It failed for now and will be tried again.
    Retried,
    /// Its file vanished before it was read.
    Gone,
    /// Its file changed while it was read.
    Changed,
    /// It took longer than allowed, and is in quarantine for that.
    TimedOut,
}

impl OutcomeKind {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Done,
        Self::SameContent,
        Self::Quarantined,
        Self::Retried,
        Self::Gone,
        Self::Changed,
        Self::TimedOut,
    ];

    /// The name used as a label.
    pub fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::SameContent => "same_content",
            Self::Quarantined => "quarantined",
            Self::Retried => "retried",
            Self::Gone => "gone",
            Self::Changed => "changed",
            Self::TimedOut => "timed_out",
        }
    }
}

/// Counts, times and levels of one daemon. Any thread may enter something at any time.
#[derive(Debug)]
pub struct Metrics {
    registry: Registry,
    outcomes: Family<Label, Counter>,
    jobs: Family<Label, Gauge>,
    stages: Family<Label, Histogram>,
    job: Histogram,
    queue: Gauge,
    oldest_pending: Gauge<f64, std::sync::atomic::AtomicU64>,
    overflows: Counter,
    scans: Counter,
    read: Counter,
    reserved: Gauge,
    limit: Gauge,
    reloads: Family<Label, Counter>,
    folders: Family<Label, Gauge>,
    paused: Gauge,
    abandoned: Gauge,
}

impl Metrics {
    /// All metrics, at nought; `version` is that of the program.
    pub fn new(version: &str) -> Self {
        let mut metrics = Self {
            registry: Registry::with_prefix("seamline"),
            outcomes: Family::default(),
            jobs: Family::default(),
            stages: Family::new_with_constructor(times),
            job: times(),
            queue: Gauge::default(),
            oldest_pending: Gauge::default(),
            overflows: Counter::default(),
            scans: Counter::default(),
            read: Counter::default(),
            reserved: Gauge::default(),
            limit: Gauge::default(),
            reloads: Family::default(),
            folders: Family::default(),
            paused: Gauge::default(),
            abandoned: Gauge::default(),
        };
        metrics.begin_at_nought();
        metrics.register(version);
        metrics
    }

    fn begin_at_nought(&self) {
        for kind in OutcomeKind::ALL {
            drop(self.outcomes.get_or_create(&[("outcome", kind.name())]));
        }
        for state in JobState::ALL {
            drop(self.jobs.get_or_create(&[("state", state.word())]));
        }
        for stage in stage_names() {
            drop(self.stages.get_or_create(&[("stage", stage)]));
        }
        for result in ["ok", "refused"] {
            drop(self.reloads.get_or_create(&[("result", result)]));
        }
        for state in ["present", "away"] {
            drop(self.folders.get_or_create(&[("state", state)]));
        }
    }

    /// The registry adds the prefix, the unit, `_total` to counters, and a full stop to the help.
    fn register(&mut self, version: &str) {
        let registry = &mut self.registry;
        registry.register(
            "jobs",
            "What came of jobs and of tries at them, by outcome",
            self.outcomes.clone(),
        );
        // Not `jobs`: a counter `jobs_total` and a gauge `jobs` are one name in OpenMetrics.
        registry.register(
            "ledger_jobs",
            "Jobs in the ledger, by state",
            self.jobs.clone(),
        );
        registry.register_with_unit(
            "stage",
            "Time a job spent in one stage",
            Unit::Seconds,
            self.stages.clone(),
        );
        registry.register_with_unit(
            "job",
            "Time from a file being ready to its job being done",
            Unit::Seconds,
            self.job.clone(),
        );
        registry.register(
            "queue_jobs",
            "Jobs that are waiting to be read",
            self.queue.clone(),
        );
        registry.register_with_unit(
            "oldest_pending",
            "How long the oldest of the waiting jobs has been waiting, 0 if none is",
            Unit::Seconds,
            self.oldest_pending.clone(),
        );
        registry.register(
            "overflows",
            "How often the system lost changes in watched folders",
            self.overflows.clone(),
        );
        registry.register(
            "scans",
            "How often the watched folders were listed",
            self.scans.clone(),
        );
        registry.register_with_unit(
            "read",
            "Bytes of meshes that were read",
            Unit::Bytes,
            self.read.clone(),
        );
        registry.register_with_unit(
            "memory_reserved",
            "Memory reserved for the meshes in work, by estimate",
            Unit::Bytes,
            self.reserved.clone(),
        );
        registry.register_with_unit(
            "memory_limit",
            "Memory that may be reserved",
            Unit::Bytes,
            self.limit.clone(),
        );
        registry.register(
            "reloads",
            "How often the configuration was read again, by result",
            self.reloads.clone(),
        );
        registry.register(
            "watch_folders",
            "Watched folders, by whether they are there",
            self.folders.clone(),
        );
        registry.register(
            "paused",
            "1 while no job is begun because a disk is full, else 0",
            self.paused.clone(),
        );
        registry.register(
            "abandoned_workers",
            "Threads that were given up with a job that took too long and have not ended yet",
            self.abandoned.clone(),
        );
        // Not of the type for this, which only OpenMetrics has: other readers would refuse the whole text.
        let build: Family<[(&str, String); 1], Gauge> = Family::default();
        build
            .get_or_create(&[("version", version.to_owned())])
            .set(1);
        registry.register("build_info", "The version of the program, always 1", build);
    }

    /// A job has ended, or one try at it. One call an event: a job that timed out is not `Quarantined` too.
    pub fn job_ended(&self, kind: OutcomeKind) {
        self.outcomes
            .get_or_create(&[("outcome", kind.name())])
            .inc();
    }

    /// A job has spent this long in `stage`: `read`, one of [`Stage::ALL`] by its name, `write` or `settle`. Any
    /// other name is entered as `other`.
    pub fn stage_took(&self, stage: &str, took: Duration) {
        let stage = stage_names().find(|&known| known == stage).unwrap_or(OTHER);
        self.stages
            .get_or_create(&[("stage", stage)])
            .observe(took.as_secs_f64());
    }

    /// A job took this long from its file being ready to being done.
    pub fn job_took(&self, took: Duration) {
        self.job.observe(took.as_secs_f64());
    }

    /// So many more bytes of meshes have been read.
    pub fn read_bytes(&self, bytes: u64) {
        self.read.inc_by(bytes);
    }

    /// The system has lost changes in a watched folder.
    pub fn overflowed(&self) {
        self.overflows.inc();
    }

    /// The watched folders have been listed.
    pub fn scanned(&self) {
        self.scans.inc();
    }

    /// The configuration has been read again and put to use, or refused.
    pub fn reloaded(&self, ok: bool) {
        let result = if ok { "ok" } else { "refused" };
        self.reloads.get_or_create(&[("result", result)]).inc();
    }

    /// How many jobs of the ledger are in each state. A state that is not named keeps its number.
    pub fn set_jobs(&self, counts: &[(JobState, u64)]) {
        for (state, count) in counts {
            self.jobs
                .get_or_create(&[("state", state.word())])
                .set(level(*count));
        }
    }

    /// How many jobs wait to be read.
    pub fn set_queue(&self, jobs: usize) {
        self.queue.set(level(jobs as u64));
    }

    /// How long the oldest of the waiting jobs has been waiting; `None`: no job waits.
    pub fn set_oldest_pending(&self, waiting: Option<Duration>) {
        self.oldest_pending
            .set(waiting.unwrap_or_default().as_secs_f64());
    }

    /// How much memory is reserved for the meshes in work.
    pub fn set_reserved_bytes(&self, bytes: u64) {
        self.reserved.set(level(bytes));
    }

    /// How much memory may be reserved.
    pub fn set_limit_bytes(&self, bytes: u64) {
        self.limit.set(level(bytes));
    }

    /// How many of the watched folders are there, and how many are not.
    pub fn set_folders(&self, present: usize, away: usize) {
        for (state, count) in [("present", present), ("away", away)] {
            self.folders
                .get_or_create(&[("state", state)])
                .set(level(count as u64));
        }
    }

    /// Whether no job is begun because a disk is full.
    pub fn set_paused(&self, paused: bool) {
        self.paused.set(paused.into());
    }

    /// How many threads were given up with their job and have not ended.
    pub fn set_abandoned(&self, workers: usize) {
        self.abandoned.set(level(workers as u64));
    }

    /// All of it as OpenMetrics text, of the type [`CONTENT_TYPE`].
    pub fn encode(&self) -> String {
        let mut text = String::new();
        text::encode(&mut text, &self.registry).expect("a string has room for every number");
        text
    }
}

fn times() -> Histogram {
    Histogram::new(BOUNDS)
}

fn stage_names() -> impl Iterator<Item = &'static str> {
    AROUND.into_iter().chain(Stage::ALL.map(Stage::name))
}

/// "No limit" may be told as the largest number there is.
fn level(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests;
