//! What the daemon is told while it runs: to stop, or to read its configuration anew.

use std::sync::Arc;
use std::time::Instant;

use crossbeam_channel::never;
use tracing::{error, info, warn};

use super::Open;
use super::tell::Asked;
use crate::config::Config;
use crate::daemon::{Order, WatchError, make_folders};
use crate::health::Trouble;
use crate::service;
use crate::setup::Setup;

impl Open {
    pub(super) fn obey(&mut self, order: Option<Order>) {
        match order {
            Some(Order::Stop) => self.stop(),
            Some(Order::Reload) => self.reload(),
            // Nobody is left who could stop the daemon, which is no reason to stop.
            None => self.with.orders = never(),
        }
    }

    pub(super) fn stop(&mut self) {
        if self.stop_by.is_some() {
            self.stop_by = Some(Instant::now());
            return;
        }
        info!(
            "stopping: {} running, {} waiting",
            self.backlog.running().len(),
            self.backlog.waiting()
        );
        service::stopping();
        self.with.health.raise(Trouble::Stopping, "told to stop");
        self.stop_by = Some(Instant::now() + self.with.setup.config.drain_for);
        self.with.crew.begin_nothing_new();
    }

    pub(super) fn leave_unfinished(&mut self) -> Result<(), WatchError> {
        let running: Vec<_> = self.backlog.running().collect();
        self.summary.unfinished = running.len();
        warn!(
            "{} did not end in time and will be done again",
            running.len()
        );
        for id in running {
            self.with.ledger.put_back_unless_ended(id)?;
        }
        Ok(())
    }

    pub(super) fn reload(&mut self) {
        let Some(reload) = &mut self.with.reload else {
            return;
        };
        service::reloading();
        let read = reload.read().and_then(|setup| {
            make_folders(&setup.config).map_err(|error| format!("{error}; {}", error.hint()))?;
            Ok(setup)
        });
        self.with.metrics.reloaded(read.is_ok());
        match read {
            Ok(setup) => self.change_to(setup),
            Err(why) => error!("the configuration is refused, the old one stays in force: {why}"),
        }
        service::ready();
    }

    pub(super) fn change_to(&mut self, mut setup: Setup) {
        for key in needs_restart(&self.with.setup.config, &setup.config) {
            warn!("`{key}` has changed: that holds from the next start on");
        }
        setup.config.state.clone_from(&self.with.setup.config.state);
        let config = &setup.config;
        for (root, _) in self.with.lookout.presence() {
            self.with
                .health
                .clear(&Trouble::FolderAway(root.to_owned()));
        }
        let output = &self.with.setup.config.output;
        self.with
            .health
            .clear(&Trouble::NotWritable(output.clone()));
        self.with.events.retarget(&config.watch);
        self.with.crew.change_to(&setup);
        self.backlog
            .retain(|job| config.watched_with(&job.path).is_some());
        info!("the configuration was read anew and holds from the next job on");
        let setup = Arc::new(setup);
        self.with.lookout.retarget(&setup.config, setup.has_pairs());
        self.with.setup = setup;
        self.asked = Asked::default();
    }
}

/// The keys that cannot change while the daemon runs, and have.
fn needs_restart<'a>(old: &Config, new: &Config) -> impl Iterator<Item = &'a str> {
    [
        ("state.dir", old.state != new.state),
        ("daemon.workers", old.workers != new.workers),
        ("daemon.queue", old.queue != new.queue),
        ("http.listen", old.http != new.http),
        ("log", old.log != new.log),
    ]
    .into_iter()
    .filter_map(|(key, changed)| changed.then_some(key))
}
