//! The watch folder: files in, results out, one bad file never in the way of the others.
//!
//! One thread looks into the folders and keeps the books (`books`); the others read, cut, write and deal with
//! sources (`crew`). What each file has come to stands in the [`crate::ledger`], which the books alone write.
//! The bookkeeping is pure where it can be and tested apart: which file is ready ([`crate::tracker`]), which job
//! may run (`backlog`), when to try again ([`crate::retry`]).

mod backlog;
mod books;
mod crew;
mod job;
mod lookout;
mod reload;

use std::collections::{HashMap, HashSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crossbeam_channel::Receiver;
use tracing::{info, warn};

use crate::config::{After, Config};
use crate::events::Events;
use crate::health::Health;
use crate::http::{self, ServeError};
use crate::ledger::{Ledger, LedgerError, Reader};
use crate::lock::{InstanceLock, LockError};
use crate::metrics::Metrics;
use crate::mounts::trusts_events;
use crate::outputs::sweep_leftovers;
use crate::pairs::{markings_in, markings_of, stem};
use crate::setup::Setup;
use crate::shown;
use crate::tracker::{FileFact, Stamp};
use crate::{VERSION, service};
use books::Books;
use crew::{Crew, StartError};
use lookout::Lookout;
pub use reload::Reload;

/// How the daemon is to run.
#[derive(Clone, Copy, Debug, Default)]
pub struct RunOptions {
    /// Cut what lies in the folders now, and end.
    pub once: bool,
    /// Say what would be taken, and do none of it.
    pub dry_run: bool,
}

/// What the daemon can be told while it runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// End what runs and stop. Said twice: stop at once.
    Stop,
    /// Read the configuration anew.
    Reload,
}

/// What came of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Jobs whose results are written.
    pub done: usize,
    /// Jobs whose bytes had been cut before.
    pub same: usize,
    /// Jobs that failed.
    pub failed: usize,
    /// Jobs that were waiting when the daemon was stopped; their files are where they were.
    pub dropped: usize,
    /// Jobs that did not end in time when the daemon was stopped; they are done again.
    pub unfinished: usize,
    /// Empty files, which wait for content.
    pub empty: usize,
    /// With `dry_run`: the files that would be taken and are not done yet, by folder and path.
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
    /// Another process works with the same state folder.
    #[error("{0}")]
    Locked(#[from] LockError),
    /// The ledger cannot be used.
    #[error("{0}")]
    Ledger(#[from] LedgerError),
    /// Health and metrics cannot be served.
    #[error("{0}")]
    Http(#[from] ServeError),
    /// The system gives no more threads.
    #[error("no thread can be started: {0}")]
    Threads(io::Error),
    /// The threads ended by themselves.
    #[error("the threads that read, cut and write have ended unexpectedly")]
    CrewLost,
    /// A watched folder is not there, and the run is not one that waits for it.
    #[error("the watched folder {} is not there", .0.display())]
    NotThere(PathBuf),
    /// The state folder was deleted or replaced while it was in use.
    #[error("the state folder {} was taken away", .0.display())]
    StateGone(PathBuf),
    /// So many meshes hang that going on is of no use.
    #[error("{0} meshes hang in the pipeline")]
    Hanging(usize),
}

impl WatchError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Folder { .. } => "name a folder that may be written, or create it",
            Self::Locked(error) => error.hint(),
            Self::Ledger(error) => error.hint(),
            Self::Http(error) => error.hint(),
            Self::Threads(_) => "set fewer `daemon.workers`, or raise the limit of processes",
            Self::CrewLost => {
                "this is a mistake in the program: please report what was said before"
            }
            Self::NotThere(_) => "create or mount it; without `--once` it is waited for",
            Self::StateGone(_) => {
                "start again; without its ledger everything in the watched folders is cut anew"
            }
            Self::Hanging(_) => {
                "start again; `seamline status` tells which files were given up, choose another plugin for them"
            }
        }
    }
}

