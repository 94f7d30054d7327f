//! How the daemon is doing, told to whoever asks: health, gauges, the service manager.

use std::path::Path;

use rustix::fs::{Access, access};

use super::Open;
use crate::daemon::WatchError;
use crate::health::Trouble;
use crate::memory::limit;
use crate::service;

impl Open {
    pub(super) fn tell(&mut self) -> Result<(), WatchError> {
        self.tell_of_folders();
        let metrics = self.with.metrics.clone();
        metrics.set_queue(self.backlog.waiting());
        metrics.set_abandoned(self.with.crew.abandoned());
        metrics.set_reserved_bytes(self.with.crew.gate().reserved());
        metrics.set_limit_bytes(limit(self.with.setup.config.limits.memory_limit_bytes));
        if self.with.setup.config.http.is_some() {
            let counts = self.record(|ledger| ledger.counts())?;
            let counts: Vec<_> = counts
                .iter()
                .map(|(state, count)| (state.word(), *count))
                .collect();
            metrics.set_jobs(&counts);
            metrics.set_oldest_pending(self.record(|ledger| ledger.oldest_pending())?);
        }
        service::status(&format!(
            "{} running, {} waiting; {} done, {} failed since the start",
            self.backlog.running().len(),
            self.backlog.waiting(),
            self.summary.done + self.summary.same,
            self.summary.failed
        ));
        Ok(())
    }

    fn tell_of_folders(&mut self) {
        let (mut present, mut away) = (0, 0);
        for (root, why) in self.with.lookout.presence() {
            let trouble = Trouble::FolderAway(root.to_owned());
            match why {
                Some(why) => {
                    away += 1;
                    self.with.health.raise(trouble, why);
                }
                None => {
                    present += 1;
                    self.with.health.clear(&trouble);
                }
            }
        }
        self.with.metrics.set_folders(present, away);
        let output = self.with.setup.config.output.clone();
        let trouble = Trouble::NotWritable(output.clone());
        match writable(&output) {
            Ok(()) => self.with.health.clear(&trouble),
            Err(why) => self.with.health.raise(trouble, &why),
        }
    }
}

/// May the folder be written, by its permissions and those of its file system?
fn writable(folder: &Path) -> Result<(), String> {
    access(folder, Access::WRITE_OK | Access::EXEC_OK).map_err(|error| error.to_string())
}
