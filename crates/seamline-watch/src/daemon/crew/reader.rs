//! The thread that reads: bytes, their hash, whether they are known, then the mesh.

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use crossbeam_channel::{Receiver, Sender};
use seamline_mesh::Wanted;
use tracing::warn;

use super::Shared;
use super::guard::guarded;
use super::writer::result_of;
use crate::config::After;
use crate::daemon::job::{Failure, Job, Loaded, Outcome, Remedy};
use crate::ledger::{JobId, Known, Reader};
use crate::load::{
    FileBytes, LoadError, LoadedMesh, content_of_pair, markings_of, mesh_of, read_file, read_head,
    weld_share,
};
use crate::memory::{Pass, START_BYTES, TooLarge, bytes_for_mesh, estimate};
use crate::pairs::{Unpaired, markings_in, markings_of as markings_beside, meshes_of};
use crate::retry::may_pass;
use crate::shown;

pub(super) fn read_all(
    shared: &Shared,
    ledger: &Reader,
    jobs: &Receiver<Job>,
    loaded: &Sender<Loaded>,
    outcome: &Sender<Outcome>,
) {
    for job in jobs {
        let said = job.span.clone();
        let _said = said.enter();
        let handed_on = match read(shared, ledger, job) {
            Ok(mesh) => loaded.send(*mesh).is_ok(),
            Err(other) => outcome.send(*other).is_ok(),
        };
        if !handed_on {
            return;
        }
    }
}

/// The mesh of a job, or what became of it instead.
fn read(shared: &Shared, ledger: &Reader, job: Job) -> Result<Box<Loaded>, Box<Outcome>> {
    if shared.is_stopping() {
        return Err(Box::new(Outcome::Dropped { job }));
    }
    let instead = |outcome| Err(Box::new(outcome));
    let refused_unread = taken_by_another_root(ledger, &job)
        .or_else(|| too_long(&job))
        .or_else(|| unpaired(&job));
    if let Some(failure) = refused_unread {
        return instead(Outcome::Failed { job, failure });
    }
    let mut pass = match admit(shared, &job) {
        Ok(pass) => pass,
        Err(outcome) => return instead(outcome(job)),
    };
    let started = Instant::now();
    let bytes = match read_file(&job.file.path) {
        Ok(bytes) if bytes.stamp == job.file.stamp => bytes,
        Ok(_) => return instead(Outcome::Changed { job }),
        Err(error) => return instead(refused(job, error)),
    };
    shared.metrics.read_bytes(bytes.bytes.len() as u64);
    let markings = match read_markings(&job) {
        Ok(markings) => markings,
        Err(outcome) => return instead(outcome(job)),
    };
    let content = match &markings {
        Some(markings) => content_of_pair(&bytes.hash, &markings.hash),
        None => bytes.hash.clone(),
    };
    if let Some(other) = claim(shared, &job, &content) {
        return instead(Outcome::Behind { job, other });
    }
    match ledger.known(&content, &job.setup.settings_hash, &job.file.path) {
        Ok(Some(Known::Done {
            holder,
            path,
            result,
        })) if holder != job.file.id && serves(&job, &path, &result) => {
            return instead(Outcome::Same {
                job,
                content,
                holder,
                path,
            });
        }
        Ok(Some(Known::Bad(fault))) => {
            let content = Some(content);
            let remedy = Remedy::None;
            let failure = Failure {
                fault,
                content,
                remedy,
            };
            return instead(Outcome::Failed { job, failure });
        }
        Ok(_) => {}
        // To cut the same bytes twice costs time and nothing else.
        Err(error) => warn!("{error}; {}", error.hint()),
    }
    let parsed = parse(shared, &job, bytes, markings, content, &mut pass);
    shared.metrics.stage_took("read", started.elapsed());
    match parsed {
        Ok(mesh) => Ok(Box::new(Loaded { job, mesh, pass })),
        Err(failure) if failure.remedy == Remedy::Again => {
            Err(Box::new(Outcome::EndsEarly { job, failure }))
        }
        Err(failure) => Err(Box::new(Outcome::Failed { job, failure })),
    }
}

