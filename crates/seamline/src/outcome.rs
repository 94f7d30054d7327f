//! How a command ended, and the exit status that says so.

use std::fmt::Display;
use std::path::Path;
use std::process::ExitCode;

use seamline_ecs::settings::SettingsError;
use seamline_watch::{ConfigError, shown};

use crate::say::say;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All done.
    Done,
    /// Some input failed, each named with its reason; the others are done.
    SomeFailed,
    /// Wrong use or wrong configuration; nothing was done.
    WrongUse,
}

impl Outcome {
    /// Done unless something failed.
    pub fn of_failures(failures: usize) -> Self {
        if failures == 0 {
            Self::Done
        } else {
            Self::SomeFailed
        }
    }

    /// Says the error and tells wrong use from everything else.
    pub fn of_error(error: anyhow::Error) -> Self {
        say_error(&as_said(&error));
        let wrong_use =
            error.is::<SettingsError>() || error.is::<ConfigError>() || error.is::<WrongUse>();
        if wrong_use {
            Self::WrongUse
        } else {
            Self::SomeFailed
        }
    }

    /// 0, 1 or 2.
    pub fn exit_code(self) -> ExitCode {
        ExitCode::from(match self {
            Self::Done => 0,
            Self::SomeFailed => 1,
            Self::WrongUse => 2,
        })
    }
}

/// An error in one line, with what would be right.
pub fn as_said(error: &anyhow::Error) -> String {
    match error.downcast_ref::<SettingsError>() {
        Some(wrong) => format!("{wrong}; {}", wrong.hint),
        None => format!("{error:#}"),
    }
}

/// A command that cannot be meant.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct WrongUse(pub String);

/// One line on standard error.
pub fn say_error(line: &str) {
    say(&format_args!("error: {line}"));
}

/// One line for an input that failed: file, reason, what would be right.
pub fn say_failure(file: &Path, reason: &dyn Display, hint: &str) {
    say_error(&format!("{}: {reason}; {hint}", shown(file)));
}
