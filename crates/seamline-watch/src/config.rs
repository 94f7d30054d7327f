//! The configuration: one TOML file, of which the frame is read here and the rest is the pipeline's.
//!
//! Relative paths are relative to the file. An unknown key, a value of the wrong kind, a folder that would
//! feed itself is an error with file, line and key; nothing is done before all of it holds.

mod error;
mod file;
mod folders;
mod frame;
mod line;
mod rules;
mod schema;

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::time::Duration;

use seamline_ecs::settings::{SettingsError, SettingsTable};
use toml::{Table, Value};

pub use error::ConfigError;
pub use file::ConfigFile;
pub use frame::{
    After, DaemonTable, DoneTable, HttpTable, LimitsTable, LogFormat, LogLevel, LogTable,
    OutputTable, QuarantineTable, RetryTable, RuleTable, StateTable, WatchTable, Watcher,
};
pub use line::line_of_key;
pub use rules::Rule;
pub use schema::schema;

use crate::include::Patterns;
use crate::outputs::WriteSet;

/// One watched folder, checked.
#[derive(Clone, Debug)]
pub struct Watched {
    /// The folder, absolute, links resolved.
    pub root: PathBuf,
    /// Look into folders below it too?
    pub recursive: bool,
    /// Which files are taken.
    pub include: Patterns,
    /// Which are not, all the same.
    pub exclude: Patterns,
    /// How long size and time of change must have held still.
    pub stable_for: Duration,
    /// How long a file that ends early is taken for one that is still being written, and one that changes all the
    /// time is waited for by a run that is to have an end.
    pub max_wait: Duration,
    /// How changes are noticed.
    pub watcher: Watcher,
    /// Where the folder is polled: how often it is listed.
    pub poll_every: Duration,
    /// What becomes of a file once its results are written.
    pub after: After,
}

impl Watched {
    /// Is this the folder itself, or a place in it that is looked into?
    pub fn looks_at(&self, path: &Path) -> bool {
        if self.recursive {
            path.starts_with(&self.root)
        } else {
            path == self.root || path.parent() == Some(&self.root)
        }
    }
}

/// A configuration, checked: folders absolute, defaults filled in.
#[derive(Clone, Debug)]
pub struct Config {
    /// The watched folders; none is twice among them, none lies in another that is looked into below.
    pub watch: Vec<Watched>,
    /// Where results go.
    pub output: PathBuf,
    /// The files of each result.
    pub write: WriteSet,
    /// Where the daemon keeps what it must remember.
    pub state: PathBuf,
    /// Where files go that could not be cut.
    pub quarantine: PathBuf,
    /// Where files go after `after = "move"`.
    pub done: PathBuf,
    /// Meshes cut at the same time, at least one.
    pub workers: usize,
    /// Meshes that may wait between two steps.
    pub queue: usize,
    /// The folders are listed again after this long even if nothing was heard of them.
    pub rescan_every: Duration,
    /// What runs has this long to end once the daemon is told to stop.
    pub drain_for: Duration,
    /// What files and meshes may take.
    pub limits: LimitsTable,
    /// What is done when a disk fails.
    pub retry: RetryTable,
    /// Where health and metrics are told.
    pub http: Option<SocketAddr>,
    /// What is said.
    pub log: LogTable,
    pipeline: Table,
}

impl Config {
    /// Reads a file ([`ConfigFile::read`]) and checks what the daemon needs of it.
    ///
    /// # Errors
    ///
    /// As [`ConfigFile::read`] and [`Config::from_file`].
    pub fn load(path: &Path, pipeline_tables: &[SettingsTable]) -> Result<Self, ConfigError> {
        Self::from_file(&ConfigFile::read(path, pipeline_tables)?)
    }

