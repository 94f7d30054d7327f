//! What came of a job is entered: first into the ledger, then whatever follows from it.

use std::time::{Duration, Instant};

use tracing::{info, warn};

use super::Open;
use crate::config::After;
use crate::daemon::WatchError;
use crate::daemon::job::{Failure, Job, Outcome, Remedy, Waiting};
use crate::metrics::OutcomeKind;
use crate::retry::back_off;
use crate::shown;

/// A source that could not be moved is tried again after this long.
const SETTLE_AGAIN_AFTER: Duration = Duration::from_secs(15);

impl Open {
    pub(super) fn enter(&mut self, outcome: Outcome) -> Result<(), WatchError> {
        let span = outcome.job().span.clone();
        let _said = span.enter();
        let id = outcome.job().file.id;
        match outcome {
            Outcome::Written {
                job,
                content,
                patches,
                result,
            } => {
                let stranded = self.record(|ledger| ledger.done(id, &content, &result))?;
                for path in stranded {
                    self.with.lookout.look_again(&path);
                }
                self.summary.done += 1;
                let took = job.file.since.elapsed();
                self.with.metrics.job_ended(OutcomeKind::Done);
                self.with.metrics.job_took(took);
                info!("cut in {:.2} s, patches: {patches}", took.as_secs_f64());
                self.done(job)
            }
            Outcome::Same {
                job,
                content,
                holder,
                path,
            } => {
                if !self.record(|ledger| ledger.same_content(id, &content, holder))? {
                    return self.begin_anew(job);
                }
                self.summary.same += 1;
                self.with.metrics.job_ended(OutcomeKind::SameContent);
                info!(
                    "the same was cut before, as {} in job {}",
                    shown(&path),
                    holder.0
                );
                self.done(job)
            }
            Outcome::Behind { job, other } => {
                let waits = self.record(|ledger| ledger.put_back(id))?;
                self.backlog.ended(&job.file);
                if waits {
                    self.backlog.add_behind(job.file, other);
                }
                Ok(())
            }
            Outcome::Failed { job, failure } => self.failed(job, failure),
            Outcome::EndsEarly { job, failure } => self.ends_early(job, failure),
            Outcome::Changed { job } => {
                self.record(|ledger| ledger.put_back(id))?;
                self.with.metrics.job_ended(OutcomeKind::Changed);
                info!("changed while it was read");
                self.with.lookout.take_back(&job.file.path, job.file.stamp);
                self.end(&job);
                Ok(())
            }
            Outcome::Gone { job } => {
                self.record(|ledger| ledger.gone(id))?;
                self.with.metrics.job_ended(OutcomeKind::Gone);
                info!("gone before it was read");
                // Should it be back by now, or come back as it was, it is a new arrival.
                self.with.lookout.take_back(&job.file.path, job.file.stamp);
                self.end(&job);
                Ok(())
            }
            Outcome::Dropped { job } => {
                self.record(|ledger| ledger.put_back(id))?;
                self.summary.dropped += 1;
                self.end(&job);
                Ok(())
            }
            Outcome::Outdated { job } => self.begin_anew(job),
            Outcome::Settled { job, place } => {
                match place {
                    Ok(Some(place)) => {
                        self.record(|ledger| ledger.settled(id, &place))?;
                        if !place.as_os_str().is_empty() {
                            info!("moved to {}", shown(&place));
                        }
                    }
                    Ok(None) => {}
                    Err(error) => {
                        warn!(
                            "the file stays where it is: {error}; check that its folder may be written"
                        );
                        let again = Instant::now() + SETTLE_AGAIN_AFTER;
                        self.to_settle.push((again, job.file.path.clone()));
                    }
                }
                self.end(&job);
                Ok(())
            }
        }
    }

    /// What the job was begun with holds no longer.
    fn begin_anew(&mut self, job: Job) -> Result<(), WatchError> {
        let waits = self.record(|ledger| ledger.put_back(job.file.id))?;
        self.end(&job);
        if waits {
            self.backlog.add(job.file);
        }
        Ok(())
    }

