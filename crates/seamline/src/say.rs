//! What is said to a person, and what is printed for a program.

use std::fmt::Display;
use std::io::{self, Write};
use std::process;

use tracing_subscriber::filter::LevelFilter;

/// One line on standard error. If that is gone there is nobody to tell.
pub fn say(line: &dyn Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// One line on standard output.
///
/// A reader that has gone away, as `head` does, has seen enough: the program ends, all done. A full disk
/// is an error.
pub fn print(line: &dyn Display) -> io::Result<()> {
    match writeln!(io::stdout(), "{line}") {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => process::exit(0),
        done => done,
    }
}

/// From now on what steps have to tell, the words of programs that fill a stage above all, goes to standard error as
/// it comes.
pub fn tell_as_it_comes() {
    tracing_subscriber::fmt()
        .with_max_level(LevelFilter::INFO)
        .with_writer(io::stderr)
        .with_ansi(false)
        .with_target(false)
        .with_level(false)
        .without_time()
        .init();
}

/// "1 patch", "2 patches": how many there are of what.
pub fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}
