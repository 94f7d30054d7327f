use proptest::prelude::*;

use super::*;

/// A file at one moment: name, size, time of change, inode.
type Seen = (&'static str, u64, u64, u64);

fn fact((name, size, modified_s, inode): Seen) -> FileFact {
    FileFact {
        path: name.into(),
        stamp: Stamp {
            size,
            modified: SystemTime::UNIX_EPOCH + Duration::from_secs(modified_s),
            identity: (1, inode),
        },
    }
}

/// Runs listings at given seconds past a tracker that wants two seconds, and tells what became ready when.
fn ready_at(listings: &[(u64, &[Seen])]) -> Vec<(u64, String)> {
    let start = Instant::now();
    let mut tracker = StabilityTracker::new(Duration::from_secs(2));
    let mut ready = Vec::new();
    for &(at, seen) in listings {
        let facts: Vec<_> = seen.iter().copied().map(fact).collect();
        let given = tracker.step(start + Duration::from_secs(at), &facts);
        ready.extend(
            given
                .into_iter()
                .map(|file| (at, file.path.display().to_string())),
        );
    }
    ready
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
    let mut tracker = StabilityTracker::new(Duration::from_secs(2));
    let empty = [fact(("a", 0, 100, 1))];
    assert_eq!(tracker.step(start, &empty), []);
    assert_eq!(tracker.step(start + Duration::from_secs(60), &empty), []);
    assert_eq!((tracker.unsettled(), tracker.empty()), (0, 1));
}

#[test]
fn a_file_taken_back_must_hold_still_anew() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = StabilityTracker::new(Duration::from_secs(2));
    tracker.step(start, &[fact(REST)]);
    assert_eq!(tracker.step(after(2), &[fact(REST)]).len(), 1);
    tracker.take_back(after(3), Path::new("a"), fact(REST).stamp);
    assert_eq!(tracker.unsettled(), 1);
    assert_eq!(tracker.step(after(4), &[fact(REST)]), []);
    assert_eq!(tracker.step(after(5), &[fact(REST)]).len(), 1);
}

#[test]
fn a_file_that_has_changed_since_it_was_given_is_not_taken_back() {
    let start = Instant::now();
    let after = |seconds| start + Duration::from_secs(seconds);
    let mut tracker = StabilityTracker::new(Duration::from_secs(2));
    tracker.step(start, &[fact(REST)]);
    tracker.step(after(2), &[fact(REST)]);
    let newer = [fact(("a", 11, 101, 1))];
    tracker.step(after(3), &newer);
    assert_eq!(tracker.step(after(5), &newer).len(), 1);
    tracker.take_back(after(6), Path::new("a"), fact(REST).stamp);
    assert_eq!(tracker.step(after(9), &newer), []);
}

proptest! {
    /// One file, listed every second in a random state: it is given exactly when a run of equal states has
    /// lasted the time, once a run, and never empty.
    #[test]
    fn a_file_is_given_once_for_each_rest_of_the_whole_time(states in prop::collection::vec(0..3_u64, 1..60)) {
        let start = Instant::now();
        let mut tracker = StabilityTracker::new(Duration::from_secs(2));
        let mut run = 0;
        for (at, &size) in states.iter().enumerate() {
            run = if at > 0 && states[at - 1] == size { run + 1 } else { 0 };
            let ready = tracker.step(start + Duration::from_secs(at as u64), &[fact(("a", size, 0, 1))]);
            prop_assert_eq!(ready.len(), usize::from(run == 2 && size > 0));
        }
    }

    /// Files do not disturb each other.
    #[test]
    fn each_file_is_followed_by_itself(states in prop::collection::vec((0..3_u64, 0..3_u64), 1..40)) {
        let start = Instant::now();
        let new = || StabilityTracker::new(Duration::from_secs(2));
        let (mut both, mut alone) = (new(), new());
        for (at, &(a, b)) in states.iter().enumerate() {
            let now = start + Duration::from_secs(at as u64);
            let (a, b) = (fact(("a", a, 0, 1)), fact(("b", b, 0, 2)));
            let of_both = both.step(now, &[b, a.clone()]);
            let of_a: Vec<_> = of_both.into_iter().filter(|file| file.path == Path::new("a")).collect();
            prop_assert_eq!(of_a, alone.step(now, &[a]));
        }
    }
}
