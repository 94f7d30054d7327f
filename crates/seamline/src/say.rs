//! What is said to a person, and what is printed for a program.

use std::fmt::Display;
use std::io::{self, Write};
use std::process;

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

/// "1 patch", "2 patches": how many there are of what.
pub fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}
