//! What became of every file: one row a job, on disk, across restarts and crashes.
//!
//! A job is one file at one path in one state of its bytes. Its row is `pending` from when the file held
//! still, `running` while it is worked on, then `done`, `quarantined`, or `gone` if the file went away or was
//! replaced before that. A row says `done` only after the results are on disk, and that is written before anything
//! happens to the source: whatever a crash comes between is done again and comes to the same.
//!
//! What is cut is known by its bytes and the settings, never by its name: [`Reader::known`] finds what need not
//! be cut again. The daemon has the only connection that works on jobs; [`requeue`] is the one change that
//! comes from outside, and [`Ledger::changed_elsewhere`] notices it.

mod error;
mod lookup;
mod requeue;
mod row;
mod take_in;
#[cfg(test)]
mod tests;

use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use rusqlite::{Connection, OpenFlags, params};

pub use error::LedgerError;
pub use lookup::{Known, Reader};
pub use requeue::{RequeueError, requeue};
pub use row::{JobId, JobState, Row};
pub use take_in::{Arrival, TakenIn};

use crate::VERSION;

/// The name of the ledger in the state folder.
pub const FILE_NAME: &str = "ledger.sqlite";

const SCHEMA: &str = include_str!("ledger/schema.sql");
const SCHEMA_VERSION: i64 = 1;
/// A file on which the program was working, and on nothing else, when it came to its end this often, is not
/// begun again: once or twice may be bad luck.
pub const MOST_CRASHES: u32 = 3;
/// How long somebody else's writing is waited for.
const BUSY_FOR: Duration = Duration::from_secs(5);

/// Why a job gave no results, as it is remembered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Where: `read`, a stage of the pipeline, `write`.
    pub stage: String,
    /// What went wrong, in one line.
    pub message: String,
    /// What would be right.
    pub hint: String,
    /// Are the bytes at fault, so that the same bytes would fail again?
    pub of_content: bool,
}

/// The ledger, to be written.
pub struct Ledger {
    connection: Connection,
    seen_version: i64,
}

impl Ledger {
    /// Opens the ledger of a state folder, or makes a new one.
    ///
    /// # Errors
    ///
    /// [`LedgerError`]: the file cannot be opened, is no ledger, or is that of a newer program.
    pub fn open(state: &Path) -> Result<Self, LedgerError> {
        let path = state.join(FILE_NAME);
        let of_file = |error| LedgerError::at(&path, error);
        let connection = Connection::open(&path).map_err(of_file)?;
        prepare(&connection, &path)?;
        let mut ledger = Self {
            connection,
            seen_version: 0,
        };
        ledger.changed_elsewhere()?;
        Ok(ledger)
    }

    /// Changes when anybody writes to the ledger.
    pub fn version(&self) -> Result<(i64, u64), LedgerError> {
        Ok((self.version_elsewhere()?, self.connection.total_changes()))
    }

    fn version_elsewhere(&self) -> Result<i64, LedgerError> {
        let mut version = self.connection.prepare_cached("PRAGMA data_version")?;
        Ok(version.query_row([], |row| row.get(0))?)
    }

    /// Has another process written to the ledger since this was asked last?
    pub fn changed_elsewhere(&mut self) -> Result<bool, LedgerError> {
        let version = self.version_elsewhere()?;
        let changed = version != self.seen_version;
        self.seen_version = version;
        Ok(changed)
    }

    /// Sets right what a crash left: what was running is pending again, and suspected of having brought the
    /// program down, so that it is begun alone; of each path the last job only, the others are gone. What was alone [`MOST_CRASHES`] times when the program came to its
    /// end goes into quarantine. To be called once, by whoever has the state folder to itself. Gives how many
    /// there were of each.
    pub fn recover(&mut self) -> Result<(usize, usize), LedgerError> {
        let transaction = self.connection.transaction()?;
        transaction.execute(
            "UPDATE jobs SET suspect = 1, \
             crashes = crashes + (SELECT count(*) = 1 FROM jobs WHERE state = 'running') \
             WHERE state = 'running'",
            [],
        )?;
        let given_up = transaction.execute(
            "UPDATE jobs SET state = 'quarantined', ended_at = ?1, stage = 'run', \
             message = 'the program came to its end ' || crashes || ' times while it worked on this file alone', \
             hint = 'try the file by itself with `seamline segment`; if that ends the same way, please report it' \
             WHERE state = 'running' AND crashes >= ?2",
            params![now_ms(), MOST_CRASHES],
        )?;
        let again = transaction.execute(
            "UPDATE jobs SET state = 'pending' WHERE state = 'running'",
            [],
        )?;
        transaction.execute(
            "UPDATE jobs AS job SET state = 'gone', ended_at = ?1 WHERE state = 'pending' \
             AND EXISTS (SELECT 1 FROM jobs WHERE path = job.path AND id > job.id)",
            [now_ms()],
        )?;
        transaction.commit()?;
        Ok((again, given_up))
    }