/// Do the results of the same bytes at another path serve a job? Not if somebody has taken them away: who drops the
/// file again wants them again. Nor if they are under another name and the file is not to stay: of two names
/// one may get other content and with it other results, and of the other nothing would be left.
fn serves(job: &Job, path: &Path, result: &Path) -> bool {
    (path == job.file.path || job.after == After::Keep) && result.is_dir()
}

/// Waits for memory, before anything of the file is in it.
fn admit(shared: &Shared, job: &Job) -> Result<Pass, Box<dyn FnOnce(Job) -> Outcome>> {
    let start = match read_head(&job.file.path, START_BYTES) {
        Ok(start) => start,
        Err(error) => return Err(Box::new(|job| refused(job, error))),
    };
    let needs = estimate(job.file.stamp.size, &start, job.setup.enriched);
    let gate = &shared.gate;
    let refused = |error: TooLarge| -> Box<dyn FnOnce(Job) -> Outcome> {
        let failure = too_large(&error);
        Box::new(|job| Outcome::Failed { job, failure })
    };
    let limit = gate.limit();
    if needs.least_bytes > limit {
        let needs = needs.least_bytes;
        return Err(refused(TooLarge { needs, limit }));
    }
    match gate.enter(needs.bytes.min(limit), &|| shared.is_stopping()) {
        Ok(Some(pass)) => Ok(pass),
        Ok(None) => Err(Box::new(|job| Outcome::Dropped { job })),
        Err(error) => Err(refused(error)),
    }
}

fn parse(
    shared: &Shared,
    job: &Job,
    bytes: FileBytes,
    markings: Option<FileBytes>,
    content: String,
    pass: &mut Pass,
) -> Result<LoadedMesh, Failure> {
    let share = weld_share(job.setup.pipeline.settings_in_force());
    let mesh = guarded("read", || mesh_of(bytes, &job.file.path, share))
        .map_err(|failure| failure.of(content.clone()))?;
    let mut mesh = mesh.map_err(|error| {
        let mut failure = failure_of(&error).of(content.clone());
        if error.is_truncated() && !job.file.overdue {
            failure.remedy = Remedy::Again;
        }
        failure
    })?;
    if let (Some(bytes), Some(file)) = (markings, &job.file.markings) {
        let wanted = markings_in(&file.path).unwrap_or(Wanted::Labels(None));
        let read = guarded("read", || {
            markings_of(bytes, &file.path, wanted, &mesh.mesh)
        })
        .map_err(|failure| failure.of(content.clone()))?;
        mesh.markings = Some(read.map_err(|error| {
            let name = file.path.file_name().unwrap_or_default().display();
            let mut failure = failure_of(&error).of(content.clone());
            failure.fault.message = format!("{name}: {}", failure.fault.message);
            // One half may have been written anew, and the other not yet.
            if !job.file.overdue {
                failure.remedy = Remedy::Again;
            }
            failure
        })?);
        mesh.content.clone_from(&content);
    }
    let triangles = mesh.mesh.triangles.len() as u64;
    let most = job.setup.config.limits.max_triangles;
    if triangles > most {
        let failure = Failure::new(
            "read",
            format!("has {triangles} triangles, more than the {most} that are allowed"),
            "raise `limits.max_triangles`, or export a coarser mesh",
        );
        return Err(failure.of(content));
    }
    let vertices = mesh.mesh.positions().len() as u64;
    let needs = bytes_for_mesh(triangles, vertices, job.setup.enriched);
    match pass.resize(needs, &|| shared.is_stopping()) {
        // Stopping: the mesh is dropped before it is begun.
        Ok(_) => Ok(mesh),
        Err(error) => Err(too_large(&error).of(content)),
    }
}

/// Takes the right to work on these bytes, or tells who has it.
fn claim(shared: &Shared, job: &Job, content: &str) -> Option<JobId> {
    let work = (content.to_owned(), job.setup.settings_hash.clone());
    let holder = *shared.claims().entry(work).or_insert(job.file.id);
    (holder != job.file.id).then_some(holder)
}

