//! Lets in as many as fit into the memory there is.

use std::collections::BTreeSet;
use std::mem;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How often one who waits asks whether to go on waiting.
const ASK_EVERY: Duration = Duration::from_millis(50);

/// More than there is altogether.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("needs about {} MiB of memory, and meshes have {} MiB, three quarters of the limit", .needs.div_ceil(1 << 20), .limit >> 20)]
pub struct TooLarge {
    /// What is needed, in bytes.
    pub needs: u64,
    /// What meshes have, in bytes.
    pub limit: u64,
}

impl TooLarge {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        "raise `limits.memory_limit_bytes` if there is more memory, or split or coarsen the mesh"
    }
}

/// Memory that is given out in shares. Clones are the same gate.
///
/// Who comes first gets in first: a large one waits until there is room, and all that come after it wait
/// behind it, so that many small ones cannot keep it out for ever.
#[derive(Clone, Debug)]
pub struct Gate {
    shared: Arc<Shared>,
}

#[derive(Debug)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug)]
struct State {
    limit: u64,
    reserved: u64,
    /// How many have a pass.
    inside: usize,
    /// Everybody who comes draws the next number.
    next_number: u64,
    /// The numbers of those who wait to get in.
    waiting: BTreeSet<u64>,
    /// The numbers of those who are in and wait to grow.
    growing: BTreeSet<u64>,
}

impl State {
    fn check(&self, needs: u64) -> Result<(), TooLarge> {
        let limit = self.limit;
        if needs > limit {
            return Err(TooLarge { needs, limit });
        }
        Ok(())
    }

    fn has_room(&self, bytes: u64) -> bool {
        self.reserved
            .checked_add(bytes)
            .is_some_and(|sum| sum <= self.limit)
    }
}

/// A share of the memory, given back when it is dropped.
#[derive(Debug)]
pub struct Pass {
    shared: Arc<Shared>,
    number: u64,
    bytes: u64,
}

impl Gate {
    /// A gate to so many bytes.
    pub fn new(limit: u64) -> Self {
        let state = State {
            limit,
            reserved: 0,
            inside: 0,
            next_number: 0,
            waiting: BTreeSet::new(),
            growing: BTreeSet::new(),
        };
        Self {
            shared: Arc::new(Shared {
                state: Mutex::new(state),
                changed: Condvar::new(),
            }),
        }
    }

    /// A share of so many bytes, if there is room now and nobody waits. `None`: not now.
    ///
    /// # Errors
    ///
    /// There never will be room.
    pub fn try_enter(&self, bytes: u64) -> Result<Option<Pass>, TooLarge> {
        let mut state = self.shared.lock();
        state.check(bytes)?;
        let free = state.waiting.is_empty() && state.growing.is_empty() && state.has_room(bytes);
        Ok(free.then(|| {
            let number = state.draw();
            self.shared.admit(&mut state, number, bytes)
        }))
    }

    /// Waits for a share of so many bytes. `None`: `stop` said so, which is asked several times a second while
    /// there is no room.
    ///
    /// # Errors
    ///
    /// There never will be room; also if the limit becomes too small while this waits.
    pub fn enter(&self, bytes: u64, stop: &dyn Fn() -> bool) -> Result<Option<Pass>, TooLarge> {
        let mut state = self.shared.lock();
        let number = state.draw();
        state.waiting.insert(number);
        let may = loop {
            if let Err(error) = state.check(bytes) {
                break Err(error);
            }
            let is_next = state.growing.is_empty() && state.waiting.first() == Some(&number);
            if is_next && state.has_room(bytes) {
                break Ok(true);
            }
            drop(self.shared.wait(state));
            // Not while the state is locked: who knows what it looks at.
            let stopped = stop();
            state = self.shared.lock();
            if stopped {
                break Ok(false);
            }
        };
        state.waiting.remove(&number);
        // The next one may fit beside this one, or in its place.
        self.shared.changed.notify_all();
        let may = may?;
        Ok(may.then(|| self.shared.admit(&mut state, number, bytes)))
    }

    /// Does somebody wait to get in or to grow? Who holds what it could do without gives it back then.
    pub fn is_waited_for(&self) -> bool {
        let state = self.shared.lock();
        !state.waiting.is_empty() || !state.growing.is_empty()
    }

    /// How many bytes are given out.
    pub fn reserved(&self) -> u64 {
        self.shared.lock().reserved
    }

    /// How many bytes there are altogether.
    pub fn limit(&self) -> u64 {
        self.shared.lock().limit
    }

    /// Changes how many bytes there are. If more than that is given out, nobody gets in until enough of it
    /// has come back.
    pub fn set_limit(&self, limit: u64) {
        self.shared.lock().limit = limit;
        self.shared.changed.notify_all();
    }
}

impl Pass {
    /// Makes the share smaller at once, or larger as soon as there is room: before those who wait to get in,
    /// and in the order in which those who grow got in. `false`: `stop` said so, the share is as it was.
    ///
    /// Where everybody who is in waits to grow, nobody would ever give anything back. Then the one who got in
    /// first grows at once, beyond the limit if need be: by no more than the shares of the others.
    ///
    /// # Errors
    ///
    /// There never will be room; the share is as it was.
    pub fn resize(&mut self, bytes: u64, stop: &dyn Fn() -> bool) -> Result<bool, TooLarge> {
        let shared = Arc::clone(&self.shared);
        let mut state = shared.lock();
        if bytes <= self.bytes {
            self.set(&mut state, bytes);
            return Ok(true);
        }
        state.growing.insert(self.number);
        // It may be the last one the others waited for.
        shared.changed.notify_all();
        let may = loop {
            if let Err(error) = state.check(bytes) {
                break Err(error);
            }
            let is_next = state.growing.first() == Some(&self.number);
            let all_wait = state.growing.len() == state.inside;
            if is_next && (all_wait || state.has_room(bytes - self.bytes)) {
                break Ok(true);
            }
            drop(shared.wait(state));
            let stopped = stop();
            state = shared.lock();
            if stopped {
                break Ok(false);
            }
        };
        state.growing.remove(&self.number);
        if may == Ok(true) {
            self.set(&mut state, bytes);
        }
        shared.changed.notify_all();
        may
    }

    fn set(&mut self, state: &mut State, bytes: u64) {
        let before = mem::replace(&mut self.bytes, bytes);
        state.reserved = state.reserved - before + bytes;
        self.shared.changed.notify_all();
    }
}

impl Drop for Pass {
    fn drop(&mut self) {
        let mut state = self.shared.lock();
        state.reserved -= self.bytes;
        state.inside -= 1;
        self.shared.changed.notify_all();
    }
}

impl State {
    fn draw(&mut self) -> u64 {
        self.next_number += 1;
        self.next_number
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, state: MutexGuard<'a, State>) -> MutexGuard<'a, State> {
        let waited = self.changed.wait_timeout(state, ASK_EVERY);
        waited.unwrap_or_else(PoisonError::into_inner).0
    }

    fn admit(self: &Arc<Self>, state: &mut State, number: u64, bytes: u64) -> Pass {
        state.reserved += bytes;
        state.inside += 1;
        Pass {
            shared: Arc::clone(self),
            number,
            bytes,
        }
    }
}

#[cfg(test)]
mod tests;
