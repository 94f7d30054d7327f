//! The threads: one reads, some cut, one writes, with bounded channels between them.
//!
//! A slow disk or a slow mesh fills the channel behind it, and whoever comes before waits: no more meshes
//! are in memory than the channels and the threads hold.

use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{Builder, JoinHandle};

use crossbeam_channel::{Receiver, Sender, bounded};
use seamline_ecs::{Pipeline, Worker};

use super::finish::finish;
use super::job::{Failure, Finished, Job, Loaded, Outcome};
use crate::config::Config;
use crate::load::{LoadError, load, weld_share};

/// What all threads know.
pub(super) struct Shared {
    pub config: Config,
    pub pipeline: Arc<Pipeline>,
    stopping: AtomicBool,
}

impl Shared {
    fn is_stopping(&self) -> bool {
        self.stopping.load(Ordering::Relaxed)
    }
}

/// The threads, the way in and the way out.
pub(super) struct Crew {
    jobs: Sender<Job>,
    outcomes: Receiver<Outcome>,
    threads: Vec<JoinHandle<()>>,
    shared: Arc<Shared>,
}

impl Crew {
    /// Starts the threads.
    pub(super) fn start(config: Config, pipeline: Arc<Pipeline>) -> io::Result<Self> {
        let shared = Arc::new(Shared {
            config,
            pipeline,
            stopping: AtomicBool::new(false),
        });
        let queue = shared.config.queue;
        let (jobs, to_read) = bounded(queue);
        let (loaded, to_cut) = bounded(queue);
        let (finished, to_write) = bounded(queue);
        // Room for some, so that nobody waits while the folders are being listed.
        let (outcome, outcomes) = bounded(256);

        let mut threads = Vec::new();
        let mut spawn = |name: String, work: Box<dyn FnOnce() + Send>| {
            threads.push(Builder::new().name(name).spawn(work)?);
            io::Result::Ok(())
        };
        for number in 0..shared.config.workers {
            let (shared, to_cut) = (shared.clone(), to_cut.clone());
            let (finished, outcome) = (finished.clone(), outcome.clone());
            spawn(
                format!("cut-{number}"),
                Box::new(move || cut_all(&shared, &to_cut, &finished, &outcome)),
            )?;
        }
        {
            let (shared, outcome) = (shared.clone(), outcome.clone());
            spawn(
                "read".to_owned(),
                Box::new(move || read_all(&shared, &to_read, &loaded, &finished, &outcome)),
            )?;
        }
        {
            let shared = shared.clone();
            spawn(
                "write".to_owned(),
                Box::new(move || write_all(&shared, &to_write, &outcome)),
            )?;
        }
        Ok(Self {
            jobs,
            outcomes,
            threads,
            shared,
        })
    }

    /// Is there room for another job? Only the caller puts jobs in, so that the room stays.
    pub(super) fn has_room(&self) -> bool {
        !self.jobs.is_full()
    }

    /// Hands a job over. False if the threads are gone.
    pub(super) fn hand_over(&self, job: Job) -> bool {
        self.jobs.send(job).is_ok()
    }

    /// Where outcomes come out: one for every job handed over.
    pub(super) fn outcomes(&self) -> &Receiver<Outcome> {
        &self.outcomes
    }

    /// From now on, what is not begun is not begun any more.
    pub(super) fn begin_nothing_new(&self) {
        self.shared.stopping.store(true, Ordering::Relaxed);
    }

    /// Waits for the threads to end; every outcome must have been taken.
    pub(super) fn join(self) {
        drop(self.jobs);
        for thread in self.threads {
            // A thread that panicked has said so on standard error; there is nothing left to save.
            let _ = thread.join();
        }
    }
}

