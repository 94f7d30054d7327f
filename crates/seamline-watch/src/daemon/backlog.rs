//! The jobs that wait, and which of them may run: the results of one place are never worked on twice at the same
//! time, and neither are the same bytes.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::PathBuf;
use std::time::Instant;

use super::job::Waiting;
use crate::ledger::JobId;

/// Jobs in order of arrival; only names wait here, no meshes.
#[derive(Debug, Default)]
pub(super) struct Backlog {
    waiting: BTreeMap<u64, Waiting>,
    by_path: HashMap<PathBuf, u64>,
    /// By their path below the watched folder, which is that of their results.
    running: HashMap<PathBuf, JobId>,
    /// Those that wait for a running job that works on the same bytes.
    behind: HashMap<JobId, Vec<Waiting>>,
    arrivals: u64,
    /// The one that runs and may have brought the program down before.
    suspect_runs: Option<JobId>,
}

impl Backlog {
    /// Takes a job in. A waiting one for the same path is replaced: only the latest content counts.
    pub(super) fn add(&mut self, job: Waiting) {
        for behind in self.behind.values_mut() {
            behind.retain(|other| other.path != job.path);
        }
        if let Some(at) = self.by_path.get(&job.path) {
            self.waiting.insert(*at, job);
            return;
        }
        self.arrivals += 1;
        self.by_path.insert(job.path.clone(), self.arrivals);
        self.waiting.insert(self.arrivals, job);
    }

    /// Takes in a job that came after another with the same bytes: it waits for the end of that one.
    pub(super) fn add_behind(&mut self, job: Waiting, other: JobId) {
        if self.running.values().any(|running| *running == other) {
            self.behind.entry(other).or_default().push(job);
        } else {
            self.add(job);
        }
    }

    /// Gives the first job that is due and whose place is not being worked on, and counts it as running. Were
    /// two runs for one place under way, the results of the older content might be written last. A suspect waits
    /// until nothing runs, and everybody else until the suspect has ended.
    pub(super) fn next(&mut self, now: Instant) -> Option<Waiting> {
        if self.suspect_runs.is_some() {
            return None;
        }
        let may_run = |job: &Waiting| {
            job.not_before.is_none_or(|due| due <= now) && !self.running.contains_key(&job.relative)
        };
        let (&at, first) = self.waiting.iter().find(|(_, job)| may_run(job))?;
        if first.suspicion > 0 && !self.running.is_empty() {
            return None;
        }
        self.suspect_runs = (first.suspicion > 0).then_some(first.id);
        let job = self.waiting.remove(&at)?;
        self.by_path.remove(&job.path);
        self.running.insert(job.relative.clone(), job.id);
        Some(job)
    }

    /// Counts a job as running that never waited. False if its place is being worked on.
    pub(super) fn start(&mut self, job: &Waiting) -> bool {
        let free = !self.running.contains_key(&job.relative);
        if free {
            self.running.insert(job.relative.clone(), job.id);
        }
        free
    }

    /// The job has ended; who waited for it waits no longer.
    pub(super) fn ended(&mut self, job: &Waiting) {
        let Some(id) = self.running.remove(&job.relative) else {
            return;
        };
        self.suspect_runs = self.suspect_runs.filter(|suspect| *suspect != id);
        for job in self.behind.remove(&id).unwrap_or_default() {
            if !self.by_path.contains_key(&job.path) {
                self.add(job);
            }
        }
    }

    /// When the next job that waits for its time is due.
    pub(super) fn next_due(&self) -> Option<Instant> {
        self.waiting.values().filter_map(|job| job.not_before).min()
    }

    /// Forgets those that wait and do not `stay`.
    pub(super) fn retain(&mut self, stay: impl Fn(&Waiting) -> bool) {
        self.waiting.retain(|_, job| stay(job));
        self.by_path.retain(|_, at| self.waiting.contains_key(at));
        for behind in self.behind.values_mut() {
            behind.retain(|job| stay(job));
        }
    }

    /// All jobs that wait or run.
    pub(super) fn ids(&self) -> HashSet<JobId> {
        let behind = self.behind.values().flatten();
        let waiting = self.waiting.values().chain(behind).map(|job| job.id);
        waiting.chain(self.running()).collect()
    }

    /// The jobs that run.
    pub(super) fn running(&self) -> impl ExactSizeIterator<Item = JobId> {
        self.running.values().copied()
    }

