//! The ledger, as `seamline status --json` tells it.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;

/// What the ledger holds.
#[derive(Clone, Debug, Deserialize)]
pub struct Status {
    /// Whether a daemon runs, and as which process.
    pub daemon: Running,
    /// How many jobs there are in each state.
    pub counts: BTreeMap<String, u64>,
    /// Every job, by id.
    pub jobs: Vec<Job>,
}

/// Whether a daemon runs.
#[derive(Clone, Debug, Deserialize)]
pub struct Running {
    /// Does it?
    pub running: bool,
    /// Its process.
    pub pid: Option<u32>,
}

/// One row of the ledger.
#[derive(Clone, Debug, Deserialize)]
pub struct Job {
    /// Its number.
    pub id: i64,
    /// Where the file was dropped.
    pub path: PathBuf,
    /// The same, below the watched folder.
    pub relative: PathBuf,
    /// `pending`, `running`, `done`, `quarantined` or `gone`.
    pub state: String,
    /// Hash of its bytes, once they were read.
    pub content: Option<String>,
    /// Hash of the settings in force, once it was begun.
    pub settings: Option<String>,
    /// How often it was begun.
    pub attempts: u32,
    /// When its file was ready.
    pub queued_at: Option<String>,
    /// When it was begun last.
    pub started_at: Option<String>,
    /// When it was done or given up.
    pub ended_at: Option<String>,
    /// Where it failed.
    pub stage: Option<String>,
    /// Why it failed.
    pub message: Option<String>,
    /// What to do about that.
    pub hint: Option<String>,
    /// The folder of its results.
    pub result: Option<PathBuf>,
    /// Where the file is now, if it was moved.
    pub source: Option<PathBuf>,
    /// The job whose results are its own as well.
    pub same_as: Option<i64>,
    /// The version of the program that dealt with it.
    pub program_version: Option<String>,
}

impl Status {
    /// Reads what the command printed.
    ///
    /// # Panics
    ///
    /// If it is not what is promised.
    pub fn parse(text: &str) -> Self {
        serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in\n{text}"))
    }

    /// How many jobs are in a state.
    pub fn count(&self, state: &str) -> u64 {
        self.counts.get(state).copied().unwrap_or(0)
    }

    /// The jobs of a file, by its path below the watched folder.
    pub fn jobs_of(&self, relative: &str) -> Vec<&Job> {
        let jobs = self.jobs.iter();
        jobs.filter(|job| job.relative.as_os_str() == relative)
            .collect()
    }

    /// The one job of a file.
    ///
    /// # Panics
    ///
    /// If there is none, or another.
    #[track_caller]
    pub fn only(&self, relative: &str) -> &Job {
        match self.jobs_of(relative)[..] {
            [job] => job,
            _ => panic!("not one job of {relative} in {self:#?}"),
        }
    }

    /// The latest job of a file.
    pub fn latest(&self, relative: &str) -> Option<&Job> {
        self.jobs_of(relative).last().copied()
    }

    /// Is the latest job of a file in this state?
    pub fn is(&self, relative: &str, state: &str) -> bool {
        self.latest(relative).is_some_and(|job| job.state == state)
    }
}
