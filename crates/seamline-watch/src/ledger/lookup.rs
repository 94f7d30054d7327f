//! The ledger, read beside the one who writes it.

use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use rusqlite::{Connection, OpenFlags, OptionalExtension, params};

use super::row::{self, COLUMNS};
use super::{Fault, JobId, JobState, LedgerError, Row, open_existing};

/// What is known of bytes that were met before under the same settings.
#[derive(Clone, Debug, PartialEq)]
pub enum Known {
    /// They were cut, and the results are there.
    Done {
        /// By this job.
        holder: JobId,
        /// Of this file.
        path: PathBuf,
        /// The folder of the results, unless somebody has taken it away.
        result: PathBuf,
    },
    /// They are at fault.
    Bad(Fault),
}

/// A connection that only reads.
pub struct Reader {
    pub(super) connection: Connection,
}

impl Reader {
    /// Opens the ledger of a state folder.
    ///
    /// # Errors
    ///
    /// [`LedgerError`], if there is none as well.
    pub fn open(state: &Path) -> Result<Self, LedgerError> {
        let connection = open_existing(state, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
        connection.pragma_update(None, "query_only", true)?;
        Ok(Self { connection })
    }

    /// What is known of bytes by their hash, under settings by theirs; nothing if they are to be cut. Where more
    /// than one file had them, that at `path` is told first.
    pub fn known(
        &self,
        content: &str,
        settings: &str,
        path: &Path,
    ) -> Result<Option<Known>, LedgerError> {
        let mut known = self.connection.prepare_cached(
            "SELECT state, id, path, result, stage, message, hint FROM jobs \
             WHERE content = ?1 AND settings = ?2 AND (state = 'done' AND result IS NOT NULL \
             OR state = 'quarantined' AND of_content) ORDER BY state, path <> ?3, id LIMIT 1",
        )?;
        let found = known.query_row(
            params![content, settings, path.as_os_str().as_bytes()],
            |row| {
                Ok(match row.get(0)? {
                    JobState::Done => Known::Done {
                        holder: JobId(row.get(1)?),
                        path: row::path(row, 2)?,
                        result: row::path(row, 3)?,
                    },
                    _ => Known::Bad(Fault {
                        stage: row.get(4)?,
                        message: row.get(5)?,
                        hint: row.get(6)?,
                        of_content: true,
                    }),
                })
            },
        );
        Ok(found.optional()?)
    }

    /// The file whose results are in this folder, if any are.
    pub fn owner_of(&self, result: &Path) -> Result<Option<PathBuf>, LedgerError> {
        let mut owner = self
            .connection
            .prepare_cached("SELECT path FROM jobs WHERE result = ?1")?;
        let found = owner.query_row([result.as_os_str().as_bytes()], |row| row::path(row, 0));
        Ok(found.optional()?)
    }

    /// All jobs, by number.
    pub fn rows(&self) -> Result<Vec<Row>, LedgerError> {
        let all = format!("SELECT {COLUMNS} FROM jobs ORDER BY id");
        let mut all = self.connection.prepare(&all)?;
        let rows = all.query_map([], row::read)?;
        Ok(rows.collect::<Result<_, _>>()?)
    }

    /// How many jobs there are in each state.
    pub fn counts(&self) -> Result<Vec<(JobState, u64)>, LedgerError> {
        counts(&self.connection)
    }
}

pub(super) fn counts(connection: &Connection) -> Result<Vec<(JobState, u64)>, LedgerError> {
    let mut count = connection.prepare_cached("SELECT count(*) FROM jobs WHERE state = ?1")?;
    let mut of = |state: JobState| count.query_row([state.word()], |row| row.get::<_, i64>(0));
    let counted = JobState::ALL.map(|state| Ok((state, of(state)?.max(0) as u64)));
    counted.into_iter().collect()
}
