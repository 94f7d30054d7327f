//! Files that have held still are entered; those that went away are crossed out.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, Instant};

use tracing::info;

use super::Open;
use crate::config::After;
use crate::daemon::WatchError;
use crate::daemon::job::{Failure, Job, Waiting, stamp_word};
use crate::daemon::lookout::Ready;
use crate::ledger::{Arrival, Row, TakenIn};
use crate::pairs::{Complete, Unpaired, markings_in};
use crate::shown;
use crate::tracker::{FileFact, ReadyFile};

impl Open {
    pub(super) fn take_in(&mut self, ready: Vec<Ready>) -> Result<(), WatchError> {
        let ready = self.pair(ready);
        let mut by_settings: BTreeMap<String, Vec<Ready>> = BTreeMap::new();
        for ready in ready {
            let setup = self.with.setup.for_file(&ready.file.path);
            let alike = by_settings.entry(setup.settings_hash.clone());
            alike.or_default().push(ready);
        }
        for (settings, ready) in by_settings {
            self.take_in_under(&settings, ready)?;
        }
        Ok(())
    }

    /// Halves of pairs wait for each other; everything else goes on.
    fn pair(&mut self, ready: Vec<Ready>) -> Vec<Ready> {
        let setup = &self.with.setup;
        if !setup.has_pairs() {
            return ready;
        }
        let (halves, mut ready): (Vec<Ready>, Vec<Ready>) = ready
            .into_iter()
            .filter(|file| {
                let is_markings = markings_in(&file.file.path).is_some();
                !is_markings || setup.is_of_pair(&file.file.path)
            })
            .partition(|file| setup.is_of_pair(&file.file.path));
        let lookout = &self.with.lookout;
        let nothing_comes = self.with.options.once && lookout.is_settled();
        let max_wait = |path: &Path| {
            let watched = setup.config.watched_with(path);
            watched.map_or(Duration::ZERO, |watched| watched.max_wait)
        };
        let complete = self.pairs.step(
            Instant::now(),
            halves.into_iter().map(|half| half.file).collect(),
            &|file| lookout.holds(file),
            &max_wait,
            nothing_comes,
        );
        ready.extend(complete.into_iter().map(|complete| {
            let (file, markings, unpaired) = match complete {
                Complete::Pair { mesh, markings } => (mesh, Some(markings), None),
                Complete::Lone(half) => (half, None, Some(Unpaired::Lone)),
                Complete::Crowded(mesh) => (mesh, None, Some(Unpaired::Crowded)),
            };
            let watched = setup.config.watched_with(&file.path);
            let relative = watched.and_then(|w| file.path.strip_prefix(&w.root).ok());
            Ready {
                relative: relative.unwrap_or(&file.path).to_owned(),
                unpaired,
                markings: markings.map(|ReadyFile { path, stamp, .. }| FileFact { path, stamp }),
                file,
            }
        }));
        ready
    }

    fn take_in_under(&mut self, settings: &str, ready: Vec<Ready>) -> Result<(), WatchError> {
        let stamps: Vec<_> = ready
            .iter()
            .map(|ready| {
                let markings = ready.markings.as_ref().map(|markings| markings.stamp);
                stamp_word(ready.file.stamp, markings)
            })
            .collect();
        let arrivals: Vec<_> = ready
            .iter()
            .zip(&stamps)
            .map(|(ready, stamp)| Arrival {
                path: &ready.file.path,
                relative: &ready.relative,
                markings: ready.markings.as_ref().map(|markings| &*markings.path),
                stamp,
            })
            .collect();
        let taken = self.record(|ledger| ledger.take_in(&arrivals, settings))?;
        let mut taken: Vec<_> = ready.into_iter().zip(taken).collect();
        // Those that may bring the program down come when the others are done.
        taken.sort_by_key(|(_, taken)| taken.suspicion());
        for (ready, taken) in taken {
            let suspicion = taken.suspicion();
            let waiting = |id| Waiting {
                id,
                suspicion,
                path: ready.file.path,
                relative: ready.relative,
                stamp: ready.file.stamp,
                markings: ready.markings,
                unpaired: ready.unpaired,
                overdue: ready.file.overdue,
                since: Instant::now(),
                not_before: None,
                failures: 0,
            };
            match taken {
                TakenIn::Queue { id, .. } => self.backlog.add(waiting(id)),
                TakenIn::Running => {}
                TakenIn::Done(id) => self.settle_again(waiting(id), 1, None)?,
                TakenIn::Quarantined(row) => {
                    self.summary.failed += 1;
                    self.settle_again(waiting(row.id), row.attempts, Some(failure_of(*row)))?;
                }
            }
        }
        Ok(())
    }

    /// A crash may have come between what the ledger says of a job and what was to become of its file.
    pub(super) fn settle_again(
        &mut self,
        file: Waiting,
        attempts: u32,
        failure: Option<Failure>,
    ) -> Result<(), WatchError> {
        let Some(job) = self.job(file, attempts) else {
            return Ok(());
        };
        if (failure.is_none() && job.after == After::Keep) || !self.backlog.start(&job.file) {
            return Ok(());
        }
        self.settle(job, failure)
    }

    pub(super) fn settle(&self, job: Job, failure: Option<Failure>) -> Result<(), WatchError> {
        if self.with.crew.settle(job, failure) {
            Ok(())
        } else {
            Err(WatchError::CrewLost)
        }
    }

    /// Files that went away while they waited for more of themselves, or while nobody watched.
    pub(super) fn reconcile(&mut self) -> Result<(), WatchError> {
        self.reconciled_at = Some(Instant::now());
        let known = self.backlog.ids();
        for (id, path) in self.record(|ledger| ledger.pending())? {
            if !known.contains(&id) && self.with.lookout.is_missing(&path) {
                info!("{}: gone before it was read", shown(&path));
                self.record(|ledger| ledger.gone(id))?;
            }
        }
        Ok(())
    }
}

fn failure_of(row: Row) -> Failure {
    let stage = row.stage.unwrap_or_default();
    let [message, hint] = [row.message, row.hint].map(Option::unwrap_or_default);
    Failure::new(&stage, message, hint).of(row.content)
}
