//! The watch folder: files in, results out, one bad file never in the way of the others.
//!
//! One thread looks into the folders and keeps the books; the others read, cut and write
//! (`crew`). The bookkeeping is pure and tested apart: which file is ready ([`crate::tracker`]), which job
//! may run (`backlog`).

mod backlog;
mod crew;
mod finish;
mod job;
mod lookout;

use std::fs;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvError, never, select};
use seamline_ecs::Pipeline;
use tracing::{error, info, warn};

use crate::config::{After, Config};
use crate::events::Events;
use crate::outputs::sweep_leftovers;
use crate::shown;
use backlog::Backlog;
use crew::Crew;
use job::Outcome;
use lookout::Lookout;

/// How the daemon is to run.
#[derive(Clone, Copy, Debug, Default)]
pub struct RunOptions {
    /// Cut what lies in the folders now, and end.
    pub once: bool,
    /// Say what would be taken, and do none of it.
    pub dry_run: bool,
}

/// What came of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Jobs whose results are written.
    pub done: usize,
    /// Jobs that failed.
    pub failed: usize,
    /// Jobs that were waiting when the daemon was stopped; their files are where they were.
    pub dropped: usize,
    /// Empty files, which wait for content.
    pub empty: usize,
    /// With `dry_run`: the files that would be taken, by folder and path.
    pub listed: Vec<PathBuf>,
}

/// What ends the daemon, as opposed to one job.
#[derive(Debug, thiserror::Error)]
pub enum WatchError {
    /// A folder it needs cannot be made.
    #[error("{} cannot be created: {error}", .path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// The system gives no more threads.
    #[error("no thread can be started: {0}")]
    Threads(io::Error),
    /// The threads ended by themselves.
    #[error("the threads that read, cut and write have ended unexpectedly")]
    CrewLost,
}

impl WatchError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Folder { .. } => "name a folder that may be written, or create it",
            Self::Threads(_) => "set fewer `daemon.workers`, or raise the limit of processes",
            Self::CrewLost => {
                "this is a mistake in the program: please report what was said before"
            }
        }
    }
}

/// Watches the folders of `config` and sends what is dropped there through `pipeline`.
///
/// Ends when `stop` has a message: what runs is finished, what only waits is dropped and stays in its folder.
/// With `once` it ends when everything that lay there at the start is dealt with. Creates the folders it
/// writes to and deletes what crashed runs left unfinished in them.
///
/// # Errors
///
/// [`WatchError`]. Files that cannot be cut are no error; they are counted in the summary.
pub fn run(
    config: Config,
    pipeline: Arc<Pipeline>,
    options: RunOptions,
    stop: Receiver<()>,
) -> Result<Summary, WatchError> {
    let mut lookout = Lookout::new(&config, options.once);
    if options.dry_run {
        return Ok(Summary {
            listed: lookout.list(),
            ..Summary::default()
        });
    }
    prepare(&config)?;
    // Before the first look: what comes between the two is heard of, or seen.
    let mut events = Events::listen(&config.watch);
    for watched in &config.watch {
        info!("watching {}", watched.root.display());
    }
    let crew = Crew::start(config, pipeline).map_err(WatchError::Threads)?;
    let mut books = Books {
        lookout,
        backlog: Backlog::default(),
        summary: Summary::default(),
    };
    let kept = books.keep(&crew, &mut events, options.once, stop);
    // On an error too: nothing new is begun, and threads that still live are let go.
    crew.begin_nothing_new();
    match kept {
        Ok(()) => crew.join(),
        Err(error) => return Err(error),
    }
    books.summary.empty = books.lookout.empty();
    Ok(books.summary)
}

fn prepare(config: &Config) -> Result<(), WatchError> {
    let done = config
        .watch
        .iter()
        .any(|watched| watched.after == After::Move)
        .then_some(&config.done);
    for folder in [&config.output, &config.state, &config.quarantine]
        .into_iter()
        .chain(done)
    {
        let refused = |error| WatchError::Folder {
            path: folder.clone(),
            error,
        };
        fs::create_dir_all(folder).map_err(refused)?;
        sweep_leftovers(folder);
    }
    Ok(())
}

/// What is ready, what waits, what came of it.
struct Books {
    lookout: Lookout,
    backlog: Backlog,
    summary: Summary,
}

impl Books {
    /// Keeps the books until the daemon is to end, and then until the last running job has ended.
    fn keep(
        &mut self,
        crew: &Crew,
        events: &mut Events,
        once: bool,
        mut stop: Receiver<()>,
    ) -> Result<(), WatchError> {
        let mut hints = events.hints().clone();
        loop {
            if self.lookout.wait(Instant::now()).is_zero() {
                for job in self.lookout.look() {
                    self.backlog.add(job);
                }
            }
            while crew.has_room()
                && let Some(job) = self.backlog.next()
            {
                if !crew.hand_over(job) {
                    return Err(WatchError::CrewLost);
                }
            }
            let idle = self.backlog.running() == 0 && self.backlog.waiting() == 0;
            if once && idle && self.lookout.is_settled() {
                return Ok(());
            }
            // Room among the jobs comes without a message; it is looked for while jobs wait.
            let most = if self.backlog.waiting() > 0 {
                Duration::from_millis(50)
            } else {
                Duration::MAX
            };
            select! {
                recv(crew.outcomes()) -> outcome => self.enter(outcome)?,
                recv(hints) -> hint => match hint {
                    Ok(()) => {
                        events.take();
                        self.lookout.hint();
                    }
                    // Nothing more will be heard; the periodic listing goes on.
                    Err(RecvError) => hints = never(),
                },
                recv(stop) -> signal => match signal {
                    Ok(()) => break,
                    // Nobody is left who could stop the daemon, which is no reason to stop.
                    Err(RecvError) => stop = never(),
                },
                default(self.lookout.wait(Instant::now()).min(most)) => {}
            }
        }
        info!(
            "stopping: {} running, {} waiting",
            self.backlog.running(),
            self.backlog.waiting()
        );
        crew.begin_nothing_new();
        self.summary.dropped += self.backlog.drop_waiting();
        while self.backlog.running() > 0 {
            self.enter(crew.outcomes().recv())?;
        }
        Ok(())
    }

    fn enter(&mut self, outcome: Result<Outcome, RecvError>) -> Result<(), WatchError> {
        let outcome = outcome.map_err(|_| WatchError::CrewLost)?;
        self.backlog.ended(&outcome.job().path);
        let path = shown(&outcome.job().path);
        match &outcome {
            Outcome::Done { patches, took, .. } => {
                self.summary.done += 1;
                info!(
                    "{path}: cut in {:.2} s, patches: {patches}",
                    took.as_secs_f64()
                );
            }
            Outcome::Failed {
                failure,
                quarantined,
                ..
            } => {
                self.summary.failed += 1;
                let (stage, message, hint) = (failure.stage, &failure.message, &failure.hint);
                match quarantined {
                    Some(place) => {
                        warn!(
                            "{path}: {stage}: {message}; {hint}; moved to {}",
                            place.display()
                        );
                    }
                    None => error!("{path}: {stage}: {message}; {hint}"),
                }
            }
            Outcome::Changed { job } => self.lookout.take_back(job),
            Outcome::Gone { .. } => info!("{path}: gone before it was read"),
            Outcome::Dropped { .. } => self.summary.dropped += 1,
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
