//! The thread that keeps the books: what is ready, what waits, what runs, and what came of it.

mod arrivals;
mod enter;
mod obey;
mod tell;

use std::path::PathBuf;
use std::sync::Arc;
use std::thread::sleep;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvError, TryRecvError, never, select};
use tracing::{Span, error_span, info, warn};

use super::backlog::Backlog;
use super::crew::Crew;
use super::job::{Job, Waiting};
use super::lookout::Lookout;
use super::{Order, Reload, RunOptions, Summary, WatchError};
use crate::events::Events;
use crate::health::{Health, Trouble};
use crate::ledger::{Ledger, LedgerError};
use crate::lock::InstanceLock;
use crate::metrics::Metrics;
use crate::pairs::Pairs;
use crate::setup::Setup;
use crate::{service, shown};
use tell::Asked;

/// Everything is looked after at least this often.
const BEAT_EVERY: Duration = Duration::from_secs(1);
/// Room among the jobs comes without a message; it is looked for this often while jobs wait.
const ROOM_EVERY: Duration = Duration::from_millis(20);
/// What waits in the ledger is compared with what is there this often.
const RECONCILE_EVERY: Duration = Duration::from_secs(60);
/// A ledger that cannot be written is tried again this often.
const LEDGER_EVERY: Duration = Duration::from_millis(200);
/// With so many meshes hanging the daemon ends, so that whoever looks after it can start it afresh.
const MOST_HANGING: usize = 8;

/// What the books are kept with.
pub(super) struct Books {
    pub setup: Arc<Setup>,
    pub reload: Option<Reload>,
    pub ledger: Ledger,
    pub lookout: Lookout,
    pub events: Events,
    pub crew: Crew,
    pub health: Arc<Health>,
    pub metrics: Arc<Metrics>,
    pub options: RunOptions,
    pub orders: Receiver<Order>,
    pub lock: InstanceLock,
}

/// The books while they are kept.
struct Open {
    with: Books,
    backlog: Backlog,
    /// Halves that wait for each other.
    pairs: Pairs,
    summary: Summary,
    /// Told to stop: what runs has until then.
    stop_by: Option<Instant>,
    beaten_at: Option<Instant>,
    reconciled_at: Option<Instant>,
    first_look_done: bool,
    /// Sources that could not be moved, and when to try again.
    to_settle: Vec<(Instant, PathBuf)>,
    /// Asked for while the ledger could not be written.
    reload_asked: bool,
    asked: Asked,
}

impl Books {
    /// Keeps the books until the daemon is to end, and then until the last running job has ended.
    pub(super) fn keep(self) -> Result<Summary, WatchError> {
        let mut open = Open {
            with: self,
            backlog: Backlog::default(),
            pairs: Pairs::default(),
            summary: Summary::default(),
            stop_by: None,
            beaten_at: None,
            reconciled_at: None,
            first_look_done: false,
            to_settle: Vec::new(),
            reload_asked: false,
            asked: Asked::default(),
        };
        let kept = open.keep();
        // On an error too: nothing new is begun, and threads that still live are let go.
        open.with.crew.begin_nothing_new();
        kept?;
        open.summary.empty = open.with.lookout.empty();
        open.summary.dropped += open.backlog.waiting();
        if open.summary.unfinished == 0 {
            open.with.crew.join();
        }
        Ok(open.summary)
    }
}

impl Open {
    fn keep(&mut self) -> Result<(), WatchError> {
        let mut hints = self.with.events.hints().clone();
        loop {
            self.beat()?;
            if self.stop_by.is_none() {
                if self.with.lookout.wait(Instant::now()).is_zero() {
                    self.look()?;
                }
                self.hand_over()?;
            }
            if self.is_at_end()? {
                return Ok(());
            }
            let wait = self.wait();
            select! {
                recv(self.with.crew.outcomes()) -> outcome => {
                    self.enter(outcome.map_err(|_| WatchError::CrewLost)?)?;
                }
                recv(hints) -> hint => match hint {
                    Ok(()) => self.with.lookout.hint(),
                    // Nothing more will be heard; the periodic listing goes on.
                    Err(RecvError) => hints = never(),
                },
                recv(self.with.orders) -> order => self.obey(order.ok()),
                default(wait) => {}
            }
        }
    }

    /// How long nothing is to be done, unless somebody has something to say.
    fn wait(&mut self) -> Duration {
        let now = Instant::now();
        let mut wait = BEAT_EVERY;
        if self.stop_by.is_none() {
            wait = wait.min(self.with.lookout.wait(now));
            if self.backlog.waiting() > 0 && self.with.crew.has_room() {
                let due = self.backlog.next_due();
                wait = due.map_or(wait, |due| wait.min(due.saturating_duration_since(now)));
            } else if self.backlog.waiting() > 0 {
                wait = wait.min(ROOM_EVERY);
            }
        }
        wait
    }

    fn is_at_end(&mut self) -> Result<bool, WatchError> {
        let running = self.backlog.running().len();
        if let Some(stop_by) = self.stop_by {
            if running > 0 && Instant::now() >= stop_by {
                self.leave_unfinished()?;
                return Ok(true);
            }
            return Ok(running == 0);
        }
        let idle = running == 0 && self.backlog.waiting() == 0;
        Ok(self.with.options.once && idle && self.with.lookout.is_settled())
    }

