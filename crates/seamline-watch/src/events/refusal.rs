//! Why the system does not tell of changes, in words that say what to do.

use std::fs::{self, File};
use std::io;

use notify::{Error, ErrorKind};
use rustix::io::Errno;

/// One line: what is wrong, and what to type.
pub(super) fn in_plain_words(error: &Error) -> String {
    match &error.kind {
        ErrorKind::MaxFilesWatch => {
            exhausted("inotify watches", "fs.inotify.max_user_watches", 524_288)
        }
        ErrorKind::Io(error) if is(error, Errno::MFILE) => match File::open("/") {
            Err(error) if is(&error, Errno::MFILE) => {
                "this process has no more files to open; raise its limit (`ulimit -n`)".to_owned()
            }
            _ => exhausted("inotify instances", "fs.inotify.max_user_instances", 1024),
        },
        ErrorKind::Io(error) if is(error, Errno::NFILE) => {
            exhausted("open files", "fs.file-max", 1_000_000)
        }
        _ => format!("the system does not tell of changes there: {error}"),
    }
}

fn is(error: &io::Error, errno: Errno) -> bool {
    error.raw_os_error() == Some(errno.raw_os_error())
}

fn exhausted(what: &str, sysctl: &str, enough: u64) -> String {
    let file = format!("/proc/sys/{}", sysctl.replace('.', "/"));
    let now: Option<u64> = fs::read_to_string(file)
        .ok()
        .and_then(|text| text.trim().parse().ok());
    let wanted = now.map_or(enough, |now| enough.max(now.saturating_mul(2)));
    let now = now.map_or_else(String::new, |now| format!(" (it is {now} now)"));
    format!(
        "the system has no more {what} to give; type `sudo sysctl {sysctl}={wanted}`{now}, and write \
         `{sysctl}={wanted}` into a file in /etc/sysctl.d to keep it"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(errno: Errno) -> String {
        in_plain_words(&Error::io(errno.into()))
    }

    #[test]
    fn each_limit_is_named_with_what_to_type() {
        let watches = in_plain_words(&Error::new(ErrorKind::MaxFilesWatch));
        assert!(watches.contains("type `sudo sysctl fs.inotify.max_user_watches="));
        assert!(words(Errno::MFILE).contains("type `sudo sysctl fs.inotify.max_user_instances="));
        assert!(words(Errno::NFILE).contains("type `sudo sysctl fs.file-max="));
        assert!(words(Errno::NOMEM).contains("memory"));
    }

    #[test]
    fn more_is_asked_for_than_there_is_now() {
        let text = exhausted("processes", "kernel.pid_max", 1);
        let now: u64 = fs::read_to_string("/proc/sys/kernel/pid_max")
            .unwrap()
            .trim()
            .parse()
            .unwrap();
        assert!(
            text.contains(&format!("kernel.pid_max={}`", 2 * now)),
            "{text}"
        );
    }
}
