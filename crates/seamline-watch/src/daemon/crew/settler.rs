//! The thread that deals with sources once the ledger says what became of them: kept, moved, deleted, or put
//! into quarantine.

use std::fs;
use std::io;
use std::path::PathBuf;

use crossbeam_channel::{Receiver, Sender};

use super::Shared;
use crate::VERSION;
use crate::config::After;
use crate::daemon::job::{Failure, Job, Outcome, Settle};
use crate::quarantine::{Reason, put_aside};
use crate::relocate::move_aside;
use crate::tracker::Stamp;

pub(super) fn settle_all(shared: &Shared, to_settle: &Receiver<Settle>, outcome: &Sender<Outcome>) {
    for Settle { job, failure } in to_settle {
        let said = job.span.clone();
        let _said = said.enter();
        let place = shared.timed("settle", || settle(&job, failure.as_ref()));
        if outcome.send(Outcome::Settled { job, place }).is_err() {
            return;
        }
    }
}

fn settle(job: &Job, failure: Option<&Failure>) -> io::Result<Option<PathBuf>> {
    if !is_unchanged(job) {
        return Ok(None);
    }
    let path = &job.file.path;
    match failure {
        Some(failure) => quarantine(job, failure).map(Some),
        None => match job.after {
            After::Keep => Ok(None),
            After::Move => {
                move_aside(path, &job.setup.config.done.join(&job.file.relative)).map(Some)
            }
            After::Delete => fs::remove_file(path).map(|()| Some(PathBuf::new())),
        },
    }
}

/// Does the path still lead to what was read? If not, something new came in its place, which is a job of its
/// own and must not be moved or deleted with the old.
fn is_unchanged(job: &Job) -> bool {
    fs::metadata(&job.file.path).is_ok_and(|found| Stamp::of(&found) == job.file.stamp)
}

fn quarantine(job: &Job, failure: &Failure) -> io::Result<PathBuf> {
    let reason = Reason {
        stage: &failure.fault.stage,
        message: &failure.fault.message,
        hint: &failure.fault.hint,
        path: job.file.path.display().to_string(),
        blake3: failure.content.as_deref(),
        attempts: job.attempts,
        program_version: VERSION,
        settings: job.setup.pipeline.settings_in_force(),
    };
    put_aside(
        &job.setup.config.quarantine,
        &job.file.relative,
        &job.file.path,
        &reason,
    )
}