fn refused(job: Job, error: LoadError) -> Outcome {
    match &error {
        LoadError::Changed => Outcome::Changed { job },
        LoadError::Io(cause) if cause.kind() == io::ErrorKind::NotFound => Outcome::Gone { job },
        LoadError::Io(_)
        | LoadError::NotAFile
        | LoadError::Mesh { .. }
        | LoadError::Markings { .. } => {
            let failure = failure_of(&error);
            Outcome::Failed { job, failure }
        }
    }
}

fn failure_of(error: &LoadError) -> Failure {
    let mut failure = Failure::new("read", error.to_string(), error.hint());
    failure.fault.of_content = error.is_of_content() && !error.is_truncated();
    if let LoadError::Io(cause) = error
        && may_pass(cause)
    {
        failure.remedy = Remedy::Again;
    }
    failure.of(error.hash().map(str::to_owned))
}

/// The bytes of the markings of a job, if it has any.
fn read_markings(job: &Job) -> Result<Option<FileBytes>, Box<dyn FnOnce(Job) -> Outcome>> {
    let Some(file) = &job.file.markings else {
        return Ok(None);
    };
    match read_file(&file.path) {
        Ok(bytes) if bytes.stamp == file.stamp => Ok(Some(bytes)),
        Ok(_) => Err(Box::new(|job| Outcome::Changed { job })),
        Err(error) => Err(Box::new(|job| refused(job, error))),
    }
}

/// Half of a pair whose other half has not come, or has come twice.
fn unpaired(job: &Job) -> Option<Failure> {
    let path = &job.file.path;
    let why = job.file.unpaired?;
    let name = |path: &Path| path.file_name().unwrap_or_default().display().to_string();
    if why == Unpaired::Crowded {
        let [labels, edges] = markings_beside(path).map(|path| name(&path));
        let message = format!("has labels and edges beside it, {labels} and {edges}");
        let hint = "take away the one that is not meant, then requeue this";
        return Some(Failure::new("read", message, hint));
    }
    let (message, others) = match markings_in(path) {
        None => (
            "has no labels and no edges beside it",
            markings_beside(path).map(|p| name(&p)).join(" or "),
        ),
        Some(_) => (
            "has no mesh beside it",
            meshes_of(path).map(|p| name(&p)).join(" or "),
        ),
    };
    let hint = format!("put {others} into the same folder, then drop this again");
    Some(Failure::new("read", message, hint))
}

fn too_long(job: &Job) -> Option<Failure> {
    let markings = job.file.markings.as_ref();
    let longer = markings.map_or(0, |markings| markings.stamp.size);
    let size = job.file.stamp.size.max(longer);
    let most = job.setup.config.limits.max_file_bytes;
    (size > most).then(|| {
        Failure::new(
            "read",
            format!("has {size} bytes, more than the {most} that are allowed"),
            "raise `limits.max_file_bytes`, or export a coarser mesh",
        )
    })
}

fn too_large(error: &TooLarge) -> Failure {
    Failure::new("read", error.to_string(), error.hint())
}

/// Two watched folders may hold files of the same relative path, whose results would have the same place:
/// the folder named first in the configuration has it, or the one whose results are there already.
fn taken_by_another_root(ledger: &Reader, job: &Job) -> Option<Failure> {
    let other = waiting_in_another_root(job).or_else(|| done_in_another_root(ledger, job))?;
    Some(Failure::new(
        "read",
        format!("its results would replace those of {}", shown(&other)),
        "give one of the two files another name",
    ))
}

fn waiting_in_another_root(job: &Job) -> Option<PathBuf> {
    let relative = &job.file.relative;
    let below = relative.components().count() > 1;
    let config = &job.setup.config;
    let own = config.watched_with(&job.file.path)?;
    let other = config
        .watch
        .iter()
        .take_while(|other| other.root != own.root)
        .find(|other| {
            (other.recursive || !below)
                && other.include.take(relative)
                && !other.exclude.take(relative)
                && other.root.join(relative).is_file()
        })?;
    Some(other.root.join(relative))
}

fn done_in_another_root(ledger: &Reader, job: &Job) -> Option<PathBuf> {
    let config = &job.setup.config;
    if config.watch.len() < 2 {
        return None;
    }
    let owner = ledger.owner_of(&result_of(job)).ok().flatten()?;
    let is_other = owner != job.file.path && config.watched_with(&owner).is_some();
    is_other.then_some(owner)
}
