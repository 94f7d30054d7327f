//! Why the ledger cannot be read or written.

use std::path::{Path, PathBuf};

use rusqlite::ErrorCode;

/// Why the ledger cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum LedgerError {
    /// The database refused.
    #[error("the ledger{} cannot be used: {error}", of(.path))]
    Database {
        /// The file, where it matters.
        path: Option<PathBuf>,
        /// What the database says.
        error: rusqlite::Error,
    },
    /// There is none.
    #[error("there is no ledger at {}", .path.display())]
    None {
        /// Where it would be.
        path: PathBuf,
    },
    /// A newer program has made it.
    #[error("the ledger {} has form {found}, which this version does not know", .path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// The number of its form.
        found: i64,
    },
}

fn of(path: &Option<PathBuf>) -> String {
    path.as_ref()
        .map_or_else(String::new, |path| format!(" {}", path.display()))
}

impl LedgerError {
    pub(super) fn at(path: &Path, error: rusqlite::Error) -> Self {
        Self::Database {
            path: Some(path.to_owned()),
            error,
        }
    }

    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Database { .. } if self.may_pass() => {
                "check that the disk of `state.dir` has room and may be written"
            }
            Self::Database { .. } => {
                "`state.dir` must be a folder on a local disk; if its ledger.sqlite is damaged, move it away: \
                 what lies in the watched folders is then cut anew"
            }
            Self::None { .. } => "start `seamline watch` with this configuration first",
            Self::Version { .. } => "use the version of the program that made it, or a later one",
        }
    }

    /// Is it something that may pass by itself: a full disk, a lock, a failing disk?
    pub fn may_pass(&self) -> bool {
        let Self::Database { error, .. } = self else {
            return false;
        };
        matches!(
            error.sqlite_error_code(),
            Some(
                ErrorCode::DatabaseBusy
                    | ErrorCode::DatabaseLocked
                    | ErrorCode::DiskFull
                    | ErrorCode::SystemIoFailure
                    | ErrorCode::ReadOnly
                    | ErrorCode::CannotOpen
            )
        )
    }
}

impl From<rusqlite::Error> for LedgerError {
    fn from(error: rusqlite::Error) -> Self {
        Self::Database { path: None, error }
    }
}
