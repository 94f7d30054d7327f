//! Why markings could not be read, or do not fit their mesh.

use crate::{Place, ReadError};

/// Why markings were refused. `Display` is one line without the name of the file.
#[derive(Debug, thiserror::Error)]
pub enum MarkingsError {
    /// The file they are in cannot be read as what it is.
    #[error("{0}")]
    Read(#[from] ReadError),
    /// Something in one place.
    #[error("{place}: {reason}")]
    At {
        /// Where.
        place: Place,
        /// What is there.
        reason: String,
        /// What would fit.
        hint: String,
    },
    /// Something of the file as a whole.
    #[error("{reason}")]
    Whole {
        /// What it is.
        reason: String,
        /// What would fit.
        hint: String,
    },
}

impl MarkingsError {
    pub(super) fn at(place: Place, reason: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::At {
            place,
            reason: reason.into(),
            hint: hint.into(),
        }
    }

    pub(super) fn whole(reason: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Whole {
            reason: reason.into(),
            hint: hint.into(),
        }
    }

    /// What to do about it: one sentence.
    pub fn hint(&self) -> &str {
        match self {
            Self::Read(error) => error.hint(),
            Self::At { hint, .. } | Self::Whole { hint, .. } => hint,
        }
    }

    /// Whether the file is shorter than it says it is, so that it may be a copy still under way.
    pub fn is_truncated(&self) -> bool {
        matches!(self, Self::Read(error) if error.is_truncated())
    }
}
