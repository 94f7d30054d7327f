use proptest::prelude::*;

use super::*;

/// A file at one moment: name, size, time of change, inode.
type Seen = (&'static str, u64, i64, u64);

fn fact((name, size, modified_s, inode): Seen) -> FileFact {
    FileFact {
        path: name.into(),
        stamp: Stamp {
            size,
            modified: (modified_s, 0),
            changed: (0, 0),
            identity: (1, inode),
        },
    }
}

#[test]
fn a_file_that_never_holds_still_is_given_up_after_the_longest_wait_and_no_other_is() {
    let start = Instant::now();
    let mut tracker = tracker();
    let longest = 60;
    let mut ready = Vec::new();
    for at in 0..=longest {
        let now = start + Duration::from_secs(at);
        let mut seen = vec![fact(("growing", 1 + at, 0, 1))];
        if at + 1 >= longest {
            seen.push(fact(("late", 1, 0, 2)));
        }
        ready.extend(tracker.step(now, Facts::All(&seen)));
        let given_up = tracker.give_up(now);
        assert_eq!(given_up.len(), usize::from(at == longest), "{at}");
    }
    assert!(ready.is_empty() && tracker.is_settling());
    let later = start + Duration::from_secs(longest + 2);
    let still = fact(("growing", 1 + longest, 0, 1));
    let late = fact(("late", 1, 0, 2));
    let given = tracker.step(later, Facts::All(&[still, late]));
    assert_eq!(given.len(), 1);
    assert_eq!(given[0].path, Path::new("late"));
}

/// Runs listings at given seconds past a tracker that wants two seconds, and tells what became ready when.
fn ready_at(listings: &[(u64, &[Seen])]) -> Vec<(u64, String)> {
    let start = Instant::now();
    let mut tracker = tracker();
    let mut ready = Vec::new();
    for &(at, seen) in listings {
        let facts: Vec<_> = seen.iter().copied().map(fact).collect();
        let given = tracker.step(start + Duration::from_secs(at), Facts::All(&facts));
        ready.extend(
            given
                .into_iter()
                .map(|file| (at, file.path.display().to_string())),
        );
    }
    ready
}

fn tracker() -> StabilityTracker {
    StabilityTracker::new(Duration::from_secs(2), Duration::from_secs(60))
}

fn once(at: u64, name: &str) -> Vec<(u64, String)> {
    vec![(at, name.to_owned())]
}

const REST: Seen = ("a", 10, 100, 1);

#[test]
fn a_file_that_holds_still_is_given_once() {
    assert_eq!(
        ready_at(&[
            (0, &[REST]),
            (1, &[REST]),
            (2, &[REST]),
            (3, &[REST]),
            (9, &[REST])
        ]),
        once(2, "a")
    );
}

#[test]
fn a_growing_file_waits_for_its_last_byte() {
    let listings: [(u64, &[Seen]); 5] = [
        (0, &[("a", 1, 100, 1)]),
        (1, &[("a", 2, 101, 1)]),
        (2, &[("a", 3, 102, 1)]),
        (3, &[("a", 3, 102, 1)]),
        (4, &[("a", 3, 102, 1)]),
    ];
    assert_eq!(ready_at(&listings), once(4, "a"));
}

#[test]
fn a_writer_that_pauses_starts_the_wait_anew() {
    let listings: [(u64, &[Seen]); 5] = [
        (0, &[("a", 5, 100, 1)]),
        (1, &[("a", 5, 100, 1)]),
        (2, &[("a", 9, 102, 1)]),
        (3, &[("a", 9, 102, 1)]),
        (4, &[("a", 9, 102, 1)]),
    ];
    assert_eq!(ready_at(&listings), once(4, "a"));
}

#[test]
fn a_file_written_in_place_with_the_same_size_starts_the_wait_anew() {
    let rewritten: Seen = ("a", 10, 101, 1);
    assert_eq!(
        ready_at(&[
            (0, &[REST]),
            (1, &[rewritten]),
            (2, &[rewritten]),
            (3, &[rewritten])
        ]),
        once(3, "a")
    );
}

#[test]
fn a_truncated_file_is_given_again_when_it_has_content_again() {
    let cut: Seen = ("a", 0, 105, 1);
    let filled: Seen = ("a", 7, 106, 1);
    let ready = ready_at(&[
        (0, &[REST]),
        (2, &[REST]),
        (5, &[cut]),
        (9, &[cut]),
        (10, &[filled]),
        (12, &[filled]),
    ]);
    assert_eq!(ready, [(2, "a".to_owned()), (12, "a".to_owned())]);
}

#[test]
fn another_file_renamed_into_the_place_is_a_new_file() {
    let other: Seen = ("a", 10, 100, 2);
    let ready = ready_at(&[(0, &[REST]), (2, &[REST]), (3, &[other]), (5, &[other])]);
    assert_eq!(ready, [(2, "a".to_owned()), (5, "a".to_owned())]);
}

#[test]
fn a_time_of_change_in_the_future_is_as_good_as_any() {
    let future: Seen = ("a", 10, 99_999_999_999, 1);
    assert_eq!(
        ready_at(&[(0, &[future]), (2, &[future]), (4, &[future])]),
        once(2, "a")
    );
}

#[test]
fn a_file_that_was_deleted_and_came_back_is_given_again() {
    let ready = ready_at(&[
        (0, &[REST]),
        (2, &[REST]),
        (3, &[]),
        (4, &[REST]),
        (6, &[REST]),
    ]);
    assert_eq!(ready, [(2, "a".to_owned()), (6, "a".to_owned())]);
}

#[test]
fn an_empty_file_waits_and_does_not_count_as_unsettled() {
    let start = Instant::now();
    let mut tracker = tracker();
    let empty = [fact(("a", 0, 100, 1))];
    assert_eq!(tracker.step(start, Facts::All(&empty)), []);
    assert_eq!(
        tracker.step(start + Duration::from_secs(60), Facts::All(&empty)),
        []
    );
    assert_eq!((tracker.unsettled().count(), tracker.empty()), (0, 1));
}

#[test]
fn a_file_taken_back_must_hold_still_anew() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = tracker();
    tracker.step(start, Facts::All(&[fact(REST)]));
    assert_eq!(tracker.step(after(2), Facts::All(&[fact(REST)])).len(), 1);
    tracker.take_back(after(3), Path::new("a"), fact(REST).stamp);
    assert_eq!(tracker.unsettled().count(), 1);
    assert_eq!(tracker.step(after(4), Facts::All(&[fact(REST)])), []);
    assert_eq!(tracker.step(after(5), Facts::All(&[fact(REST)])).len(), 1);
}

