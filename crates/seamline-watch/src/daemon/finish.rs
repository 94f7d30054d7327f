//! The end of a job: results written and the input dealt with, or the input put into quarantine.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use seamline_ecs::Segmentation;
use tracing::warn;

use super::crew::Shared;
use super::job::{Failure, Finished, Job, Outcome};
use crate::VERSION;
use crate::config::After;
use crate::load::LoadedMesh;
use crate::outputs::{JobFacts, OutputError, write_results};
use crate::quarantine::{Reason, put_aside};
use crate::relocate::move_aside;
use crate::tracker::Stamp;

/// Does what is left to do for a job, and says how it ended.
pub(super) fn finish(shared: &Shared, finished: Finished) -> Outcome {
    match finished {
        Finished::Cut {
            job,
            mesh,
            segmentation,
        } => match write(shared, &job, &mesh, &segmentation) {
            Ok(()) => {
                if let Err(error) = deal_with_input(shared, &job) {
                    warn!(
                        "{} is done but stays where it is: {error}",
                        job.path.display()
                    );
                }
                let took = job.since.elapsed();
                Outcome::Done {
                    job,
                    patches: segmentation.patches.len(),
                    took,
                }
            }
            // The disk is at fault and not the file, which therefore stays.
            Err(error) => {
                let failure = Failure {
                    stage: "write",
                    message: error.to_string(),
                    hint: error.hint().to_owned(),
                    hash: Some(mesh.hash),
                    of_file: false,
                };
                Outcome::Failed {
                    job,
                    failure,
                    quarantined: None,
                }
            }
        },
        Finished::Failed { job, failure } => {
            let quarantined = failure
                .of_file
                .then(|| quarantine(shared, &job, &failure))
                .flatten();
            Outcome::Failed {
                job,
                failure,
                quarantined,
            }
        }
    }
}

fn write(
    shared: &Shared,
    job: &Job,
    loaded: &LoadedMesh,
    segmentation: &Segmentation,
) -> Result<(), OutputError> {
    let about = JobFacts {
        path: &job.path,
        hash: &loaded.hash,
        format: loaded.format,
        bytes_len: loaded.bytes_len,
        settings: shared.pipeline.settings_in_force(),
        program_version: VERSION,
        read_seconds: loaded.took.as_secs_f64(),
    };
    let parent = shared
        .config
        .output
        .join(job.relative.parent().unwrap_or(Path::new("")));
    let name = job.relative.file_name().unwrap_or_default();
    write_results(
        &parent,
        name,
        &loaded.mesh,
        segmentation,
        &about,
        shared.config.write,
    )
    .map(|_| ())
}

/// Does the path still lead to what was read? If not, something new came in its place, which is a job of its
/// own and must not be moved or deleted with the old.
fn is_unchanged(job: &Job) -> bool {
    fs::metadata(&job.path).is_ok_and(|metadata| Stamp::of(&metadata) == job.stamp)
}

fn deal_with_input(shared: &Shared, job: &Job) -> io::Result<()> {
    let after = shared.config.watch[job.root].after;
    if after == After::Keep || !is_unchanged(job) {
        return Ok(());
    }
    match after {
        After::Keep => Ok(()),
        After::Move => move_aside(&job.path, &shared.config.done.join(&job.relative)).map(|_| ()),
        After::Delete => fs::remove_file(&job.path),
    }
}

fn quarantine(shared: &Shared, job: &Job, failure: &Failure) -> Option<PathBuf> {
    if !is_unchanged(job) {
        return None;
    }
    let reason = Reason {
        stage: failure.stage,
        message: &failure.message,
        hint: &failure.hint,
        path: job.path.display().to_string(),
        blake3: failure.hash.as_deref(),
        attempts: 1,
        program_version: VERSION,
        settings: shared.pipeline.settings_in_force(),
    };
    put_aside(&shared.config.quarantine, &job.relative, &job.path, &reason)
        .inspect_err(|error| {
            warn!(
                "{} could not be put into quarantine: {error}",
                job.path.display()
            )
        })
        .ok()
}
