//! `seamline watch`: watch folders and cut every mesh that is dropped there.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::Arc;
use std::thread;

use anyhow::{Context, Result};
use crossbeam_channel::{Receiver, unbounded};
use seamline_watch::config::{LogFormat, LogLevel, LogTable};
use seamline_watch::{Config, ConfigFile, Order, Reload, RunOptions, Setup, WatchError, shown};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use tracing_subscriber::filter::LevelFilter;

use crate::args::{SaidArgs, WatchArgs};
use crate::outcome::{Outcome, WrongUse, as_said};
use crate::say::print;
use crate::settings::{pipeline_of_file, pipeline_tables, rules_of_file};

/// Runs the daemon until it is drained (`--once`) or told to stop (Ctrl-C, SIGTERM). SIGHUP has it read its
/// configuration anew, as does a change of the file.
pub fn run(args: &WatchArgs) -> Result<Outcome> {
    let setup = read(&args.config)?;
    log_to_standard_error(args.said, &setup.config.log);

    let file = args.config.clone();
    let reload = Reload::new(&args.config, move || {
        read(&file).map_err(|error| as_said(&error))
    });
    let options = RunOptions {
        once: args.once,
        dry_run: args.dry_run,
    };
    let ran = seamline_watch::run(setup, Some(reload), options, orders()?);
    let summary = match ran {
        Err(error @ (WatchError::Locked(_) | WatchError::NotThere(_))) => {
            return Err(WrongUse(format!("{error}; {}", error.hint())).into());
        }
        ran => ran.map_err(|error| anyhow::anyhow!("{error}; {}", error.hint()))?,
    };
    for path in &summary.listed {
        print(&shown(path))?;
    }
    let unfinished = summary.unfinished > 0;
    let failed = args.once && summary.failed > 0;
    Ok(Outcome::of_failures(usize::from(unfinished || failed)))
}

fn read(path: &Path) -> Result<Setup> {
    let file = ConfigFile::read(path, &pipeline_tables())?;
    let pipeline = Arc::new(pipeline_of_file(&file)?);
    let rules = rules_of_file(&file)?.into_iter();
    let rules = rules.map(|(files, pipeline)| (files, Arc::new(pipeline)));
    Ok(Setup::new(Config::from_file(&file)?, pipeline).with_rules(rules.collect()))
}

/// What the signals mean.
fn orders() -> Result<Receiver<Order>> {
    let (say, orders) = unbounded();
    let mut signals =
        Signals::new([SIGINT, SIGTERM, SIGHUP]).context("signals cannot be handled")?;
    thread::Builder::new()
        .name("signals".to_owned())
        .spawn(move || {
            for signal in signals.forever() {
                let order = if signal == SIGHUP {
                    Order::Reload
                } else {
                    Order::Stop
                };
                if say.send(order).is_err() {
                    return;
                }
            }
        })
        .context("no thread can be started")?;
    Ok(orders)
}

fn log_to_standard_error(said: SaidArgs, log: &LogTable) {
    let say = tracing_subscriber::fmt()
        .with_max_level(level(said, log.level))
        .with_target(false)
        .log_internal_errors(false)
        .with_writer(io::stderr);
    match log.format {
        LogFormat::Text => say.with_ansi(io::stderr().is_terminal()).init(),
        LogFormat::Json => say.json().flatten_event(true).init(),
    }
}

/// What is typed beats what the configuration says.
fn level(said: SaidArgs, configured: LogLevel) -> LevelFilter {
    match (said, configured) {
        (SaidArgs { quiet: true, .. }, _) => LevelFilter::WARN,
        (SaidArgs { verbose: true, .. }, _) => LevelFilter::DEBUG,
        (_, LogLevel::Error) => LevelFilter::ERROR,
        (_, LogLevel::Warn) => LevelFilter::WARN,
        (_, LogLevel::Info) => LevelFilter::INFO,
        (_, LogLevel::Debug) => LevelFilter::DEBUG,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_typed_beats_the_level_of_the_configuration() {
        let [none, quiet, verbose] = [(false, false), (true, false), (false, true)]
            .map(|(quiet, verbose)| SaidArgs { quiet, verbose });
        for (configured, alone) in [
            (LogLevel::Error, LevelFilter::ERROR),
            (LogLevel::Warn, LevelFilter::WARN),
            (LogLevel::Info, LevelFilter::INFO),
            (LogLevel::Debug, LevelFilter::DEBUG),
        ] {
            assert_eq!(level(none, configured), alone);
            assert_eq!(level(quiet, configured), LevelFilter::WARN);
            assert_eq!(level(verbose, configured), LevelFilter::DEBUG);
        }
    }
}
