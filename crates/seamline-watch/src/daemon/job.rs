//! What passes from thread to thread: a job on its way from a ready file to its end.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use seamline_ecs::Segmentation;
use tracing::Span;

use crate::config::After;
use crate::ledger::{Fault, JobId};
use crate::load::LoadedMesh;
use crate::memory::Pass;
use crate::pairs::Unpaired;
use crate::setup::Setup;
use crate::tracker::{FileFact, Stamp};

/// A file that is to be cut, as it waits: no more than its name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Waiting {
    /// Its row in the ledger.
    pub id: JobId,
    /// The file.
    pub path: PathBuf,
    /// Its path within the watched folder.
    pub relative: PathBuf,
    /// The state in which it held still.
    pub stamp: Stamp,
    /// What another tool has marked on it, where that is half of the work.
    pub markings: Option<FileFact>,
    /// It is half of a pair that cannot be worked on.
    pub unpaired: Option<Unpaired>,
    /// It has ended early for so long that nothing more is to be expected.
    pub overdue: bool,
    /// When it was found ready.
    pub since: Instant,
    /// It failed, and is not to be tried again before this time.
    pub not_before: Option<Instant>,
    /// Above 0 it may have brought the program down before, the higher the likelier: nothing else is to run
    /// beside it.
    pub suspicion: u32,
    /// How often it has failed since the daemon was started.
    pub failures: u32,
}

/// The state of what is worked on as a word: that of the mesh, and of its markings if it has any.
pub(super) fn stamp_word(mesh: Stamp, markings: Option<Stamp>) -> String {
    match markings {
        None => mesh.word(),
        Some(markings) => format!("{}+{}", mesh.word(), markings.word()),
    }
}

/// A job that is worked on.
#[derive(Clone)]
pub(super) struct Job {
    /// What waited.
    pub file: Waiting,
    /// What it is done with, from beginning to end.
    pub setup: Arc<Setup>,
    /// What becomes of the file.
    pub after: After,
    /// How often it has been begun, this time included.
    pub attempts: u32,
    /// What is said meanwhile is said of this job.
    pub span: Span,
}

/// What a failure means for the job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Remedy {
    /// None: quarantine.
    None,
    /// Try again, so many times.
    Again,
    /// Try again for as long as it takes: the file is not at fault.
    AgainForEver,
}

/// Why a job failed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Failure {
    /// Where, what, and what would be right.
    pub fault: Fault,
    /// BLAKE3 of the file, where it was read.
    pub content: Option<String>,
    /// What it means for the job.
    pub remedy: Remedy,
}

impl Failure {
    /// At `stage`, for good, and no fault of the bytes, of which nothing is known.
    pub(super) fn new(stage: &str, message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self {
            fault: Fault {
                stage: stage.to_owned(),
                message: message.into(),
                hint: hint.into(),
                of_content: false,
            },
            content: None,
            remedy: Remedy::None,
        }
    }

    /// The same, of bytes with this hash.
    pub(super) fn of(self, content: impl Into<Option<String>>) -> Self {
        Self {
            content: content.into(),
            ..self
        }
    }
}

/// A job on its way to the cutters.
pub(super) struct Loaded {
    pub job: Job,
    pub mesh: LoadedMesh,
    pub pass: Pass,
}

/// A job on its way to the writer.
pub(super) struct Cut {
    pub job: Job,
    pub mesh: LoadedMesh,
    pub segmentation: Box<Segmentation>,
    /// The memory it takes, until this is dropped.
    pub pass: Pass,
}

/// A source to be dealt with, now that the ledger says what became of the job.
pub(super) struct Settle {
    pub job: Job,
    /// Why it goes into quarantine; nothing if its results are written.
    pub failure: Option<Failure>,
}

/// What the threads have to say of a job.
pub(super) enum Outcome {
    /// Results are on disk.
    Written {
        job: Job,
        content: String,
        patches: usize,
        result: PathBuf,
    },
    /// The same bytes were cut before.
    Same {
        job: Job,
        content: String,
        holder: JobId,
        path: PathBuf,
    },
    /// The same bytes are being worked on.
    Behind { job: Job, other: JobId },
    /// There are no results.
    Failed { job: Job, failure: Failure },
    /// The file says of itself that there is more to come, or the halves of a pair do not fit (yet).
    EndsEarly { job: Job, failure: Failure },
    /// The file changed before it was read: it was not ready after all.
    Changed { job: Job },
    /// The file went away before it was read.
    Gone { job: Job },
    /// Not begun, because the daemon stops.
    Dropped { job: Job },
    /// Its results have no room where they were to go, and by the configuration of now they go elsewhere.
    Outdated { job: Job },
    /// The source was dealt with; where it was put, an empty path if it was deleted, nothing if it stays.
    Settled {
        job: Job,
        place: io::Result<Option<PathBuf>>,
    },
}

impl Outcome {
    pub(super) fn job(&self) -> &Job {
        match self {
            Self::Written { job, .. }
            | Self::Same { job, .. }
            | Self::Behind { job, .. }
            | Self::Failed { job, .. }
            | Self::EndsEarly { job, .. }
            | Self::Changed { job }
            | Self::Gone { job }
            | Self::Dropped { job }
            | Self::Outdated { job }
            | Self::Settled { job, .. } => job,
        }
    }
}
