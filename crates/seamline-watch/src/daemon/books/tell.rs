//! How the daemon is doing, told to whoever asks: health, gauges, the service manager.

use std::path::Path;
use std::time::SystemTime;

use rustix::fs::{Access, access};

use super::Open;
use crate::daemon::WatchError;
use crate::health::Trouble;
use crate::service;

/// What the ledger was asked last.
#[derive(Debug, Default)]
pub(super) struct Asked {
    /// It need not be asked again before this has changed; nothing if it has to be all the same.
    version: Option<(i64, u64)>,
    oldest_pending: Option<SystemTime>,
}

impl Open {
    pub(super) fn tell(&mut self) -> Result<(), WatchError> {
        self.tell_of_folders();
        let metrics = self.with.metrics.clone();
        metrics.set_queue(self.backlog.waiting());
        metrics.set_abandoned(self.with.crew.abandoned());
        metrics.set_reserved_bytes(self.with.crew.gate().reserved());
        metrics.set_limit_bytes(self.with.setup.memory_limit_bytes);
        if self.with.setup.config.http.is_some() {
            self.tell_of_jobs()?;
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

    fn tell_of_jobs(&mut self) -> Result<(), WatchError> {
        let version = Some(self.record(|ledger| ledger.version())?);
        if self.asked.version != version {
            let counts = self.record(|ledger| ledger.counts())?;
            self.with.metrics.set_jobs(&counts);
            let setup = self.with.setup.clone();
            let watched = |path: &Path| setup.config.watched_with(path).is_some();
            let oldest_pending = self.record(|ledger| ledger.oldest_pending(watched))?;
            self.asked = Asked {
                version,
                oldest_pending,
            };
        }
        let waits = |since: SystemTime| since.elapsed().unwrap_or_default();
        self.with
            .metrics
            .set_oldest_pending(self.asked.oldest_pending.map(waits));
        Ok(())
    }

    pub(super) fn tell_of_folders(&mut self) {
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
