//! What is wrong with a configuration: file, line, key, and what would be right.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use seamline_ecs::settings::SettingsError;

/// What is wrong with a configuration.
///
/// `Display` is one line: `demo.toml:7: watch.stable_for_sm: unknown key ...; did you mean ...?`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct ConfigError {
    /// The configuration file.
    pub file: PathBuf,
    /// The line, from 1, where it is known.
    pub line: Option<usize>,
    /// The dotted key; empty where the file as a whole is meant.
    pub key: String,
    /// What is wrong.
    pub reason: String,
    /// What would be right.
    pub hint: String,
}

impl ConfigError {
    pub(super) fn unreadable(file: &Path, error: &io::Error) -> Self {
        Self {
            file: file.to_owned(),
            line: None,
            key: String::new(),
            reason: format!("cannot be read: {error}"),
            hint: "name a TOML file, as `watch-config/demo.toml` is one".to_owned(),
        }
    }

    pub(super) fn syntax(file: &Path, text: &str, error: &toml::de::Error) -> Self {
        let line = error
            .span()
            .map(|span| super::line::line_at(text, span.start));
        Self {
            file: file.to_owned(),
            line,
            key: String::new(),
            reason: error
                .message()
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" "),
            hint: "the file must be TOML (https://toml.io)".to_owned(),
        }
    }

    pub(super) fn at(file: &Path, text: &str, error: SettingsError) -> Self {
        let line = super::line::line_of_key(text, &error.key);
        Self {
            file: file.to_owned(),
            line,
            key: without_numbers(&error.key),
            reason: error.reason,
            hint: error.hint,
        }
    }
}

/// The line tells which element of an array is meant; a person does not write its number.
fn without_numbers(key: &str) -> String {
    let parts = key.split('.').filter(|part| part.parse::<usize>().is_err());
    parts.collect::<Vec<_>>().join(".")
}

impl fmt::Display for ConfigError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if !self.key.is_empty() {
            write!(f, ": {}", self.key)?;
        }
        write!(f, ": {}; {}", self.reason, self.hint)
    }
}
