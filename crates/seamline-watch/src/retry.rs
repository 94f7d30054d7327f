//! Which failures may pass by themselves, and how long to wait before the next attempt.

use std::io;
use std::time::Duration;

use rustix::io::Errno;

/// May the same read or write succeed later, with nothing changed about the file? So it is with disks, networks,
/// locks and permissions; not with what the bytes say.
pub fn may_pass(error: &io::Error) -> bool {
    use io::ErrorKind as Kind;
    !matches!(
        error.kind(),
        Kind::InvalidData
            | Kind::InvalidInput
            | Kind::UnexpectedEof
            | Kind::InvalidFilename
            | Kind::Unsupported
    )
}

/// Is it the disk that has no more room?
pub fn is_full_disk(error: &io::Error) -> bool {
    let full = [Errno::NOSPC, Errno::DQUOT].map(Errno::raw_os_error);
    error
        .raw_os_error()
        .is_some_and(|code| full.contains(&code))
}

/// How long to wait after an attempt that failed, the first being number 1: `first`, then twice as long each time
/// up to `most`, give or take a quarter, so that what failed together does not come back together. `chance` is
/// drawn from 0 to 1.
pub fn back_off(attempt: u32, first: Duration, most: Duration, chance: f64) -> Duration {
    let doubled = first.saturating_mul(1 << attempt.saturating_sub(1).min(30));
    doubled.min(most).mul_f64(0.75 + 0.5 * chance)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn each_wait_is_twice_the_one_before_up_to_the_longest() {
        let wait = |attempt| back_off(attempt, SECOND, 60 * SECOND, 0.5).as_secs();
        let waits: Vec<_> = (1..=8).map(wait).collect();
        assert_eq!(waits, [1, 2, 4, 8, 16, 32, 60, 60]);
        assert_eq!(wait(u32::MAX), 60);
    }

    #[test]
    fn chance_takes_or_gives_a_quarter() {
        let wait = |chance| back_off(3, SECOND, 60 * SECOND, chance);
        assert_eq!((wait(0.0), wait(1.0)), (3 * SECOND, 5 * SECOND));
    }

    #[test]
    fn a_failing_disk_may_pass_and_a_wrong_content_does_not() {
        let of = |errno: Errno| io::Error::from_raw_os_error(errno.raw_os_error());
        for errno in [
            Errno::IO,
            Errno::BUSY,
            Errno::ACCESS,
            Errno::STALE,
            Errno::TIMEDOUT,
            Errno::NOSPC,
        ] {
            assert!(may_pass(&of(errno)), "{errno}");
        }
        assert!(!may_pass(&io::Error::new(
            io::ErrorKind::InvalidData,
            "no mesh"
        )));
    }

    #[test]
    fn a_full_disk_and_a_full_quota_are_told_from_other_failures() {
        let of = |errno: Errno| io::Error::from_raw_os_error(errno.raw_os_error());
        assert!(is_full_disk(&of(Errno::NOSPC)) && is_full_disk(&of(Errno::DQUOT)));
        assert!(!is_full_disk(&of(Errno::IO)));
    }
}
