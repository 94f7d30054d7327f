//! The threads: one reads, some cut, one writes, one deals with sources, with channels between them.
//!
//! A slow disk or a slow mesh fills the bounded channel behind it, and whoever comes before waits: no more
//! meshes are in memory than the channels and the threads hold, and no more than the memory limit has room for.

mod cutter;
mod guard;
mod reader;
mod settler;
mod writer;

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, bounded, unbounded};
use seamline_ecs::Progress;

use super::job::{Cut, Failure, Job, Loaded, Outcome, Settle};
use crate::health::Health;
use crate::ledger::{JobId, LedgerError, Reader};
use crate::memory::{Gate, share_of_meshes};
use crate::metrics::Metrics;
use crate::setup::Setup;

/// What all threads know.
pub(super) struct Shared {
    pub gate: Gate,
    pub health: Arc<Health>,
    pub metrics: Arc<Metrics>,
    /// Where results go by the configuration in force, which may not be that of a job.
    output: Mutex<PathBuf>,
    /// Who works on which bytes, by their hash and that of the settings.
    claims: Mutex<HashMap<(String, String), JobId>>,
    /// The meshes that are being cut, the hashes of their files, and since when.
    cutting: Mutex<HashMap<JobId, Cutting>>,
    /// Cutters that were given up and have not come back.
    abandoned: AtomicUsize,
    stopping: AtomicBool,
}

/// A mesh that is being cut.
struct Cutting {
    job: Job,
    /// BLAKE3 of the file.
    content: String,
    since: Instant,
    progress: Progress,
}

impl Shared {
    pub(super) fn is_stopping(&self) -> bool {
        self.stopping.load(Ordering::Relaxed)
    }

    /// Do results go to this folder by the configuration in force?
    fn writes_to(&self, output: &Path) -> bool {
        *locked(&self.output) == output
    }

    fn claims(&self) -> MutexGuard<'_, HashMap<(String, String), JobId>> {
        locked(&self.claims)
    }

    fn cutting(&self) -> MutexGuard<'_, HashMap<JobId, Cutting>> {
        locked(&self.cutting)
    }

    /// Runs one stage and notes how long it took by the clock.
    fn timed<T>(&self, stage: &str, work: impl FnOnce() -> T) -> T {
        let started = Instant::now();
        let done = work();
        self.metrics.stage_took(stage, started.elapsed());
        done
    }
}