    /// What has to be looked after once in a while.
    fn beat(&mut self) -> Result<(), WatchError> {
        self.with.health.beat();
        let now = Instant::now();
        if self.beaten_at.is_some_and(|last| now < last + BEAT_EVERY) {
            return Ok(());
        }
        self.beaten_at = Some(now);
        service::alive();
        if !self.with.lock.is_in_place() {
            return Err(WatchError::StateGone(self.with.setup.config.state.clone()));
        }
        for (job, failure) in self
            .with
            .crew
            .give_up_overdue(now)
            .map_err(WatchError::Threads)?
        {
            self.timed_out(job, failure)?;
        }
        let hanging = self.with.crew.abandoned();
        if hanging >= MOST_HANGING {
            return Err(WatchError::Hanging(hanging));
        }
        let changed = self.with.reload.as_mut().is_some_and(Reload::is_due);
        if std::mem::take(&mut self.reload_asked) || changed {
            self.reload();
        }
        if self.record(|ledger| ledger.changed_elsewhere())? {
            let known = self.backlog.ids();
            for (id, path) in self.record(|ledger| ledger.pending())? {
                if !known.contains(&id) {
                    self.with.lookout.look_again(&path);
                }
            }
        }
        let (due, later) = std::mem::take(&mut self.to_settle)
            .into_iter()
            .partition::<Vec<_>, _>(|(at, _)| *at <= now);
        self.to_settle = later;
        for (_, path) in due {
            self.with.lookout.look_again(&path);
        }
        self.tell()
    }

    fn look(&mut self) -> Result<(), WatchError> {
        let look = self.with.lookout.look(&mut self.with.events);
        for _ in 0..look.overflows {
            warn!("changes came faster than they could be heard; every folder is listed");
            self.with.metrics.overflowed();
        }
        for _ in 0..look.scans {
            self.with.metrics.scanned();
        }
        for path in look.restless {
            warn!("{}: is still being written to, and is left", shown(&path));
            self.summary.failed += 1;
        }
        self.take_in(look.ready)?;
        let due = |last: Instant| last.elapsed() >= RECONCILE_EVERY;
        if look.scans > 0 && self.reconciled_at.is_none_or(due) {
            self.reconcile()?;
        }
        if !self.first_look_done {
            self.first_look_done = true;
            self.tell_of_folders();
            self.with.health.clear(&Trouble::Starting);
            service::ready();
        }
        Ok(())
    }

    fn hand_over(&mut self) -> Result<(), WatchError> {
        while self.with.crew.has_room() {
            let Some(file) = self.backlog.next(Instant::now()) else {
                return Ok(());
            };
            let id = file.id;
            let settings = self.with.setup.for_file(&file.path).settings_hash.clone();
            let attempts = self.record(|ledger| ledger.begin(id, &settings))?;
            let waited = file.clone();
            if let Some(job) = self.job(file, attempts) {
                if !self.with.crew.hand_over(job) {
                    return Err(WatchError::CrewLost);
                }
            } else {
                self.record(|ledger| ledger.put_back(id))?;
                self.backlog.ended(&waited);
            }
        }
        Ok(())
    }

    /// The job on a file; nothing if its folder is watched no longer.
    fn job(&self, file: Waiting, attempts: u32) -> Option<Job> {
        let setup = self.with.setup.for_file(&file.path);
        let watched = setup.config.watched_with(&file.path)?;
        Some(Job {
            after: watched.after,
            span: span_of(&file),
            attempts,
            setup,
            file,
        })
    }

    /// Reads or writes the ledger. While that is not possible, because its disk is full or somebody else has
    /// it, everything waits.
    fn record<T>(
        &mut self,
        mut work: impl FnMut(&mut Ledger) -> Result<T, LedgerError>,
    ) -> Result<T, WatchError> {
        let trouble = || Trouble::Ledger(self.with.setup.config.state.clone());
        let mut waits = false;
        loop {
            match work(&mut self.with.ledger) {
                Ok(done) => {
                    if waits {
                        info!("the ledger can be written again");
                        self.with.health.clear(&trouble());
                    }
                    return Ok(done);
                }
                Err(error) if error.may_pass() => {
                    if !waits {
                        waits = true;
                        warn!("{error}; {}; waiting until that is so", error.hint());
                        self.with.health.raise(trouble(), &error.to_string());
                    }
                    self.with.health.beat();
                    service::alive();
                    match self.with.orders.try_recv() {
                        Ok(Order::Stop) | Err(TryRecvError::Disconnected) => {
                            return Err(error.into());
                        }
                        Ok(Order::Reload) => self.reload_asked = true,
                        Err(TryRecvError::Empty) => {}
                    }
                    sleep(LEDGER_EVERY);
                }
                Err(error) => return Err(error.into()),
            }
        }
    }
}

/// Of the highest level, so that it is told along with whatever is said.
fn span_of(file: &Waiting) -> Span {
    error_span!("job", id = file.id.0, path = %shown(&file.path))
}