    /// How many jobs wait.
    pub(super) fn waiting(&self) -> usize {
        self.waiting.len() + self.behind.values().map(Vec::len).sum::<usize>()
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::tracker::Stamp;

    fn job(name: &str, id: i64) -> Waiting {
        let stamp = Stamp {
            size: 1,
            modified: (0, 0),
            changed: (0, 0),
            identity: (1, 1),
        };
        Waiting {
            id: JobId(id),
            path: name.into(),
            relative: name.into(),
            stamp,
            markings: None,
            unpaired: None,
            overdue: false,
            since: Instant::now(),
            not_before: None,
            suspicion: 0,
            failures: 0,
        }
    }

    fn next(backlog: &mut Backlog) -> Option<i64> {
        backlog.next(Instant::now()).map(|job| job.id.0)
    }

    #[test]
    fn jobs_are_given_in_order_of_arrival() {
        let mut backlog = Backlog::default();
        backlog.add(job("b", 1));
        backlog.add(job("a", 2));
        assert_eq!([next(&mut backlog), next(&mut backlog)], [Some(1), Some(2)]);
        assert_eq!((next(&mut backlog), backlog.running().len()), (None, 2));
    }

    #[test]
    fn a_path_that_is_worked_on_waits_and_lets_others_pass() {
        let mut backlog = Backlog::default();
        backlog.add(job("a", 1));
        next(&mut backlog);
        backlog.add(job("a", 2));
        backlog.add(job("b", 3));
        assert_eq!([next(&mut backlog), next(&mut backlog)], [Some(3), None]);
        backlog.ended(&job("a", 1));
        assert_eq!(next(&mut backlog), Some(2));
    }

    #[test]
    fn of_a_path_that_waits_only_the_latest_content_counts_and_it_keeps_its_place() {
        let mut backlog = Backlog::default();
        backlog.add(job("a", 1));
        backlog.add(job("b", 2));
        backlog.add(job("a", 3));
        assert_eq!([next(&mut backlog), next(&mut backlog)], [Some(3), Some(2)]);
        assert_eq!(backlog.waiting(), 0);
    }

    #[test]
    fn newer_content_takes_the_place_of_what_waits_behind_another() {
        let mut backlog = Backlog::default();
        backlog.add(job("a", 1));
        next(&mut backlog);
        backlog.add_behind(job("b", 2), JobId(1));
        backlog.add(job("b", 3));
        assert_eq!(next(&mut backlog), Some(3));
        backlog.ended(&job("a", 1));
        backlog.ended(&job("b", 3));
        assert_eq!((next(&mut backlog), backlog.ids().len()), (None, 0));
    }

    #[test]
    fn two_folders_with_one_name_are_worked_on_one_after_the_other() {
        let mut backlog = Backlog::default();
        let in_folder = |folder: &str, id| Waiting {
            path: format!("{folder}/a").into(),
            ..job("a", id)
        };
        backlog.add(in_folder("one", 1));
        backlog.add(in_folder("two", 2));
        assert_eq!([next(&mut backlog), next(&mut backlog)], [Some(1), None]);
        backlog.ended(&in_folder("one", 1));
        assert_eq!(next(&mut backlog), Some(2));
    }

    #[test]
    fn a_job_that_failed_lets_others_pass_until_its_time() {
        let mut backlog = Backlog::default();
        let due = Instant::now() + Duration::from_secs(60);
        backlog.add(Waiting {
            not_before: Some(due),
            ..job("a", 1)
        });
        backlog.add(job("b", 2));
        assert_eq!([next(&mut backlog), next(&mut backlog)], [Some(2), None]);
        assert_eq!(backlog.next_due(), Some(due));
        assert_eq!(backlog.next(due).map(|job| job.id.0), Some(1));
    }

    #[test]
    fn a_suspect_runs_alone() {
        let mut backlog = Backlog::default();
        let suspect = |name, id| Waiting {
            suspicion: 1,
            ..job(name, id)
        };
        backlog.add(job("a", 1));
        backlog.add(suspect("b", 2));
        backlog.add(job("c", 3));
        assert_eq!([next(&mut backlog), next(&mut backlog)], [Some(1), None]);
        backlog.ended(&job("a", 1));
        assert_eq!([next(&mut backlog), next(&mut backlog)], [Some(2), None]);
        backlog.ended(&job("b", 2));
        assert_eq!(next(&mut backlog), Some(3));
    }

    #[test]
    fn the_same_bytes_wait_for_the_job_that_works_on_them() {
        let mut backlog = Backlog::default();
        backlog.add(job("a", 1));
        next(&mut backlog);
        backlog.add_behind(job("b", 2), JobId(1));
        assert_eq!((next(&mut backlog), backlog.waiting()), (None, 1));
        backlog.ended(&job("a", 1));
        assert_eq!(next(&mut backlog), Some(2));
        backlog.add_behind(job("c", 3), JobId(1));
        assert_eq!(next(&mut backlog), Some(3));
    }
}