    /// The job is begun. Gives how often it has been.
    pub fn begin(&mut self, id: JobId, settings: &str) -> Result<u32, LedgerError> {
        Ok(self.connection.query_row(
            "UPDATE jobs SET state = 'running', attempts = attempts + 1, started_at = ?2, settings = ?3, \
             program_version = ?4 WHERE id = ?1 RETURNING attempts",
            params![id.0, now_ms(), settings, VERSION],
            |row| row.get(0),
        )?)
    }

    /// The job was begun and not worked on: it waits again, and that does not count as an attempt. False if other
    /// content has come under the same name meanwhile, which has a job of its own: then this one is gone.
    pub fn put_back(&mut self, id: JobId) -> Result<bool, LedgerError> {
        self.wait_again(id, false)
    }

    fn wait_again(&self, id: JobId, counts: bool) -> Result<bool, LedgerError> {
        let followed = "SELECT 1 FROM jobs AS job JOIN jobs AS later ON later.path = job.path \
                        AND later.id > job.id WHERE job.id = ?1";
        let followed = self.connection.prepare_cached(followed)?.exists([id.0])?;
        let state = if followed {
            JobState::Gone
        } else {
            JobState::Pending
        };
        self.connection.execute(
            "UPDATE jobs SET state = ?2, attempts = max(attempts - ?3, 0), ended_at = ?4 WHERE id = ?1",
            params![
                id.0,
                state.word(),
                u32::from(!counts),
                followed.then(now_ms)
            ],
        )?;
        Ok(!followed)
    }

    /// As [`Ledger::put_back`], unless the job has ended and only its file is still to be dealt with.
    pub fn put_back_unless_ended(&mut self, id: JobId) -> Result<(), LedgerError> {
        let running = "SELECT 1 FROM jobs WHERE id = ?1 AND state = 'running'";
        if self.connection.prepare_cached(running)?.exists([id.0])? {
            self.put_back(id)?;
        }
        Ok(())
    }

    /// The job failed and is to be tried again. `counts`: as an attempt. False as for [`Ledger::put_back`].
    pub fn postpone(
        &mut self,
        id: JobId,
        fault: &Fault,
        counts: bool,
    ) -> Result<bool, LedgerError> {
        let transaction = self.connection.unchecked_transaction()?;
        self.set_fault(id, fault, None)?;
        let waits = self.wait_again(id, counts)?;
        transaction.commit()?;
        Ok(waits)
    }

    /// The job failed for good. To be called before the file is moved.
    pub fn quarantine(
        &mut self,
        id: JobId,
        content: Option<&str>,
        fault: &Fault,
    ) -> Result<(), LedgerError> {
        let transaction = self.connection.unchecked_transaction()?;
        self.set_fault(id, fault, content)?;
        self.connection.execute(
            "UPDATE jobs SET state = 'quarantined', ended_at = ?2 WHERE id = ?1",
            params![id.0, now_ms()],
        )?;
        Ok(transaction.commit()?)
    }

    fn set_fault(
        &self,
        id: JobId,
        fault: &Fault,
        content: Option<&str>,
    ) -> Result<(), LedgerError> {
        self.connection.execute(
            "UPDATE jobs SET stage = ?2, message = ?3, hint = ?4, of_content = ?5, \
             content = coalesce(?6, content) WHERE id = ?1",
            params![
                id.0,
                fault.stage,
                fault.message,
                fault.hint,
                fault.of_content,
                content
            ],
        )?;
        Ok(())
    }

    /// The results of the job are on disk in `result`. What other job had its results there has them no
    /// more; gives the files of the same bytes as such jobs, whose results are thereby lost.
    pub fn done(
        &mut self,
        id: JobId,
        content: &str,
        result: &Path,
    ) -> Result<Vec<PathBuf>, LedgerError> {
        let result = result.as_os_str().as_bytes();
        let transaction = self.connection.transaction()?;
        let stranded = {
            let mut stranded = transaction.prepare_cached(
                "SELECT copy.path FROM jobs AS copy JOIN jobs AS holder ON copy.same_as = holder.id \
                 WHERE holder.result = ?1 AND holder.id <> ?2 AND copy.state = 'done' AND copy.source IS NULL",
            )?;
            let paths = stranded.query_map(params![result, id.0], |row| row::path(row, 0))?;
            paths.collect::<Result<_, _>>()?
        };
        transaction.execute(
            "UPDATE jobs SET result = NULL WHERE result = ?1 AND id <> ?2",
            params![result, id.0],
        )?;
        transaction.execute(
            "UPDATE jobs SET state = 'done', ended_at = ?2, content = ?3, result = ?4, same_as = NULL, \
             stage = NULL, message = NULL, hint = NULL, of_content = 0 WHERE id = ?1",
            params![id.0, now_ms(), content, result],
        )?;
        transaction.commit()?;
        Ok(stranded)
    }

