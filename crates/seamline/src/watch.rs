//! `seamline watch`: watch folders and cut every mesh that is dropped there.

use std::io::{self, IsTerminal};
use std::sync::Arc;

use anyhow::{Context, Result};
use seamline_watch::{Config, ConfigFile, RunOptions, shown};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use tracing_subscriber::filter::LevelFilter;

use crate::args::{SaidArgs, WatchArgs};
use crate::outcome::Outcome;
use crate::say::print;
use crate::settings::{pipeline_of_file, pipeline_tables};

/// Runs the daemon until it is drained (`--once`) or told to stop (Ctrl-C, SIGTERM).
pub fn run(args: &WatchArgs) -> Result<Outcome> {
    let file = ConfigFile::read(&args.config, &pipeline_tables())?;
    let pipeline = Arc::new(pipeline_of_file(&file)?);
    let config = Config::from_file(&file)?;
    log_to_standard_error(args.said);

    let (stop, stopped) = crossbeam_channel::bounded(1);
    let mut signals = Signals::new([SIGINT, SIGTERM]).context("signals cannot be handled")?;
    std::thread::spawn(move || {
        for _ in signals.forever() {
            // Full means it has been said before.
            let _ = stop.try_send(());
        }
    });

    let options = RunOptions {
        once: args.once,
        dry_run: args.dry_run,
    };
    let summary = seamline_watch::run(config, pipeline, options, stopped)
        .map_err(|error| anyhow::anyhow!("{error}; {}", error.hint()))?;
    for path in &summary.listed {
        print(&shown(path))?;
    }
    Ok(if args.once {
        Outcome::of_failures(summary.failed)
    } else {
        Outcome::Done
    })
}

fn log_to_standard_error(said: SaidArgs) {
    let level = match said {
        SaidArgs { quiet: true, .. } => LevelFilter::WARN,
        SaidArgs { verbose: true, .. } => LevelFilter::DEBUG,
        _ => LevelFilter::INFO,
    };
    tracing_subscriber::fmt()
        .with_max_level(level)
        .with_target(false)
        .with_ansi(io::stderr().is_terminal())
        .log_internal_errors(false)
        .with_writer(io::stderr)
        .init();
}
