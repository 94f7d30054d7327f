//! What passes from thread to thread: a job on its way from a ready file to its outcome.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use seamline_ecs::Segmentation;

use crate::load::LoadedMesh;
use crate::tracker::Stamp;

/// A file that is to be cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Job {
    /// The file.
    pub path: PathBuf,
    /// Its path within the watched folder.
    pub relative: PathBuf,
    /// The state in which it held still.
    pub stamp: Stamp,
    /// The number of its `[[watch]]`.
    pub root: usize,
    /// When it was found ready.
    pub since: Instant,
}

/// Why a job failed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Failure {
    /// Where: `read`, a stage of the pipeline, `write`.
    pub stage: &'static str,
    /// What went wrong, in one line.
    pub message: String,
    /// What would be right.
    pub hint: String,
    /// BLAKE3 of the file, where it was read.
    pub hash: Option<String>,
    /// Is the file at fault, so that it goes into quarantine?
    pub of_file: bool,
}

/// A job on its way to the workers.
pub(super) struct Loaded {
    pub job: Job,
    pub mesh: LoadedMesh,
}

/// A job on its way to the writer.
pub(super) enum Finished {
    /// Patches to be written.
    Cut {
        job: Job,
        mesh: LoadedMesh,
        segmentation: Box<Segmentation>,
    },
    /// A failure to be dealt with.
    Failed { job: Job, failure: Failure },
}

/// How a job ended.
pub(super) enum Outcome {
    /// Results are written.
    Done {
        job: Job,
        patches: usize,
        took: Duration,
    },
    /// There are none.
    Failed {
        job: Job,
        failure: Failure,
        quarantined: Option<PathBuf>,
    },
    /// The file changed before it was read: it was not ready after all.
    Changed { job: Job },
    /// The file went away before it was read.
    Gone { job: Job },
    /// Not begun, because the daemon stops.
    Dropped { job: Job },
}

impl Outcome {
    pub(super) fn job(&self) -> &Job {
        match self {
            Self::Done { job, .. }
            | Self::Failed { job, .. }
            | Self::Changed { job }
            | Self::Gone { job }
            | Self::Dropped { job } => job,
        }
    }
}
