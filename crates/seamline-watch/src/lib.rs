//! A folder that meshes are dropped into, and the results that come out of it.
//!
//! Data flows one way: [`events`] hint that something changed, [`scan()`] lists what is there, [`tracker`]
//! says which file has been written to its end, [`mod@load`] reads it, a worker of [`seamline_ecs`] cuts it,
//! [`outputs`] writes its results whole or not at all, and [`quarantine`] takes what cannot be cut.
//! [`daemon`] runs all this on threads with bounded channels between them; [`config`] says where. What is
//! done to the mesh on its way is none of this crate's business.

pub mod config;
pub mod daemon;
pub mod events;
mod fitted;
pub mod health;
pub mod http;
pub mod include;
pub mod ledger;
pub mod load;
pub mod lock;
pub mod memory;
pub mod metrics;
pub mod mounts;
pub mod outputs;
pub mod pairs;
pub mod quarantine;
pub mod relocate;
pub mod retry;
pub mod scan;
pub mod service;
mod setup;
mod shown;
pub mod tracker;

pub use config::{Config, ConfigError, ConfigFile};
pub use daemon::{Order, Reload, RunOptions, Summary, WatchError, run};
pub use load::{LoadError, LoadedMarkings, LoadedMesh, load, load_markings, weld_share};
pub use outputs::{JobFacts, OutputError, WriteSet, report, write_results};
pub use setup::Setup;
pub use shown::shown;

/// The version of the program, as reports name it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

#[cfg(test)]
mod test_support;
