//! What a program may do wrong.

use seamline_ecs::StepError;
use thiserror::Error;

/// Why a program gave no answer that can be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Fault {
    /// There is no such program, or it may not be run.
    #[error("cannot be started: {0}")]
    NotStarted(String),
    /// It ended, or closed its output, before its answer was whole.
    #[error("{how} before it had answered{last_words}")]
    Ended {
        /// `ended with exit status: 1`.
        how: String,
        /// The last line it said on standard error, with a lead; or nothing.
        last_words: String,
    },
    /// It took too long.
    #[error("gave no answer within {0} s")]
    Silent(f64),
    /// What it said is no Arrow IPC stream.
    #[error("answered with what is no Arrow IPC stream: {0}")]
    Garbage(String),
    /// It said more than any answer needs.
    #[error("answered with more than {0} bytes")]
    TooLong(usize),
    /// The columns are not those wanted.
    #[error("answered with {found}")]
    WrongColumns {
        /// What it answered with.
        found: String,
        /// The column that is wanted.
        wanted: &'static str,
    },
    /// A value that is no number of an element.
    #[error("answered with {value} in row {row}")]
    WrongValue {
        /// The value, as it was given.
        value: String,
        /// Its row, from 0.
        row: usize,
    },
}

impl Fault {
    /// As the reason of a failed job. `program` is what was started, as a person would type it.
    pub fn of(self, program: &str) -> StepError {
        let hint = match &self {
            Self::NotStarted(_) => {
                "name a program that is installed; `folder` says where it is started".to_owned()
            }
            Self::Ended { .. } => {
                "all it said on standard error is in the log; `segment -v` shows it".to_owned()
            }
            Self::Silent(_) => "it must flush its answer, and not wait for the end of its input; \
                                or raise `timeout_s`"
                .to_owned(),
            Self::Garbage(_) | Self::TooLong(_) => {
                "standard output is for one Arrow IPC stream a mesh \
                                                    and nothing else; print to standard error"
                    .to_owned()
            }
            Self::WrongColumns { wanted, .. } => {
                format!("wants one column `{wanted}` of whole numbers")
            }
            Self::WrongValue { .. } => "wants whole numbers from 0, none missing".to_owned(),
        };
        StepError::new(format!("`{program}` {self}"), hint)
    }
}
