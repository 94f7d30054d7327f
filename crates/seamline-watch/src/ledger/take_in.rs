//! A file that has held still is entered, or recognised as one that was dealt with.

use std::os::unix::ffi::OsStrExt;
use std::path::Path;

use rusqlite::{Connection, OptionalExtension, Transaction, params};

use super::row::{self, COLUMNS};
use super::{JobId, JobState, Ledger, LedgerError, Reader, Row, now_ms};

/// A file that has held still.
#[derive(Clone, Copy, Debug)]
pub struct Arrival<'a> {
    /// The file, absolute.
    pub path: &'a Path,
    /// The file below its watched folder.
    pub relative: &'a Path,
    /// What another tool has marked on it, if that is half of the work. What waits as a job of its own under this path does
    /// not any more.
    pub markings: Option<&'a Path>,
    /// [`crate::tracker::Stamp::word`] of the state in which it did.
    pub stamp: &'a str,
}

/// What is to be done about a file that has held still.
#[derive(Clone, Debug, PartialEq)]
pub enum TakenIn {
    /// It is to be cut.
    Queue {
        /// Its row.
        id: JobId,
        /// Above 0 it may have brought the program down before, the higher the likelier: nothing else is to run
        /// beside it.
        suspicion: u32,
    },
    /// In this state it is being worked on.
    Running,
    /// Its results are there; what is to become of the source may have been cut short by a crash.
    Done(JobId),
    /// It failed for good; it may be that it could not be moved.
    Quarantined(Box<Row>),
}

impl TakenIn {
    /// Of a job that is to be cut: how likely it is to bring the program down. 0 for all others.
    pub fn suspicion(&self) -> u32 {
        match self {
            Self::Queue { suspicion, .. } => *suspicion,
            _ => 0,
        }
    }
}

impl Ledger {
    /// Enters files that have held still, all or none; what they are to be cut with has the hash `settings`.
    pub fn take_in(
        &mut self,
        arrivals: &[Arrival<'_>],
        settings: &str,
    ) -> Result<Vec<TakenIn>, LedgerError> {
        let transaction = self.connection.transaction()?;
        let taken = arrivals
            .iter()
            .map(|arrival| one(&transaction, arrival, settings))
            .collect::<Result<_, _>>()?;
        transaction.commit()?;
        Ok(taken)
    }
}

impl Reader {
    /// Has the job on the file in this state ended, done or not, under these settings?
    pub fn has_ended(&self, path: &Path, stamp: &str, settings: &str) -> Result<bool, LedgerError> {
        let last = last_job(&self.connection, path, stamp, settings)?;
        Ok(matches!(last, Last::Done(_) | Last::Quarantined(_)))
    }
}

fn one(
    transaction: &Transaction<'_>,
    arrival: &Arrival<'_>,
    settings: &str,
) -> Result<TakenIn, LedgerError> {
    let Arrival {
        path,
        stamp,
        markings,
        ..
    } = *arrival;
    if let Some(markings) = markings {
        transaction.execute(
            "UPDATE jobs SET state = 'gone', ended_at = ?2 WHERE path = ?1 AND state = 'pending'",
            params![markings.as_os_str().as_bytes(), now_ms()],
        )?;
    }
    Ok(match last_job(transaction, path, stamp, settings)? {
        Last::OfOtherWork => return new(transaction, arrival),
        Last::Pending(row) => {
            if row.stamp != stamp {
                transaction.execute(
                    "UPDATE jobs SET stamp = ?2, content = NULL, attempts = 0, crashes = 0, suspect = 0 WHERE id = ?1",
                    params![row.id.0, stamp],
                )?;
            }
            TakenIn::Queue {
                id: row.id,
                suspicion: suspicion(transaction, row.id)?,
            }
        }
        Last::Running => TakenIn::Running,
        Last::Done(id) => TakenIn::Done(id),
        Last::Quarantined(row) => TakenIn::Quarantined(Box::new(row)),
    })
}

/// The last job of a path, as seen by who has a file there.
enum Last {
    /// None, or one on other content or under other settings, or whose results are gone.
    OfOtherWork,
    /// It waits; what it waits with is the latest content.
    Pending(Row),
    Running,
    Done(JobId),
    Quarantined(Row),
}

fn last_job(
    connection: &Connection,
    path: &Path,
    stamp: &str,
    settings: &str,
) -> Result<Last, LedgerError> {
    let last = format!("SELECT {COLUMNS} FROM jobs WHERE path = ?1 ORDER BY id DESC LIMIT 1");
    let last = connection
        .prepare_cached(&last)?
        .query_row([path.as_os_str().as_bytes()], row::read)
        .optional()?;
    let Some(last) = last else {
        return Ok(Last::OfOtherWork);
    };
    let same_file = last.stamp == stamp;
    let same_work = same_file && last.settings.as_deref() == Some(settings);
    Ok(match last.state {
        JobState::Pending => Last::Pending(last),
        JobState::Running if same_file => Last::Running,
        JobState::Done if same_work && has_results(connection, &last)? => Last::Done(last.id),
        JobState::Quarantined if same_work => Last::Quarantined(last),
        _ => Last::OfOtherWork,
    })
}

/// Does the job, or the one that has its results, have them still?
fn has_results(connection: &Connection, row: &Row) -> Result<bool, LedgerError> {
    let Some(holder) = row.same_as else {
        return Ok(row.result.is_some());
    };
    let mut held =
        connection.prepare_cached("SELECT 1 FROM jobs WHERE id = ?1 AND result IS NOT NULL")?;
    Ok(held.exists([holder.0])?)
}

fn suspicion(transaction: &Transaction<'_>, id: JobId) -> Result<u32, LedgerError> {
    let mut of = transaction.prepare_cached("SELECT suspect + crashes FROM jobs WHERE id = ?1")?;
    Ok(of.query_row([id.0], |row| row.get(0))?)
}

fn new(transaction: &Transaction<'_>, arrival: &Arrival<'_>) -> Result<TakenIn, LedgerError> {
    let mut insert = transaction.prepare_cached(
        "INSERT INTO jobs (path, relative, stamp, state, queued_at) VALUES (?1, ?2, ?3, 'pending', ?4)",
    )?;
    let id = insert.insert(params![
        arrival.path.as_os_str().as_bytes(),
        arrival.relative.as_os_str().as_bytes(),
        arrival.stamp,
        now_ms()
    ])?;
    Ok(TakenIn::Queue {
        id: JobId(id),
        suspicion: 0,
    })
}
