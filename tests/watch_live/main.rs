//! The daemon as somebody runs it: started, watched over, changed, stopped.

mod config;
mod once;
mod results;
mod seen;
mod stop;

const METRICS: &str = "[http]\nlisten = \"127.0.0.1:0\"\n";