#[test]
fn a_file_that_has_changed_since_it_was_given_is_not_taken_back() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = tracker();
    tracker.step(start, Facts::All(&[fact(REST)]));
    tracker.step(after(2), Facts::All(&[fact(REST)]));
    let newer = [fact(("a", 11, 101, 1))];
    tracker.step(after(3), Facts::All(&newer));
    assert_eq!(tracker.step(after(5), Facts::All(&newer)).len(), 1);
    tracker.take_back(after(6), Path::new("a"), fact(REST).stamp);
    assert_eq!(tracker.step(after(9), Facts::All(&newer)), []);
}

#[test]
fn a_file_that_ends_early_is_given_again_as_overdue_after_the_longest_wait() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = tracker();
    let here = [fact(REST)];
    tracker.step(start, Facts::All(&here));
    assert!(!tracker.step(after(2), Facts::All(&here))[0].overdue);
    tracker.ends_early(Path::new("a"), here[0].stamp);
    assert!(!tracker.is_settling());
    assert_eq!(tracker.next_ready(), Some(after(60)));
    assert_eq!(tracker.step(after(59), Facts::All(&here)), []);
    assert!(tracker.step(after(60), Facts::All(&here))[0].overdue);
    assert_eq!(tracker.step(after(200), Facts::All(&here)), []);
}