/// Watches the folders of `setup` and sends what is dropped there through its pipeline.
///
/// Ends when told to: what runs is finished, for as long as `daemon.drain_s` allows; what only waits stays in its
/// folder and in the ledger. With `once` it ends when everything that lay there at the start is dealt
/// with. Creates the folders it writes to and deletes what crashed runs left unfinished in them.
///
/// # Errors
///
/// [`WatchError`]. Files that cannot be cut are no error; they are counted in the summary.
pub fn run(
    setup: Setup,
    reload: Option<Reload>,
    options: RunOptions,
    orders: Receiver<Order>,
) -> Result<Summary, WatchError> {
    if options.once || options.dry_run {
        check_presence(&setup.config)?;
    }
    let setup = Arc::new(setup);
    let mut lookout = Lookout::new(&setup.config, setup.has_pairs(), options.once);
    if options.dry_run {
        return Ok(Summary {
            listed: still_to_be_cut(lookout.list(), &setup),
            ..Summary::default()
        });
    }
    let config = &setup.config;
    make_folders(config)?;
    let lock = InstanceLock::take(&config.state)?;
    let ledger = open_ledger(config)?;
    sweep(config);

    let (health, metrics) = (Arc::new(Health::new()), Arc::new(Metrics::new(VERSION)));
    let serving = config
        .http
        .map(|listen| http::serve(listen, health.clone(), metrics.clone()))
        .transpose()?;
    if let Some(serving) = &serving {
        info!("listening on http://{}", serving.address());
    }
    // Before the first look: what comes between the two is heard of, or seen.
    let events = Events::listen(&config.watch);
    for watched in &config.watch {
        info!("watching {}", shown(&watched.root));
    }
    let crew =
        Crew::start(&setup, health.clone(), metrics.clone()).map_err(|error| match error {
            StartError::Threads(error) => WatchError::Threads(error),
            StartError::Ledger(error) => WatchError::Ledger(error),
        })?;
    let books = Books {
        setup,
        reload,
        ledger,
        lookout,
        events,
        crew,
        health,
        metrics,
        options,
        orders,
        lock,
    };
    let ended = books.keep();
    service::stopping();
    ended
}

/// Who wants an end is told of a folder that is not there: nothing of it would be done.
fn check_presence(config: &Config) -> Result<(), WatchError> {
    let mut roots = config.watch.iter().map(|watched| &watched.root);
    match roots.find(|root| !root.is_dir()) {
        Some(missing) => Err(WatchError::NotThere(missing.clone())),
        None => Ok(()),
    }
}

/// The files that have not ended in the state they are in, as far as there is a ledger to tell. Markings are told with
/// their mesh, and by themselves where none is there.
fn still_to_be_cut(files: Vec<FileFact>, setup: &Arc<Setup>) -> Vec<PathBuf> {
    let ledger = Reader::open(&setup.config.state).ok();
    let by_path: HashMap<&Path, Stamp> =
        files.iter().map(|file| (&*file.path, file.stamp)).collect();
    let is_of_pair = |path: &Path| setup.has_pairs() && setup.is_of_pair(path);
    let has_ended = |file: &FileFact| {
        let Some(ledger) = &ledger else { return false };
        let settings = &setup.for_file(&file.path).settings_hash;
        let markings = markings_of(&file.path)
            .into_iter()
            .filter(|_| is_of_pair(&file.path))
            .find_map(|path| by_path.get(&*path).copied());
        let stamp = job::stamp_word(file.stamp, markings);
        let ended = ledger.has_ended(&file.path, &stamp, settings);
        ended.unwrap_or(false)
    };
    let stems: HashSet<PathBuf> = files
        .iter()
        .filter(|file| markings_in(&file.path).is_none())
        .map(|file| stem(&file.path))
        .collect();
    let is_asked_for = |file: &&FileFact| {
        markings_in(&file.path).is_none()
            || (is_of_pair(&file.path) && !stems.contains(&stem(&file.path)))
    };
    let open = files.iter().filter(is_asked_for);
    let open = open.filter(|file| !has_ended(file));
    open.map(|file| file.path.clone()).collect()
}

pub(super) fn make_folders(config: &Config) -> Result<(), WatchError> {
    for folder in written_to(config) {
        fs::create_dir_all(folder).map_err(|error| WatchError::Folder {
            path: folder.clone(),
            error,
        })?;
    }
    Ok(())
}

fn written_to(config: &Config) -> impl Iterator<Item = &PathBuf> {
    let moves = config
        .watch
        .iter()
        .any(|watched| watched.after == After::Move);
    [&config.output, &config.state, &config.quarantine]
        .into_iter()
        .chain(moves.then_some(&config.done))
}

fn sweep(config: &Config) {
    for folder in written_to(config) {
        sweep_leftovers(folder);
    }
}

fn open_ledger(config: &Config) -> Result<Ledger, WatchError> {
    if let Err(distrust) = trusts_events(&config.state) {
        warn!(
            "the state folder {} lies on a network file system ({}): the ledger may be damaged; \
             set `state.dir` to a folder on a local disk",
            shown(&config.state),
            distrust.kind
        );
    }
    let mut ledger = Ledger::open(&config.state)?;
    let (again, given_up) = ledger.recover()?;
    if again + given_up > 0 {
        info!(
            "the last run ended in the middle of its work: {again} to be done again, {given_up} given up"
        );
    }
    Ok(ledger)
}

#[cfg(test)]
mod tests;