    pub(super) fn timed_out(&mut self, job: Job, failure: Failure) -> Result<(), WatchError> {
        let span = job.span.clone();
        let _said = span.enter();
        self.with.metrics.job_ended(OutcomeKind::TimedOut);
        self.failed(job, failure)
    }

    fn failed(&mut self, job: Job, failure: Failure) -> Result<(), WatchError> {
        let most = job.setup.config.retry.attempts;
        let enough = match failure.remedy {
            // The ledger does not count these as attempts.
            Remedy::AgainForEver => job.file.failures + 1 >= most,
            Remedy::Again | Remedy::None => job.attempts >= most,
        };
        match failure.remedy {
            Remedy::Again if !enough => self.again(job, &failure),
            // The file is not at fault; but `once` has an end.
            Remedy::AgainForEver if enough && self.with.options.once => self.leave(job, &failure),
            Remedy::AgainForEver => self.again(job, &failure),
            Remedy::Again | Remedy::None => self.give_up(job, failure),
        }
    }

    fn again(&mut self, job: Job, failure: &Failure) -> Result<(), WatchError> {
        let (id, fault) = (job.file.id, &failure.fault);
        let counts = failure.remedy == Remedy::Again;
        let waits = self.record(|ledger| ledger.postpone(id, fault, counts))?;
        self.with.metrics.job_ended(OutcomeKind::Retried);
        if !waits {
            self.end(&job);
            return Ok(());
        }
        let retry = &job.setup.config.retry;
        let failures = job.file.failures + 1;
        let [first, most] = [retry.first_ms, retry.most_ms].map(Duration::from_millis);
        let wait = back_off(failures, first, most, fastrand::f64());
        warn!(
            "{}: {}; {}; attempt {failures}, next in {:.1} s",
            fault.stage,
            fault.message,
            fault.hint,
            wait.as_secs_f64()
        );
        self.end(&job);
        self.backlog.add(Waiting {
            not_before: Some(Instant::now() + wait),
            failures,
            ..job.file
        });
        Ok(())
    }

    fn leave(&mut self, job: Job, failure: &Failure) -> Result<(), WatchError> {
        let (id, fault) = (job.file.id, &failure.fault);
        self.record(|ledger| ledger.postpone(id, fault, false))?;
        self.summary.failed += 1;
        say_failed(failure);
        self.end(&job);
        Ok(())
    }

    /// There may be more to come: of a file that is cut short, or of a pair whose halves do not fit.
    fn ends_early(&mut self, job: Job, failure: Failure) -> Result<(), WatchError> {
        match (self.with.options.once, failure.fault.of_content) {
            (true, true) => return self.give_up(job, failure),
            (true, false) => return self.leave(job, &failure),
            (false, _) => {}
        }
        let (id, fault) = (job.file.id, &failure.fault);
        self.record(|ledger| ledger.postpone(id, fault, false))?;
        info!("{}; waiting for the rest of it", fault.message);
        self.with.lookout.ends_early(&job.file.path, job.file.stamp);
        self.end(&job);
        Ok(())
    }

    fn give_up(&mut self, job: Job, failure: Failure) -> Result<(), WatchError> {
        let id = job.file.id;
        let (content, fault) = (&failure.content, &failure.fault);
        self.record(|ledger| ledger.quarantine(id, content.as_deref(), fault))?;
        self.summary.failed += 1;
        self.with.metrics.job_ended(OutcomeKind::Quarantined);
        say_failed(&failure);
        self.settle(job, Some(failure))
    }

    fn done(&mut self, job: Job) -> Result<(), WatchError> {
        if job.after == After::Keep {
            self.end(&job);
            return Ok(());
        }
        self.settle(job, None)
    }

    fn end(&mut self, job: &Job) {
        self.with.crew.release(job.file.id);
        self.backlog.ended(&job.file);
    }
}

fn say_failed(failure: &Failure) {
    let fault = &failure.fault;
    warn!("{}: {}; {}", fault.stage, fault.message, fault.hint);
}