    /// Checks what the daemon needs of a file. Looks at folders, creates none.
    ///
    /// # Errors
    ///
    /// An unknown key, a value of the wrong kind or out of range, a file in place of a watched folder, and
    /// folders of which one would feed the other. A watched folder that is not there is none: it may be a share
    /// that is not mounted yet.
    pub fn from_file(file: &ConfigFile) -> Result<Self, ConfigError> {
        let tables = file.tables();
        let output: OutputTable = file.table(tables.get("output"), "output")?;
        let quarantine: QuarantineTable = file.table(tables.get("quarantine"), "quarantine")?;
        let done: DoneTable = file.table(tables.get("done"), "done")?;
        let daemon: DaemonTable = file.table(tables.get("daemon"), "daemon")?;
        let limits: LimitsTable = file.table(tables.get("limits"), "limits")?;
        let retry: RetryTable = file.table(tables.get("retry"), "retry")?;
        let http: HttpTable = file.table(tables.get("http"), "http")?;
        let log: LogTable = file.table(tables.get("log"), "log")?;

        let place = |key: &str, dir: &Path| place(file, key, dir);
        let config = Self {
            watch: watched(file, &place)?,
            output: place("output.dir", &output.dir)?,
            write: WriteSet::from(&output.write[..]),
            state: Self::state_folder(file)?,
            quarantine: place("quarantine.dir", &quarantine.dir)?,
            done: place("done.dir", &done.dir)?,
            workers: match daemon.workers {
                0 => std::thread::available_parallelism().map_or(1, |cores| cores.get().min(4)),
                given => given,
            },
            queue: daemon.queue,
            rescan_every: Duration::from_millis(daemon.rescan_ms),
            drain_for: Duration::from_secs(daemon.drain_s),
            limits,
            retry,
            http: http.listen.parse().ok(),
            log,
            pipeline: file.pipeline_settings(),
        };
        folders::check(&config).map_err(|error| file.locate(error))?;
        Ok(config)
    }

    /// Where the daemon of a configuration keeps what it must remember, absolute. Nothing else of the file
    /// is looked at.
    ///
    /// # Errors
    ///
    /// A wrong `[state]`.
    pub fn state_folder(file: &ConfigFile) -> Result<PathBuf, ConfigError> {
        let state: StateTable = file.table(file.tables().get("state"), "state")?;
        place(file, "state.dir", &state.dir)
    }

    /// The watched folder that a path belongs to; nothing if none looks there.
    pub fn watched_with(&self, path: &Path) -> Option<&Watched> {
        innermost(self.watch.iter(), path, |watched| watched)
    }

    /// The tables that belong to the pipeline, untouched.
    pub fn pipeline_settings(&self) -> &Table {
        &self.pipeline
    }
}

/// Of `roots`, the one that a path belongs to. A folder that is not looked into below may have another watched one in
/// it, and sees that as a name: the inner one counts.
pub(crate) fn innermost<T>(
    roots: impl Iterator<Item = T>,
    path: &Path,
    watched: impl Fn(&T) -> &Watched,
) -> Option<T> {
    roots
        .filter(|root| watched(root).looks_at(path))
        .max_by_key(|root| watched(root).root.as_os_str().len())
}

/// The folder that a configuration names, which is relative to the file.
fn place(file: &ConfigFile, key: &str, dir: &Path) -> Result<PathBuf, ConfigError> {
    let base = file.path().parent().unwrap_or(Path::new(""));
    folders::resolve(&base.join(dir)).map_err(|error| {
        let reason = format!("{} cannot be looked at: {error}", base.join(dir).display());
        file.locate(SettingsError::new(
            key,
            reason,
            "name a folder that may be read",
        ))
    })
}

fn watched(
    file: &ConfigFile,
    place: &dyn Fn(&str, &Path) -> Result<PathBuf, ConfigError>,
) -> Result<Vec<Watched>, ConfigError> {
    let refuse =
        |key: &str, reason: String, hint: &str| file.locate(SettingsError::new(key, reason, hint));
    let elements = match file.tables().get("watch") {
        Some(Value::Array(elements)) if !elements.is_empty() => elements,
        Some(Value::Table(_)) => {
            return Err(refuse(
                "watch",
                "is one table".to_owned(),
                "wants a list: write `[[watch]]`",
            ));
        }
        _ => {
            return Err(refuse(
                "watch",
                "no folder to watch".to_owned(),
                "add `[[watch]]` with `root = \"inbox\"`",
            ));
        }
    };
    let mut watched = Vec::new();
    for (at, element) in elements.iter().enumerate() {
        let here = format!("watch.{at}");
        let key = format!("{here}.root");
        let table: WatchTable = file.table(Some(element), &here)?;
        let root = place(&key, &table.root)?;
        if root.exists() && !root.is_dir() {
            let reason = format!("{} is not a folder", root.display());
            return Err(refuse(&key, reason, "name a folder"));
        }
        let patterns = |key: &str, patterns: &[String]| {
            Patterns::new(patterns).map_err(|error| {
                refuse(
                    &format!("{here}.{key}"),
                    error,
                    "as in `include = [\"*.stl\"]`",
                )
            })
        };
        watched.push(Watched {
            root,
            recursive: table.recursive,
            include: patterns("include", &table.include)?,
            exclude: patterns("exclude", &table.exclude)?,
            stable_for: Duration::from_millis(table.stable_for_ms),
            max_wait: Duration::from_millis(table.max_wait_ms),
            watcher: table.watcher,
            poll_every: Duration::from_millis(table.poll_ms),
            after: table.after,
        });
    }
    Ok(watched)
}

#[cfg(test)]
mod tests;