fn read_all(
    shared: &Shared,
    jobs: &Receiver<Job>,
    loaded: &Sender<Loaded>,
    finished: &Sender<Finished>,
    outcome: &Sender<Outcome>,
) {
    let share = weld_share(shared.pipeline.settings_in_force());
    for job in jobs {
        let handed_on = if shared.is_stopping() {
            outcome.send(Outcome::Dropped { job }).is_ok()
        } else if let Some(failure) = taken_by_another_root(shared, &job) {
            finished.send(Finished::Failed { job, failure }).is_ok()
        } else {
            match guarded("read", || load(&job.path, share)) {
                Ok(Ok(mesh)) if mesh.stamp == job.stamp => {
                    loaded.send(Loaded { job, mesh }).is_ok()
                }
                Ok(Ok(_) | Err(LoadError::Changed)) => {
                    outcome.send(Outcome::Changed { job }).is_ok()
                }
                Ok(Err(LoadError::Io(error))) if error.kind() == io::ErrorKind::NotFound => {
                    outcome.send(Outcome::Gone { job }).is_ok()
                }
                Ok(Err(error)) => {
                    let failure = Failure {
                        stage: "read",
                        message: error.to_string(),
                        hint: error.hint().to_owned(),
                        hash: error.hash().map(str::to_owned),
                        of_file: error.is_of_content(),
                    };
                    finished.send(Finished::Failed { job, failure }).is_ok()
                }
                Err(failure) => finished.send(Finished::Failed { job, failure }).is_ok(),
            }
        };
        if !handed_on {
            return;
        }
    }
}

/// Two watched folders may hold files of the same relative path, whose results would have the same place:
/// the folder named first in the configuration has it.
fn taken_by_another_root(shared: &Shared, job: &Job) -> Option<Failure> {
    let below = job.relative.components().count() > 1;
    let other = shared.config.watch[..job.root].iter().find(|other| {
        (other.recursive || !below)
            && other.include.take(&job.relative)
            && other.root.join(&job.relative).is_file()
    })?;
    Some(Failure {
        stage: "read",
        message: format!(
            "its results would replace those of {}",
            other.root.join(&job.relative).display()
        ),
        hint: "give one of the two files another name".to_owned(),
        hash: None,
        of_file: true,
    })
}

fn cut_all(
    shared: &Shared,
    to_cut: &Receiver<Loaded>,
    finished: &Sender<Finished>,
    outcome: &Sender<Outcome>,
) {
    let mut kept = None;
    for Loaded { job, mesh } in to_cut {
        if shared.is_stopping() {
            if outcome.send(Outcome::Dropped { job }).is_err() {
                return;
            }
            continue;
        }
        let mut worker = kept.take();
        let cut = guarded("pipeline", || {
            let worker = worker.get_or_insert_with(|| Worker::new(shared.pipeline.clone()));
            worker.segment(mesh.mesh.clone())
        });
        let failed = |stage, message, hint| Failure {
            stage,
            message,
            hint,
            hash: None,
            of_file: true,
        };
        let cut = match cut {
            Ok(Ok(segmentation)) => Ok(Box::new(segmentation)),
            Ok(Err(error)) => Err(failed(error.stage.name(), error.message, error.hint)),
            Err(panicked) => {
                // Its world may be half changed: the next mesh gets a new one.
                let broken = worker.take();
                let _ = catch_unwind(AssertUnwindSafe(|| drop(broken)));
                Err(panicked)
            }
        };
        kept = worker;
        let result = match cut {
            Ok(segmentation) => Finished::Cut {
                job,
                mesh,
                segmentation,
            },
            Err(failure) => Finished::Failed {
                job,
                failure: Failure {
                    hash: Some(mesh.hash),
                    ..failure
                },
            },
        };
        if finished.send(result).is_err() {
            return;
        }
    }
}

fn write_all(shared: &Shared, to_write: &Receiver<Finished>, outcome: &Sender<Outcome>) {
    for finished in to_write {
        if outcome.send(finish(shared, finished)).is_err() {
            return;
        }
    }
}

/// Runs work that may panic; the panic is one failed job.
fn guarded<T>(stage: &'static str, work: impl FnOnce() -> T) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let said = panic.downcast_ref::<&str>().copied();
        let said = said.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        let said = said
            .unwrap_or("no message")
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        Failure {
            stage,
            message: format!("panicked: {said}"),
            hint: "this is a mistake in the program or a plugin: please report it with the file"
                .to_owned(),
            hash: None,
            of_file: true,
        }
    })
}
