//! The jobs that wait, and the rule that one path is never worked on twice at the same time.

use std::collections::{HashSet, VecDeque};
use std::path::{Path, PathBuf};

use super::job::Job;

/// Jobs in order of arrival; only names wait here, no meshes.
#[derive(Debug, Default)]
pub(super) struct Backlog {
    waiting: VecDeque<Job>,
    running: HashSet<PathBuf>,
}

impl Backlog {
    /// Takes a job in. A waiting one for the same path is replaced: only the latest content counts.
    pub(super) fn add(&mut self, job: Job) {
        match self
            .waiting
            .iter_mut()
            .find(|waiting| waiting.path == job.path)
        {
            Some(waiting) => *waiting = job,
            None => self.waiting.push_back(job),
        }
    }

    /// Gives the first job whose path is not being worked on, and counts it as running. Were two runs on
    /// one path under way, the results of the older content might be written last.
    pub(super) fn next(&mut self) -> Option<Job> {
        let at = self
            .waiting
            .iter()
            .position(|job| !self.running.contains(&job.path))?;
        let job = self.waiting.remove(at)?;
        self.running.insert(job.path.clone());
        Some(job)
    }

    /// The job on this path has ended.
    pub(super) fn ended(&mut self, path: &Path) {
        self.running.remove(path);
    }

    /// Forgets what waits, and tells how much that was.
    pub(super) fn drop_waiting(&mut self) -> usize {
        std::mem::take(&mut self.waiting).len()
    }

    /// How many jobs run.
    pub(super) fn running(&self) -> usize {
        self.running.len()
    }

    /// How many jobs wait.
    pub(super) fn waiting(&self) -> usize {
        self.waiting.len()
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Instant, SystemTime};

    use super::*;
    use crate::tracker::Stamp;

    fn job(name: &str, size: u64) -> Job {
        let stamp = Stamp {
            size,
            modified: SystemTime::UNIX_EPOCH,
            identity: (1, 1),
        };
        Job {
            path: name.into(),
            relative: name.into(),
            stamp,
            root: 0,
            since: Instant::now(),
        }
    }

    #[test]
    fn jobs_are_given_in_order_of_arrival() {
        let mut backlog = Backlog::default();
        backlog.add(job("b", 1));
        backlog.add(job("a", 1));
        assert_eq!(backlog.next().unwrap().path, Path::new("b"));
        assert_eq!(backlog.next().unwrap().path, Path::new("a"));
        assert_eq!((backlog.next(), backlog.running()), (None, 2));
    }

    #[test]
    fn a_path_that_is_worked_on_waits_and_lets_others_pass() {
        let mut backlog = Backlog::default();
        backlog.add(job("a", 1));
        backlog.next();
        backlog.add(job("a", 2));
        backlog.add(job("b", 1));
        assert_eq!(backlog.next().unwrap().path, Path::new("b"));
        assert_eq!(backlog.next(), None);
        backlog.ended(Path::new("a"));
        assert_eq!(backlog.next().unwrap().stamp.size, 2);
    }

    #[test]
    fn of_a_path_that_waits_only_the_latest_content_counts() {
        let mut backlog = Backlog::default();
        backlog.add(job("a", 1));
        backlog.add(job("a", 2));
        assert_eq!(backlog.next().unwrap().stamp.size, 2);
        backlog.ended(Path::new("a"));
        assert_eq!(backlog.drop_waiting(), 0);
    }
}
