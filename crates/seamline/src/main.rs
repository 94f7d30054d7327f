//! Seamline on the command line: cut a mesh, look at one, watch a folder.

mod args;
mod check_config;
mod check_plugin;
mod inspect;
mod list_plugins;
mod outcome;
mod rectify;
mod requeue;
mod results;
mod say;
mod segment;
mod settings;
mod status;
mod watch;

use clap::Parser;

/// The allocator of the C library raises the size from which memory goes back to the system as large arrays come and
/// go, until the program holds far more than it uses, and more than the daemon's limit.
///
/// The second series of mimalloc, since the third takes as long and holds up to twice as much of a mesh of 15,000 or 100,000
/// triangles (measured at 0.1.52).
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

use args::{Args, Command, PluginsArgs, PluginsCommand};
use outcome::Outcome;

fn main() -> std::process::ExitCode {
    let args = Args::parse();
    let outcome = match &args.command {
        Command::Segment(segment) => segment::run(segment),
        Command::Rectify(rectify) => rectify::run(rectify),
        Command::Inspect(inspect) => inspect::run(inspect),
        Command::Watch(watch) => watch::run(watch),
        Command::Status(status) => status::run(status),
        Command::Requeue(requeue) => requeue::run(requeue),
        Command::Plugins(PluginsArgs {
            command: Some(PluginsCommand::Check(plugin)),
            ..
        }) => check_plugin::run(plugin),
        Command::Plugins(plugins) => list_plugins::run(plugins),
        Command::Config { command } => check_config::run(command),
    };
    outcome.unwrap_or_else(Outcome::of_error).exit_code()
}
