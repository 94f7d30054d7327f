//! The tables of the configuration that belong to the watch folder, with their defaults and ranges.

mod places;
mod rules;
mod said;
mod watched;
mod work;

pub use places::{DoneTable, OutputTable, QuarantineTable, StateTable};
pub use rules::RuleTable;
pub use said::{HttpTable, LogFormat, LogLevel, LogTable};
pub use watched::{After, WatchTable, Watcher};
pub use work::{DaemonTable, LimitsTable, RetryTable};