#[test]
fn a_file_that_ended_early_and_grew_is_given_as_soon_as_it_holds_still() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = tracker();
    tracker.step(start, Facts::All(&[fact(REST)]));
    tracker.step(after(2), Facts::All(&[fact(REST)]));
    tracker.ends_early(Path::new("a"), fact(REST).stamp);
    let grown = [fact(("a", 20, 103, 1))];
    assert_eq!(tracker.step(after(3), Facts::All(&grown)), []);
    let ready = tracker.step(after(5), Facts::All(&grown));
    assert_eq!((ready.len(), ready[0].overdue), (1, false));
}

#[test]
fn a_look_at_some_files_leaves_the_others_as_they_were() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = tracker();
    tracker.step(start, Facts::All(&[fact(REST), fact(("b", 5, 100, 2))]));
    let grown = [fact(("b", 6, 101, 2))];
    let some = Facts::Some {
        found: &grown,
        gone: &[],
    };
    assert_eq!(tracker.step(after(1), some), []);
    let nothing = Facts::Some {
        found: &[],
        gone: &[],
    };
    assert_eq!(tracker.step(after(2), nothing)[0].path, Path::new("a"));
    assert_eq!(tracker.step(after(3), nothing)[0].path, Path::new("b"));
}

#[test]
fn with_a_folder_goes_all_that_was_below_it_and_nothing_beside_it() {
    let start = Instant::now();
    let mut tracker = tracker();
    let names = ["d", "d-1/x", "d/x", "d/y/z", "da"];
    tracker.step(start, Facts::All(&names.map(|name| fact((name, 1, 1, 1)))));
    let gone = ["d".into()];
    tracker.step(
        start,
        Facts::Some {
            found: &[],
            gone: &gone,
        },
    );
    let left: Vec<_> = names
        .into_iter()
        .filter(|name| tracker.knows(Path::new(name)))
        .collect();
    assert_eq!(left, ["d-1/x", "da"]);
    assert_eq!(tracker.unsettled().count(), 2);
}

#[test]
fn a_file_looked_at_again_is_given_again() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = tracker();
    tracker.step(start, Facts::All(&[fact(REST)]));
    tracker.step(after(2), Facts::All(&[fact(REST)]));
    tracker.look_again(after(5), Path::new("a"));
    tracker.look_again(after(5), Path::new("unknown"));
    assert_eq!(tracker.step(after(7), Facts::All(&[fact(REST)])).len(), 1);
}

proptest! {
    /// One file, listed every second in a random state: it is given exactly when a run of equal states has
    /// lasted the time, once a run, and never empty.
    #[test]
    fn a_file_is_given_once_for_each_rest_of_the_whole_time(states in prop::collection::vec(0..3_u64, 1..60)) {
        let start = Instant::now();
        let mut tracker = tracker();
        let mut run = 0;
        for (at, &size) in states.iter().enumerate() {
            run = if at > 0 && states[at - 1] == size { run + 1 } else { 0 };
            let ready = tracker.step(start + Duration::from_secs(at as u64), Facts::All(&[fact(("a", size, 0, 1))]));
            prop_assert_eq!(ready.len(), usize::from(run == 2 && size > 0));
        }
    }

    /// Files do not disturb each other.
    #[test]
    fn each_file_is_followed_by_itself(states in prop::collection::vec((0..3_u64, 0..3_u64), 1..40)) {
        let start = Instant::now();
        let new = || tracker();
        let (mut both, mut alone) = (new(), new());
        for (at, &(a, b)) in states.iter().enumerate() {
            let now = start + Duration::from_secs(at as u64);
            let (a, b) = (fact(("a", a, 0, 1)), fact(("b", b, 0, 2)));
            let of_both = both.step(now, Facts::All(&[b, a.clone()]));
            let of_a: Vec<_> = of_both.into_iter().filter(|file| file.path == Path::new("a")).collect();
            prop_assert_eq!(of_a, alone.step(now, Facts::All(&[a])));
        }
    }
}
