//! A job is to be done again: its file goes back to where it came from.

use std::fs;
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use rusqlite::{Connection, OpenFlags, OptionalExtension, params};

use super::row::{self, COLUMNS};
use super::{JobId, JobState, LedgerError, Row, now_ms, open_existing};
use crate::pairs::{beside, markings_in, markings_of};
use crate::quarantine::reason_beside;
use crate::relocate::move_aside;
use crate::tracker::Stamp;

/// Why a job cannot be done again.
#[derive(Debug, thiserror::Error)]
pub enum RequeueError {
    /// The ledger fails.
    #[error("{0}")]
    Ledger(#[from] LedgerError),
    /// There is no such job.
    #[error("there is no job {0}")]
    Unknown(i64),
    /// It waits or is worked on.
    #[error("job {id} is {state} already")]
    Under {
        /// Its number.
        id: i64,
        /// `pending` or `running`.
        state: &'static str,
    },
    /// Another file has come under the same name since.
    #[error("the file of job {id} was followed by another of the same name, in job {later}")]
    Followed {
        /// Its number.
        id: i64,
        /// The number of the last job of that name.
        later: i64,
    },
    /// Its file is not where it was put.
    #[error("the file of job {id} cannot be brought back from {}: {error}", .from.display())]
    File {
        /// Its number.
        id: i64,
        /// Where it should be.
        from: PathBuf,
        /// What the system says.
        error: io::Error,
    },
}

impl RequeueError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Ledger(error) => error.hint(),
            Self::Unknown(_) => "`seamline status` tells the numbers of all jobs",
            Self::Under { .. } => "wait for its end",
            Self::Followed { .. } => "drop it into the watched folder under another name",
            Self::File { .. } => "drop the file into the watched folder again",
        }
    }
}

/// Makes jobs pending again, and brings their files back to where they came from: out of quarantine (the
/// reason beside it is deleted) or out of the folder of done files; a mesh with its markings, unless others have been
/// dropped since. If another file has the name by
/// now, this one gets a number, as everywhere. Without `jobs`, those in quarantine. A running daemon takes
/// them up by itself; it may run meanwhile. Gives, for each job, where its file is now, or why not.
///
/// # Errors
///
/// The ledger cannot be read at all.
pub fn requeue(
    state: &Path,
    jobs: Option<&[JobId]>,
) -> Result<Vec<(JobId, Result<PathBuf, RequeueError>)>, LedgerError> {
    let connection = open_existing(state, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
    let jobs = match jobs {
        Some(jobs) => jobs.to_vec(),
        None => quarantined(&connection)?,
    };
    let mut rows: Vec<(JobId, Option<Row>)> = Vec::with_capacity(jobs.len());
    for id in jobs {
        rows.push((id, row_of(&connection, id)?));
    }
    // Markings that came after those of a mesh go before them.
    let are_markings = |row: &Option<Row>| {
        let path = row.as_ref().map(|row| &row.path);
        path.is_some_and(|path| markings_in(path).is_some())
    };
    rows.sort_by_key(|(_, row)| !are_markings(row));
    let rows = rows.into_iter();
    Ok(rows
        .map(|(id, row)| {
            let row = row.ok_or(RequeueError::Unknown(id.0));
            (id, row.and_then(|row| one(&connection, &row)))
        })
        .collect())
}

fn row_of(connection: &Connection, id: JobId) -> Result<Option<Row>, LedgerError> {
    let row = format!("SELECT {COLUMNS} FROM jobs WHERE id = ?1");
    Ok(connection.query_row(&row, [id.0], row::read).optional()?)
}

/// Of each path the last job, if it is in quarantine.
fn quarantined(connection: &Connection) -> Result<Vec<JobId>, LedgerError> {
    let mut all = connection.prepare(
        "SELECT id FROM jobs AS a WHERE state = 'quarantined' AND NOT EXISTS \
             (SELECT 1 FROM jobs AS b WHERE b.path = a.path AND b.id > a.id) ORDER BY id",
    )?;
    let ids = all.query_map([], |row| row.get(0).map(JobId))?;
    Ok(ids.collect::<Result<_, _>>()?)
}

fn one(connection: &Connection, row: &Row) -> Result<PathBuf, RequeueError> {
    let id = row.id;
    if let state @ (JobState::Pending | JobState::Running) = row.state {
        return Err(RequeueError::Under {
            id: id.0,
            state: state.word(),
        });
    }
    let later: Option<i64> = connection
        .query_row(
            "SELECT max(id) FROM jobs WHERE path = ?1 AND id > ?2",
            params![row.path.as_os_str().as_bytes(), id.0],
            |row| row.get(0),
        )
        .map_err(LedgerError::from)?;
    if let Some(later) = later {
        return Err(RequeueError::Followed { id: id.0, later });
    }
    let (path, stamp) = bring_back(row).map_err(|error| RequeueError::File {
        id: id.0,
        from: row.source.clone().unwrap_or_else(|| row.path.clone()),
        error,
    })?;
    enter(connection, row, &path, stamp).map_err(LedgerError::from)?;
    Ok(path)
}

fn enter(connection: &Connection, row: &Row, path: &Path, stamp: Stamp) -> rusqlite::Result<()> {
    let transaction = connection.unchecked_transaction()?;
    // Whoever asks for another try does not want to hear what is known already.
    transaction.execute(
        "UPDATE jobs SET of_content = 0 WHERE content = ?1",
        [&row.content],
    )?;
    transaction.execute(
        "UPDATE jobs SET state = 'pending', path = ?2, relative = ?3, stamp = ?4, attempts = 0, crashes = 0, suspect = 0, \
         source = NULL, result = NULL, same_as = NULL, stage = NULL, message = NULL, hint = NULL, \
         of_content = 0, content = NULL, ended_at = NULL, queued_at = ?5 WHERE id = ?1",
        params![
            row.id.0,
            path.as_os_str().as_bytes(),
            relative(row, path).as_os_str().as_bytes(),
            stamp.word(),
            now_ms()
        ],
    )?;
    transaction.commit()
}

fn bring_back(row: &Row) -> io::Result<(PathBuf, Stamp)> {
    let path = match &row.source {
        None => row.path.clone(),
        Some(source) if source.as_os_str().is_empty() => {
            return Err(io::Error::new(
                io::ErrorKind::NotFound,
                "it was deleted when it was done",
            ));
        }
        Some(source) => {
            let path = move_aside(source, &row.path)?;
            // What lies beside its place by now was dropped after it, and holds.
            let is_followed = markings_of(&path).iter().any(|newer| newer.is_file());
            for markings in markings_of(source) {
                if markings_in(source).is_none() && markings.is_file() && !is_followed {
                    move_aside(&markings, &beside(&path, &markings))?;
                }
            }
            if row.state == JobState::Quarantined {
                let _ = fs::remove_file(reason_beside(source));
            }
            path
        }
    };
    let stamp = Stamp::of(&fs::metadata(&path)?);
    Ok((path, stamp))
}

/// The path below the watched folder, whose last part may have got a number.
fn relative(row: &Row, path: &Path) -> PathBuf {
    row.relative
        .with_file_name(path.file_name().unwrap_or_default())
}
