//! A folder of its own for one test.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};

use super::{Daemon, Mode, Results, Status};
use crate::{Ran, run, seamline};

/// A temporary folder with `inbox` in it and `watch.toml` beside that; everything else has its default place.
pub struct Home {
    folder: tempfile::TempDir,
    logs: AtomicU32,
}

impl Home {
    /// With files taken soon, and everything else by default.
    pub fn new() -> Self {
        Self::with("stable_for_ms = 200\n")
    }

    /// `more` is the end of the `[[watch]]` table, and whatever is to follow it.
    ///
    /// # Panics
    ///
    /// If the folder cannot be made, as everything here panics that would end a test.
    pub fn with(more: &str) -> Self {
        let home = Self {
            folder: tempfile::tempdir().unwrap(),
            logs: AtomicU32::new(0),
        };
        fs::create_dir(home.inbox()).unwrap();
        home.configure(more);
        home
    }

    /// As [`Home::with`], with changes noticed in the way given.
    pub fn in_mode(mode: Mode, more: &str) -> Self {
        Self::with(&format!("{}{more}", mode.lines()))
    }

    /// Writes another configuration in place of the one that is there, in one step.
    pub fn configure(&self, more: &str) {
        let text = format!("[[watch]]\nroot = \"inbox\"\n{more}");
        fs::write(self.at("watch.toml.new"), text).unwrap();
        fs::rename(self.at("watch.toml.new"), self.config()).unwrap();
    }

    /// The folder itself, as the program names it.
    pub fn path(&self) -> PathBuf {
        self.folder.path().canonicalize().unwrap()
    }

    /// A place in it.
    pub fn at(&self, name: impl AsRef<Path>) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The configuration.
    pub fn config(&self) -> PathBuf {
        self.at("watch.toml")
    }

    /// The watched folder.
    pub fn inbox(&self) -> PathBuf {
        self.at("inbox")
    }

    /// Writes a file into the watched folder as a copying program would: made, filled, closed.
    pub fn drop(&self, name: impl AsRef<Path>, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.inbox().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        path
    }

    /// The results, and what lies in quarantine.
    pub fn results(&self) -> Results {
        Results {
            out: self.at("out"),
            quarantine: self.at("quarantine"),
        }
    }

    /// The folder of results of one input.
    pub fn result(&self, name: &str) -> PathBuf {
        self.results().folder(name)
    }

    /// How many labels the result of one input has; 0 if there is none.
    pub fn labels(&self, name: &str) -> usize {
        self.results().labels(name)
    }

    /// Why a file is in quarantine, if it is.
    pub fn reason(&self, name: &str) -> Option<serde_json::Value> {
        self.results().reason(name)
    }

    /// `seamline watch CONFIG`, still to be started.
    pub fn watch(&self) -> Command {
        let mut command = seamline();
        command.arg("watch").arg(self.config());
        command
    }

    /// Runs `seamline watch CONFIG --once`.
    pub fn once(&self) -> Ran {
        run(self.watch().arg("--once"))
    }

    /// Starts the daemon and waits until it watches.
    pub fn start(&self) -> Daemon {
        self.start_as(&mut self.watch())
    }

    /// As [`Home::start`], by another command that ends in being the daemon.
    pub fn start_as(&self, command: &mut Command) -> Daemon {
        let mut daemon = self.spawn(command);
        daemon.wait_until_watching();
        daemon
    }

    /// Starts a command as the daemon and waits for nothing. Each has a log of its own.
    pub fn spawn(&self, command: &mut Command) -> Daemon {
        let number = self.logs.fetch_add(1, Ordering::Relaxed);
        Daemon::spawn(command, self.at(format!("log-{number}")))
    }

    /// `seamline status CONFIG --json`.
    pub fn status(&self) -> Status {
        let ran = run(seamline().arg("status").arg(self.config()).arg("--json"));
        Status::parse(&ran.ended(0).out)
    }

    /// `seamline requeue CONFIG WHAT...`, which must succeed.
    pub fn requeue(&self, what: &[&str]) -> Ran {
        run(seamline().arg("requeue").arg(self.config()).args(what)).ended(0)
    }

    /// Brings back the files that were in quarantine only because the daemon was killed again and again while
    /// it worked on them, and tells how many there were.
    pub fn requeue_casualties(&self) -> usize {
        let jobs = self.status().jobs.into_iter();
        let blamed =
            jobs.filter(|job| job.state == "quarantined" && job.stage.as_deref() == Some("run"));
        let ids: Vec<_> = blamed.map(|job| job.id.to_string()).collect();
        if !ids.is_empty() {
            self.requeue(&ids.iter().map(String::as_str).collect::<Vec<_>>());
        }
        ids.len()
    }
}

impl Default for Home {
    fn default() -> Self {
        Self::new()
    }
}
