//! What the daemon tells of itself: `[http]`, `[log]`.

use std::net::SocketAddr;

use schemars::JsonSchema;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use serde::{Deserialize, Serialize};

/// `[http]`: health and metrics.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HttpTable {
    /// Address and port of `/health`, `/ready` and `/metrics`, as in `127.0.0.1:9464`; empty: none. There is
    /// no password: keep it on loopback, or behind a wall.
    pub listen: String,
}

impl StepSettings for HttpTable {
    const TABLE: &'static str = "http";

    fn defaults(_: Profile) -> Self {
        Self {
            listen: String::new(),
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let holds = self.listen.is_empty() || self.listen.parse::<SocketAddr>().is_ok();
        OutOfRange::unless(
            holds,
            "listen",
            "address and port, as in `127.0.0.1:9464`, or \"\"",
        )
    }
}

/// How log lines are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LogFormat {
    /// For people.
    Text,
    /// One JSON object a line.
    Json,
}

/// Which log lines are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LogLevel {
    /// What ends the daemon or loses a result.
    Error,
    /// What somebody should look at, too.
    Warn,
    /// What became of each file, too.
    Info,
    /// What is done for it, too.
    Debug,
}

/// `[log]`: what is said on standard error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogTable {
    /// For people or for programs.
    pub format: LogFormat,
    /// How much; `-q` and `-v` on the command line beat it.
    pub level: LogLevel,
}

impl StepSettings for LogTable {
    const TABLE: &'static str = "log";

    fn defaults(_: Profile) -> Self {
        Self {
            format: LogFormat::Text,
            level: LogLevel::Info,
        }
    }
}