    /// The bytes of the job were cut before, by `holder`, which has the results. If that was at the same path,
    /// they are this job's from now on. False, and nothing is changed, if `holder` has lost its results meanwhile.
    pub fn same_content(
        &mut self,
        id: JobId,
        content: &str,
        holder: JobId,
    ) -> Result<bool, LedgerError> {
        let transaction = self.connection.transaction()?;
        let held = "SELECT 1 FROM jobs WHERE id = ?1 AND result IS NOT NULL";
        if !transaction.prepare_cached(held)?.exists([holder.0])? {
            return Ok(false);
        }
        transaction.execute(
            "UPDATE jobs SET state = 'done', ended_at = ?2, content = ?3, same_as = ?4, stage = NULL, \
             message = NULL, hint = NULL, of_content = 0 WHERE id = ?1",
            params![id.0, now_ms(), content, holder.0],
        )?;
        let same_path =
            "SELECT 1 FROM jobs AS a, jobs AS b WHERE a.id = ?1 AND b.id = ?2 AND a.path = b.path";
        if transaction
            .prepare_cached(same_path)?
            .exists([id.0, holder.0])?
        {
            transaction.execute(
                "UPDATE jobs SET result = (SELECT result FROM jobs WHERE id = ?2), same_as = NULL WHERE id = ?1",
                [id.0, holder.0],
            )?;
            transaction.execute(
                "UPDATE jobs SET same_as = ?1 WHERE same_as = ?2",
                [id.0, holder.0],
            )?;
            transaction.execute("UPDATE jobs SET result = NULL WHERE id = ?1", [holder.0])?;
        }
        transaction.commit()?;
        Ok(true)
    }

    /// The file went away before it was read.
    pub fn gone(&mut self, id: JobId) -> Result<(), LedgerError> {
        self.connection.execute(
            "UPDATE jobs SET state = 'gone', ended_at = ?2 WHERE id = ?1",
            params![id.0, now_ms()],
        )?;
        Ok(())
    }

    /// The source of a job that has ended was put elsewhere, or deleted (an empty path).
    pub fn settled(&mut self, id: JobId, source: &Path) -> Result<(), LedgerError> {
        self.connection.execute(
            "UPDATE jobs SET source = ?2 WHERE id = ?1",
            params![id.0, source.as_os_str().as_bytes()],
        )?;
        Ok(())
    }

    /// How many jobs there are in each state.
    pub fn counts(&self) -> Result<Vec<(JobState, u64)>, LedgerError> {
        lookup::counts(&self.connection)
    }

    /// Every pending job: its number and its path.
    pub fn pending(&self) -> Result<Vec<(JobId, PathBuf)>, LedgerError> {
        let mut pending = self
            .connection
            .prepare_cached("SELECT id, path FROM jobs WHERE state = 'pending' ORDER BY id")?;
        let rows = pending.query_map([], |row| Ok((JobId(row.get(0)?), row::path(row, 1)?)))?;
        Ok(rows.collect::<Result<_, _>>()?)
    }

    /// When the pending job that has waited longest was queued, of those on files that are `watched`. Those of a
    /// folder that is watched no longer wait until it is again, or for ever.
    pub fn oldest_pending(
        &self,
        watched: impl Fn(&Path) -> bool,
    ) -> Result<Option<SystemTime>, LedgerError> {
        let mut pending = self.connection.prepare_cached(
            "SELECT path, queued_at FROM jobs WHERE state = 'pending' ORDER BY queued_at",
        )?;
        let mut rows = pending.query([])?;
        while let Some(row) = rows.next()? {
            if watched(&row::path(row, 0)?) {
                return Ok(Some(row::at(row.get(1)?)));
            }
        }
        Ok(None)
    }
}

fn prepare(connection: &Connection, path: &Path) -> Result<(), LedgerError> {
    let of_file = |error| LedgerError::at(path, error);
    connection.busy_timeout(BUSY_FOR).map_err(of_file)?;
    connection
        .pragma_update_and_check(None, "journal_mode", "wal", |_| Ok(()))
        .map_err(of_file)?;
    // A power cut may undo the last commits, never half of one; the jobs are then done again.
    connection
        .pragma_update(None, "synchronous", "normal")
        .map_err(of_file)?;
    if is_made(connection, path)? {
        return Ok(());
    }
    connection
        .execute_batch(&format!("BEGIN IMMEDIATE; {SCHEMA} COMMIT;"))
        .map_err(of_file)
}

/// Has the ledger its tables, in the form that is known here?
fn is_made(connection: &Connection, path: &Path) -> Result<bool, LedgerError> {
    let version = connection.query_row("PRAGMA user_version", [], |row| row.get(0));
    match version.map_err(|error| LedgerError::at(path, error))? {
        0 => Ok(false),
        SCHEMA_VERSION => Ok(true),
        found => Err(LedgerError::Version {
            path: path.to_owned(),
            found,
        }),
    }
}

/// Opens a ledger that is there already.
fn open_existing(state: &Path, flags: OpenFlags) -> Result<Connection, LedgerError> {
    let path = state.join(FILE_NAME);
    if !path.exists() {
        return Err(LedgerError::None { path });
    }
    let flags = flags | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection =
        Connection::open_with_flags(&path, flags).map_err(|error| LedgerError::at(&path, error))?;
    connection.busy_timeout(BUSY_FOR)?;
    if is_made(&connection, &path)? {
        Ok(connection)
    } else {
        Err(LedgerError::None { path })
    }
}

fn now_ms() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |since| since.as_millis() as i64)
}
