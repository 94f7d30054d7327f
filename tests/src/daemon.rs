//! The watch folder from outside: the real program on real folders.
//!
//! A [`Home`] is a folder with an inbox and a configuration, a [`Daemon`] the program at work on it. What it
//! has done is asked of it as a user would ask: by its results, its log, its ledger ([`Status`]) and its
//! metrics.

mod faults;
mod home;
mod http;
mod meshes;
mod process;
mod results;
mod status;

pub use faults::{FailingDisk, skipped};
pub use home::Home;
pub use http::{Metrics, get};
pub use meshes::{cuboid, cuboids, stl, torus};
pub use process::{Daemon, LIMIT, Signal, behind, wait_within, works};
pub use results::{Results, leftovers, without_seconds};
pub use status::{Job, Status};

/// How the daemon is to notice changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// By events of the system.
    Native,
    /// By listing folders.
    Poll,
}

impl Mode {
    /// Its lines of the `[[watch]]` table.
    pub fn lines(self) -> &'static str {
        match self {
            Self::Native => "watcher = \"native\"\n",
            Self::Poll => "watcher = \"poll\"\npoll_ms = 100\n",
        }
    }
}

/// Runs each body, a `fn(Mode)`, as one test in the module `native` and one in the module `poll`.
#[macro_export]
macro_rules! in_both_modes {
    ($($body:ident),* $(,)?) => {
        mod native {
            $(#[test] fn $body() { super::$body($crate::daemon::Mode::Native); })*
        }
        mod poll {
            $(#[test] fn $body() { super::$body($crate::daemon::Mode::Poll); })*
        }
    };
}
