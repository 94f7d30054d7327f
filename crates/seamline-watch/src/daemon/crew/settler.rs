//! The thread that deals with sources once the ledger says what became of them: kept, moved, deleted, or put
//! into quarantine.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crossbeam_channel::{Receiver, Sender};

use super::Shared;
use super::writer::is_there;
use crate::VERSION;
use crate::config::After;
use crate::daemon::job::{Failure, Job, Outcome, Settle};
use crate::outputs::{TEMPORARY_END, TEMPORARY_START};
use crate::pairs::{beside, meshes_of};
use crate::quarantine::{Reason, put_aside, reason_beside};
use crate::relocate::move_aside;
use crate::tracker::{FileFact, Stamp};

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
    if !is_ours(job, &job.file.path) {
        return Ok(None);
    }
    let path = &job.file.path;
    let config = &job.setup.config;
    let place = match (failure, job.after) {
        (Some(failure), _) => {
            is_there(&config.quarantine)?;
            quarantine(job, failure)?
        }
        (None, After::Keep) => return Ok(None),
        (None, After::Move) => {
            is_there(&config.done)?;
            move_aside(path, &config.done.join(&job.file.relative))?
        }
        // By way of another name, so that what is deleted is what was looked at.
        (None, After::Delete) => {
            let name = format!("{TEMPORARY_START}{}{TEMPORARY_END}", job.file.id.0);
            move_aside(path, &path.with_file_name(name))?
        }
    };
    settle_markings(job, failure.is_some(), &place)?;
    if !is_ours(job, &place) {
        // Something new came between the look and the move: it goes back, and is a job of its own.
        move_aside(&place, path)?;
        if failure.is_some() {
            fs::remove_file(reason_beside(&place))?;
        }
        return Ok(None);
    }
    if failure.is_none() && job.after == After::Delete {
        return fs::remove_file(&place).map(|()| Some(PathBuf::new()));
    }
    Ok(Some(place))
}

/// Markings go where their mesh has gone, under its name; but they stay while another mesh needs them, and one that
/// failed takes a copy.
fn settle_markings(job: &Job, failed: bool, mesh: &Path) -> io::Result<()> {
    let Some(FileFact { path, stamp }) = &job.file.markings else {
        return Ok(());
    };
    if !fs::metadata(path).is_ok_and(|found| stamp.is_moved(&Stamp::of(&found))) {
        return Ok(());
    }
    if serve_another_mesh(job, path) {
        let copy = beside(mesh, path);
        return match failed && !copy.exists() {
            true => fs::copy(path, copy).map(|_| ()),
            false => Ok(()),
        };
    }
    if !failed && job.after == After::Delete {
        return fs::remove_file(path);
    }
    move_aside(path, &beside(mesh, path)).map(|_| ())
}

/// Does another mesh of the same stem lie beside markings, to be worked on with them?
fn serve_another_mesh(job: &Job, markings: &Path) -> bool {
    let Some(watched) = job.setup.config.watched_with(markings) else {
        return false;
    };
    meshes_of(markings)
        .iter()
        .filter(|mesh| **mesh != job.file.path && mesh.is_file())
        .filter_map(|mesh| mesh.strip_prefix(&watched.root).ok())
        .any(|mesh| watched.include.take(mesh) && !watched.exclude.take(mesh))
}

/// Is this what was read? If not, something new came in its place, which is a job of its own and must not be
/// moved or deleted with the old.
fn is_ours(job: &Job, path: &Path) -> bool {
    // A link is moved as a link, and may lead nowhere from its new place.
    fs::symlink_metadata(path).is_ok_and(|found| found.is_symlink())
        || fs::metadata(path).is_ok_and(|found| job.file.stamp.is_moved(&Stamp::of(&found)))
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