/// What is in there is whole after every step, so that a panic elsewhere does not spoil it.
fn locked<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Why the threads cannot be started.
#[derive(Debug, thiserror::Error)]
pub(super) enum StartError {
    #[error("{0}")]
    Threads(#[from] io::Error),
    #[error("{0}")]
    Ledger(#[from] LedgerError),
}

/// The threads, the way in and the way out.
pub(super) struct Crew {
    jobs: Sender<Job>,
    settle: Sender<Settle>,
    outcomes: Receiver<Outcome>,
    cutters: Cutters,
    threads: Vec<JoinHandle<()>>,
    shared: Arc<Shared>,
}

/// What a new cutter needs: one is started in the place of each that is given up.
struct Cutters {
    to_cut: Receiver<Loaded>,
    cut: Sender<Cut>,
    outcome: Sender<Outcome>,
    started: usize,
}

impl Crew {
    /// Starts the threads.
    pub(super) fn start(
        setup: &Setup,
        health: Arc<Health>,
        metrics: Arc<Metrics>,
    ) -> Result<Self, StartError> {
        let config = &setup.config;
        let shared = Arc::new(Shared {
            gate: Gate::new(share_of_meshes(setup.memory_limit_bytes)),
            health,
            metrics,
            output: Mutex::new(config.output.clone()),
            claims: Mutex::default(),
            cutting: Mutex::default(),
            abandoned: AtomicUsize::new(0),
            stopping: AtomicBool::new(false),
        });
        let (jobs, to_read) = bounded(config.queue);
        let (loaded, to_cut) = bounded(config.queue);
        let (cut, to_write) = bounded(config.queue);
        // Names only, and of running jobs only.
        let (settle, to_settle) = unbounded();
        // Room for some, so that nobody waits while the folders are being listed.
        let (outcome, outcomes) = bounded(256);

        let mut crew = Self {
            jobs,
            settle,
            outcomes,
            cutters: Cutters {
                to_cut,
                cut,
                outcome: outcome.clone(),
                started: 0,
            },
            threads: Vec::new(),
            shared: shared.clone(),
        };
        for _ in 0..config.workers {
            crew.start_cutter()?;
        }
        let ledger = Reader::open(&config.state)?;
        let of_reader = (shared.clone(), outcome.clone());
        crew.spawn("read", move || {
            reader::read_all(&of_reader.0, &ledger, &to_read, &loaded, &of_reader.1);
        })?;
        let of_writer = (shared.clone(), outcome.clone());
        crew.spawn("write", move || {
            writer::write_all(&of_writer.0, &to_write, &of_writer.1);
        })?;
        crew.spawn("settle", move || {
            settler::settle_all(&shared, &to_settle, &outcome);
        })?;
        Ok(crew)
    }

    fn spawn(&mut self, name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
        let thread = Builder::new().name(name.to_owned()).spawn(work)?;
        self.threads.push(thread);
        Ok(())
    }

    fn start_cutter(&mut self) -> io::Result<()> {
        let Cutters {
            to_cut,
            cut,
            outcome,
            started,
        } = &mut self.cutters;
        *started += 1;
        let name = format!("cut-{started}");
        let (to_cut, cut, outcome) = (to_cut.clone(), cut.clone(), outcome.clone());
        let shared = self.shared.clone();
        self.spawn(&name, move || {
            cutter::cut_all(&shared, &to_cut, &cut, &outcome);
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

    /// Has the source of a job dealt with. False if the threads are gone.
    pub(super) fn settle(&self, job: Job, failure: Option<Failure>) -> bool {
        self.settle.send(Settle { job, failure }).is_ok()
    }

    /// Where outcomes come out.
    pub(super) fn outcomes(&self) -> &Receiver<Outcome> {
        &self.outcomes
    }

    /// The bytes this job worked on are free again.
    pub(super) fn release(&self, id: JobId) {
        let mut claims = self.shared.claims();
        claims.retain(|_, holder| *holder != id);
    }

    /// Gives up the cutters that have been at one mesh for longer than its limit, and starts others in
    /// their place. Gives the jobs that have thereby failed.
    pub(super) fn give_up_overdue(&mut self, now: Instant) -> io::Result<Vec<(Job, Failure)>> {
        let overdue: Vec<_> = {
            let mut cutting = self.shared.cutting();
            let is_overdue = |cut: &Cutting| {
                let limit = cut.job.setup.config.limits.job_timeout_s;
                limit > 0 && now.saturating_duration_since(cut.since) >= Duration::from_secs(limit)
            };
            let ids: Vec<_> = cutting
                .iter()
                .filter(|(_, cut)| is_overdue(cut))
                .map(|(id, _)| *id)
                .collect();
            ids.iter().filter_map(|id| cutting.remove(id)).collect()
        };
        let mut failed = Vec::new();
        for Cutting {
            job,
            content,
            progress,
            ..
        } in overdue
        {
            self.shared.abandoned.fetch_add(1, Ordering::Relaxed);
            self.start_cutter()?;
            let limit = job.setup.config.limits.job_timeout_s;
            let failure = Failure::new(
                progress.stage().name(),
                format!("was not cut within {limit} s"),
                "raise `limits.job_timeout_s`, or try another classifier or rectifier",
            );
            failed.push((job, failure.of(content)));
        }
        Ok(failed)
    }

    /// How many cutters were given up and have not come back.
    pub(super) fn abandoned(&self) -> usize {
        self.shared.abandoned.load(Ordering::Relaxed)
    }

    /// From now on another configuration is in force.
    pub(super) fn change_to(&self, setup: &Setup) {
        let meshes = share_of_meshes(setup.memory_limit_bytes);
        self.shared.gate.set_limit(meshes);
        locked(&self.shared.output).clone_from(&setup.config.output);
    }

    /// The admission to memory.
    pub(super) fn gate(&self) -> &Gate {
        &self.shared.gate
    }

    /// From now on, what is not begun is not begun any more.
    pub(super) fn begin_nothing_new(&self) {
        self.shared.stopping.store(true, Ordering::Relaxed);
    }

    /// Waits for the threads to end; every outcome must have been taken. Those that were given up are not
    /// waited for.
    pub(super) fn join(self) {
        let hanging = self.abandoned() > 0;
        drop((self.jobs, self.settle, self.cutters));
        for thread in self.threads {
            if !hanging {
                // A thread that panicked has said so on standard error; there is nothing left to save.
                let _ = thread.join();
            }
        }
    }
}
