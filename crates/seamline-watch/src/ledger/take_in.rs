//! A file that has held still is entered, or recognised as one that was dealt with.

use std::os::unix::ffi::OsStrExt;
use std::path::Path;

use rusqlite::{OptionalExtension, Transaction, params};

use super::row::{self, COLUMNS};
use super::{JobId, JobState, Ledger, LedgerError, Row, now_ms};

/// A file that has held still.
#[derive(Clone, Copy, Debug)]
pub struct Arrival<'a> {
    /// The file, absolute.
    pub path: &'a Path,
    /// The file below its watched folder.
    pub relative: &'a Path,
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

fn one(
    transaction: &Transaction<'_>,
    arrival: &Arrival<'_>,
    settings: &str,
) -> Result<TakenIn, LedgerError> {
    let path = arrival.path.as_os_str().as_bytes();
    let last = format!("SELECT {COLUMNS} FROM jobs WHERE path = ?1 ORDER BY id DESC LIMIT 1");
    let last = transaction
        .prepare_cached(&last)?
        .query_row([path], row::read)
        .optional()?;
    let Some(last) = last else {
        return new(transaction, arrival);
    };
    let same_file = last.stamp == arrival.stamp;
    let same_work = same_file && last.settings.as_deref() == Some(settings);
    Ok(match last.state {
        JobState::Pending => {
            if !same_file {
                transaction.execute(
                    "UPDATE jobs SET stamp = ?2, content = NULL, attempts = 0, crashes = 0, suspect = 0 WHERE id = ?1",
                    params![last.id.0, arrival.stamp],
                )?;
            }
            TakenIn::Queue {
                id: last.id,
                suspicion: suspicion(transaction, last.id)?,
            }
        }
        JobState::Running if same_file => TakenIn::Running,
        JobState::Done if same_work && has_results(transaction, &last)? => TakenIn::Done(last.id),
        JobState::Quarantined if same_work => TakenIn::Quarantined(Box::new(last)),
        _ => return new(transaction, arrival),
    })
}

/// Does the job, or the one that has its results, have them still?
fn has_results(transaction: &Transaction<'_>, row: &Row) -> Result<bool, LedgerError> {
    let Some(holder) = row.same_as else {
        return Ok(row.result.is_some());
    };
    let mut held =
        transaction.prepare_cached("SELECT 1 FROM jobs WHERE id = ?1 AND result IS NOT NULL")?;
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
