use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::channel;
use std::thread;
use std::time::Instant;

use proptest::prelude::*;

use super::*;

const NEVER: &dyn Fn() -> bool = &|| false;

fn entered(gate: &Gate, bytes: u64) -> Pass {
    gate.enter(bytes, NEVER).unwrap().unwrap()
}

/// Waits until the gate looks like this inside.
fn until(gate: &Gate, is: impl Fn(&State) -> bool) {
    let started = Instant::now();
    while !is(&gate.shared.lock()) {
        assert!(started.elapsed() < Duration::from_secs(20), "{gate:?}");
        thread::yield_now();
    }
}

#[test]
fn shares_are_given_out_and_come_back() {
    let gate = Gate::new(100);
    let mut first = gate.try_enter(60).unwrap().unwrap();
    assert!(gate.try_enter(41).unwrap().is_none());
    let second = entered(&gate, 40);
    assert_eq!((gate.reserved(), gate.limit()), (100, 100));
    drop(second);
    assert!(first.resize(100, NEVER).unwrap());
    assert!(first.resize(10, NEVER).unwrap());
    assert_eq!((gate.reserved(), first.bytes), (10, 10));
    drop(first);
    assert_eq!(gate.reserved(), 0);
}

#[test]
fn what_never_fits_is_refused_and_changes_nothing() {
    let gate = Gate::new(100 << 20);
    let needs = 150 << 20;
    let limit = 100 << 20;
    let error = gate.enter(needs, NEVER).unwrap_err();
    assert_eq!(error, TooLarge { needs, limit });
    assert_eq!(gate.try_enter(needs).unwrap_err(), error);
    assert_eq!(
        error.to_string(),
        "needs about 150 MiB of memory, and meshes have 100 MiB, three quarters of the limit"
    );
    let mut pass = entered(&gate, 5);
    assert_eq!(pass.resize(needs, NEVER), Err(error));
    assert_eq!((pass.bytes, gate.reserved()), (5, 5));
    assert!(gate.try_enter(u64::MAX).is_err());
}

#[test]
fn a_large_one_is_not_overtaken_by_small_ones() {
    let gate = Gate::new(100);
    let (say, said) = channel();
    let first = entered(&gate, 50);
    thread::scope(|scope| {
        let large = (say.clone(), gate.clone());
        scope.spawn(move || {
            let _pass = entered(&large.1, 80);
            large.0.send("large").unwrap();
        });
        until(&gate, |state| state.waiting.len() == 1);
        assert!(gate.try_enter(1).unwrap().is_none());
        let small = gate.clone();
        scope.spawn(move || {
            let _pass = entered(&small, 30);
            say.send("small").unwrap();
        });
        until(&gate, |state| state.waiting.len() == 2);
        thread::sleep(Duration::from_millis(120));
        assert!(said.try_recv().is_err() && gate.is_waited_for());
        drop(first);
        assert_eq!(said.recv(), Ok("large"));
        assert_eq!(said.recv(), Ok("small"));
    });
    assert!(!gate.is_waited_for());
    assert_eq!(gate.reserved(), 0);
}

#[test]
fn who_is_told_to_stop_leaves_the_way_to_the_next() {
    let gate = Gate::new(100);
    let mut first = entered(&gate, 50);
    let stop = AtomicBool::new(false);
    thread::scope(|scope| {
        let gives_up = scope.spawn(|| gate.enter(80, &|| stop.load(Ordering::Relaxed)));
        until(&gate, |state| state.waiting.len() == 1);
        let next = scope.spawn(|| entered(&gate, 50));
        until(&gate, |state| state.waiting.len() == 2);
        stop.store(true, Ordering::Relaxed);
        assert!(gives_up.join().unwrap().unwrap().is_none());
        let next = next.join().unwrap();
        assert!(!first.resize(60, &|| true).unwrap());
        assert_eq!((first.bytes, next.bytes), (50, 50));
    });
    assert!(gate.shared.lock().growing.is_empty());
}

