//! One row of the ledger, as it is read.

use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;
use std::path::PathBuf;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use rusqlite::types::{FromSql, FromSqlError, FromSqlResult, ValueRef};
use rusqlite::{Result, Row as SqlRow};

/// The number of a job. Never given twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JobId(pub i64);

/// How far a job has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JobState {
    /// It waits.
    Pending,
    /// It is worked on.
    Running,
    /// Its results are on disk.
    Done,
    /// It failed for good.
    Quarantined,
    /// Its file went away or was replaced before it was done.
    Gone,
}

impl JobState {
    /// All states, in the order a job takes them.
    pub const ALL: [Self; 5] = [
        Self::Pending,
        Self::Running,
        Self::Done,
        Self::Quarantined,
        Self::Gone,
    ];

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pending => "pending",
            Self::Running => "running",
            Self::Done => "done",
            Self::Quarantined => "quarantined",
            Self::Gone => "gone",
        }
    }
}

impl FromSql for JobState {
    fn column_result(value: ValueRef<'_>) -> FromSqlResult<Self> {
        let word = value.as_str()?;
        let known = Self::ALL.into_iter().find(|state| state.word() == word);
        known.ok_or(FromSqlError::InvalidType)
    }
}

/// One job, as the ledger has it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its number.
    pub id: JobId,
    /// The file, absolute.
    pub path: PathBuf,
    /// The file below its watched folder.
    pub relative: PathBuf,
    /// Size, times and inode in which the file held still.
    pub stamp: String,
    /// BLAKE3 of the bytes in hexadecimal, once they were read.
    pub content: Option<String>,
    /// BLAKE3 of the settings in hexadecimal, once it was begun.
    pub settings: Option<String>,
    /// How far it has come.
    pub state: JobState,
    /// How often it was begun.
    pub attempts: u32,
    /// When the file was found ready.
    pub queued_at: SystemTime,
    /// When it was begun last.
    pub started_at: Option<SystemTime>,
    /// When it ended.
    pub ended_at: Option<SystemTime>,
    /// Where it failed last.
    pub stage: Option<String>,
    /// What went wrong last.
    pub message: Option<String>,
    /// What would have been right.
    pub hint: Option<String>,
    /// The folder of results, for as long as no other job's results have replaced them.
    pub result: Option<PathBuf>,
    /// Where the file was put afterwards; empty if it was deleted, nothing if it is at its path.
    pub source: Option<PathBuf>,
    /// The job that has the results, where the same bytes were cut before.
    pub same_as: Option<JobId>,
    /// The version of the program that worked on it.
    pub program_version: Option<String>,
}

/// The columns of a [`Row`], in order.
pub(super) const COLUMNS: &str = "id, path, relative, stamp, content, settings, state, attempts, \
     queued_at, started_at, ended_at, stage, message, hint, result, source, same_as, program_version";

pub(super) fn read(row: &SqlRow<'_>) -> Result<Row> {
    Ok(Row {
        id: JobId(row.get(0)?),
        path: path(row, 1)?,
        relative: path(row, 2)?,
        stamp: row.get(3)?,
        content: row.get(4)?,
        settings: row.get(5)?,
        state: row.get(6)?,
        attempts: row.get(7)?,
        queued_at: at(row.get(8)?),
        started_at: row.get::<_, Option<i64>>(9)?.map(at),
        ended_at: row.get::<_, Option<i64>>(10)?.map(at),
        stage: row.get(11)?,
        message: row.get(12)?,
        hint: row.get(13)?,
        result: row.get::<_, Option<Vec<u8>>>(14)?.map(path_of),
        source: row.get::<_, Option<Vec<u8>>>(15)?.map(path_of),
        same_as: row.get::<_, Option<i64>>(16)?.map(JobId),
        program_version: row.get(17)?,
    })
}

pub(super) fn path(row: &SqlRow<'_>, column: usize) -> Result<PathBuf> {
    row.get(column).map(path_of)
}

fn path_of(bytes: Vec<u8>) -> PathBuf {
    OsString::from_vec(bytes).into()
}

pub(super) fn at(milliseconds: i64) -> SystemTime {
    UNIX_EPOCH + Duration::from_millis(milliseconds.max(0) as u64)
}
