//! The thread that writes results. While the disk is full it waits, and with it all who come before, until there is
//! room or the configuration names another folder.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};
use tracing::{info, warn};

use super::Shared;
use super::guard::guarded;
use crate::VERSION;
use crate::daemon::job::{Cut, Failure, Job, Outcome, Remedy};
use crate::health::Trouble;
use crate::outputs::{JobFacts, OutputError, result_folder, write_results};

/// How often a full disk is tried again.
const FULL_DISK_EVERY: Duration = Duration::from_secs(1);

pub(super) fn write_all(shared: &Shared, to_write: &Receiver<Cut>, outcome: &Sender<Outcome>) {
    for cut in to_write {
        let said = cut.job.span.clone();
        let _said = said.enter();
        if outcome.send(write(shared, cut)).is_err() {
            return;
        }
    }
}

fn write(shared: &Shared, cut: Cut) -> Outcome {
    let written = guarded("write", || {
        shared.timed("write", || write_when_there_is_room(shared, &cut))
    });
    let Cut {
        job,
        mesh,
        segmentation,
        pass: _pass,
    } = cut;
    let failure = match written {
        Ok(Ok(())) => {
            return Outcome::Written {
                result: result_of(&job),
                patches: segmentation.patches.len(),
                content: mesh.content,
                job,
            };
        }
        Ok(Err(error)) if error.is_full_disk() => return Outcome::Outdated { job },
        Ok(Err(error)) => Failure {
            remedy: Remedy::AgainForEver,
            ..Failure::new("write", error.to_string(), error.hint())
        },
        Err(panicked) => panicked,
    };
    let failure = failure.of(mesh.content);
    Outcome::Failed { job, failure }
}

/// A folder that was there at the start and is not any more may be a share that was unmounted: made anew, it would
/// swallow what is put there.
pub(super) fn is_there(folder: &Path) -> io::Result<()> {
    if folder.is_dir() {
        return Ok(());
    }
    Err(io::Error::new(
        io::ErrorKind::NotFound,
        "the folder is not there any more",
    ))
}

/// The folder of a job's results.
pub(super) fn result_of(job: &Job) -> PathBuf {
    let (parent, name) = place(job);
    result_folder(&parent, &name)
}

fn place(job: &Job) -> (PathBuf, OsString) {
    let relative = &job.file.relative;
    let output = &job.setup.config.output;
    let parent = output.join(relative.parent().unwrap_or(Path::new("")));
    (parent, relative.file_name().unwrap_or_default().to_owned())
}

/// The disk is full for as long as it takes, and an error only once results go elsewhere by the configuration.
fn write_when_there_is_room(shared: &Shared, cut: &Cut) -> Result<(), OutputError> {
    let output = &cut.job.setup.config.output;
    let trouble = || Trouble::DiskFull(output.clone());
    let mut paused = false;
    loop {
        match write_once(cut) {
            Err(error) if error.is_full_disk() && shared.writes_to(output) => {
                if !paused {
                    paused = true;
                    warn!("{error}; paused until there is room");
                    shared.health.raise(trouble(), &error.to_string());
                    shared.metrics.set_paused(true);
                }
                sleep(FULL_DISK_EVERY);
            }
            other => {
                if paused {
                    match &other {
                        Err(error) if error.is_full_disk() => info!("results go elsewhere now"),
                        _ => info!("there is room again"),
                    }
                    shared.health.clear(&trouble());
                    shared.metrics.set_paused(false);
                }
                return other;
            }
        }
    }
}

fn write_once(cut: &Cut) -> Result<(), OutputError> {
    is_there(&cut.job.setup.config.output)
        .map_err(OutputError::io(&cut.job.setup.config.output))?;
    let Cut {
        job,
        mesh,
        segmentation,
        ..
    } = cut;
    let about = JobFacts {
        path: &job.file.path,
        hash: &mesh.hash,
        format: mesh.format,
        bytes_len: mesh.bytes_len,
        markings: mesh.markings.as_ref(),
        settings: job.setup.pipeline.settings_in_force(),
        program_version: VERSION,
        read_seconds: mesh.took.as_secs_f64(),
    };
    let (parent, name) = place(job);
    let what = job.setup.config.write;
    write_results(&parent, &name, &mesh.mesh, segmentation, &about, what).map(|_| ())
}