#[test]
fn one_who_grows_waits_for_room_and_goes_before_those_who_come() {
    let gate = Gate::new(100);
    let [mut first, second] = [entered(&gate, 40), entered(&gate, 60)];
    let (say, said) = channel();
    thread::scope(|scope| {
        scope.spawn(|| {
            assert!(first.resize(100, NEVER).unwrap());
            say.send(("grown", gate.reserved())).unwrap();
            drop(first);
        });
        until(&gate, |state| state.growing.len() == 1);
        let later = (say.clone(), gate.clone());
        scope.spawn(move || {
            let _pass = entered(&later.1, 10);
            later.0.send(("in", later.1.reserved())).unwrap();
        });
        until(&gate, |state| state.waiting.len() == 1);
        drop(second);
        assert_eq!(said.recv(), Ok(("grown", 100)));
        assert_eq!(said.recv(), Ok(("in", 10)));
    });
}

#[test]
fn two_that_both_wait_to_grow_do_not_wait_for_ever() {
    let gate = Gate::new(100);
    let passes = [(); 3].map(|()| entered(&gate, 33));
    let most = AtomicU64::new(0);
    thread::scope(|scope| {
        for mut pass in passes {
            scope.spawn(|| {
                assert!(pass.resize(100, NEVER).unwrap());
                most.fetch_max(gate.reserved(), Ordering::Relaxed);
                drop(pass);
            });
        }
    });
    // Beyond the limit by the shares of the two others, and no further.
    assert_eq!(most.into_inner(), 166);
    assert_eq!(gate.reserved(), 0);
}

#[test]
fn another_limit_serves_from_then_on() {
    let gate = Gate::new(100);
    let pass = entered(&gate, 100);
    thread::scope(|scope| {
        let waits = scope.spawn(|| entered(&gate, 50));
        until(&gate, |state| state.waiting.len() == 1);
        gate.set_limit(150);
        drop(waits.join().unwrap());
        let refused = scope.spawn(|| gate.enter(120, NEVER));
        until(&gate, |state| state.waiting.len() == 1);
        gate.set_limit(110);
        let error = refused.join().unwrap().unwrap_err();
        assert_eq!((error.needs, error.limit), (120, 110));
    });
    gate.set_limit(10);
    assert!(gate.try_enter(1).unwrap().is_none());
    drop(pass);
    assert!(gate.try_enter(1).unwrap().is_some());
}

#[test]
fn a_panic_gives_back_what_it_held() {
    let gate = Gate::new(100);
    let inside = gate.clone();
    let ended = thread::spawn(move || {
        let _pass = entered(&inside, 100);
        panic!("as a plugin might");
    });
    assert!(ended.join().is_err());
    assert_eq!(gate.reserved(), 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn without_growing_the_limit_holds_and_all_get_in(
        limit in 1u64..50,
        jobs in proptest::collection::vec(proptest::collection::vec(0u64..50, 0..20), 1..6),
    ) {
        let (gate, held) = (&Gate::new(limit), &AtomicU64::new(0));
        thread::scope(|scope| {
            for jobs in &jobs {
                scope.spawn(move || {
                    for &bytes in jobs {
                        let Ok(Some(mut pass)) = gate.enter(bytes, NEVER) else {
                            assert!(bytes > limit);
                            continue;
                        };
                        assert!(held.fetch_add(bytes, Ordering::SeqCst) + bytes <= limit);
                        thread::yield_now();
                        held.fetch_sub(bytes, Ordering::SeqCst);
                        assert!(pass.resize(bytes / 2, NEVER).unwrap());
                    }
                });
            }
        });
        prop_assert_eq!(gate.reserved(), 0);
    }

    #[test]
    fn with_growing_all_end(
        limit in 1u64..50,
        jobs in proptest::collection::vec(proptest::collection::vec((0u64..50, 0u64..60), 0..20), 1..6),
    ) {
        let gate = &Gate::new(limit);
        thread::scope(|scope| {
            for jobs in &jobs {
                scope.spawn(move || {
                    for &(bytes, then) in jobs {
                        if let Ok(Some(mut pass)) = gate.enter(bytes, NEVER) {
                            let fits = then <= limit || then <= bytes;
                            assert_eq!(pass.resize(then, NEVER).is_ok(), fits);
                        }
                    }
                });
            }
        });
        prop_assert_eq!(gate.reserved(), 0);
    }
}
