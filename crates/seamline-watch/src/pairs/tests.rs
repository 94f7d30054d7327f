use super::*;
use crate::tracker::Stamp;

const MAX_WAIT: Duration = Duration::from_secs(60);

fn file(path: &str, size: u64) -> ReadyFile {
    ReadyFile {
        path: path.into(),
        stamp: Stamp {
            size,
            modified: (0, 0),
            changed: (0, 0),
            identity: (0, size),
        },
        overdue: false,
    }
}

struct Inbox {
    pairs: Pairs,
    start: Instant,
    there: Vec<ReadyFile>,
}

impl Inbox {
    fn new() -> Self {
        Self {
            pairs: Pairs::default(),
            start: Instant::now(),
            there: Vec::new(),
        }
    }

    fn ready(&mut self, at_s: u64, path: &str, size: u64) -> Vec<Complete> {
        let file = file(path, size);
        self.there.retain(|other| other.path != file.path);
        self.there.push(file.clone());
        self.step(at_s, vec![file], false)
    }

    fn begins_to_change(&mut self, path: &str) {
        self.there.retain(|other| other.path != Path::new(path));
    }

    fn step(&mut self, at_s: u64, ready: Vec<ReadyFile>, nothing_comes: bool) -> Vec<Complete> {
        let now = self.start + Duration::from_secs(at_s);
        let there = self.there.clone();
        self.pairs.step(
            now,
            ready,
            &|file| there.contains(file),
            &|_| MAX_WAIT,
            nothing_comes,
        )
    }
}

fn pair(mesh: (&str, u64), markings: (&str, u64)) -> Vec<Complete> {
    vec![Complete::Pair {
        mesh: file(mesh.0, mesh.1),
        markings: file(markings.0, markings.1),
    }]
}

#[test]
fn a_pair_is_complete_when_its_second_half_holds_still_whichever_that_is() {
    for (first, second) in [("a/part.stl", "a/part.seg"), ("a/part.seg", "a/part.stl")] {
        let mut inbox = Inbox::new();
        assert_eq!(inbox.ready(0, first, 1), []);
        let given = inbox.ready(5, second, 1);
        assert_eq!(given, pair(("a/part.stl", 1), ("a/part.seg", 1)));
        assert_eq!(inbox.step(500, Vec::new(), false), []);
    }
}

#[test]
fn a_half_that_changes_again_keeps_its_pair_waiting() {
    let mut inbox = Inbox::new();
    inbox.ready(0, "part.stl", 1);
    inbox.begins_to_change("part.stl");
    assert_eq!(inbox.ready(3, "part.edges.txt", 1), []);
    let given = inbox.ready(6, "part.stl", 2);
    assert_eq!(given, pair(("part.stl", 2), ("part.edges.txt", 1)));
}

#[test]
fn a_lone_half_is_given_alone_after_the_longest_wait_and_once() {
    for half in ["part.stl", "part.seg"] {
        let mut inbox = Inbox::new();
        inbox.ready(0, half, 1);
        assert_eq!(inbox.step(59, Vec::new(), false), []);
        let given = inbox.step(60, Vec::new(), false);
        assert_eq!(given, [Complete::Lone(file(half, 1))]);
        assert_eq!(inbox.step(999, Vec::new(), false), []);
    }
}

#[test]
fn a_lone_half_is_given_at_once_where_nothing_more_comes() {
    let mut inbox = Inbox::new();
    inbox.ready(0, "part.stl", 1);
    let given = inbox.step(1, Vec::new(), true);
    assert_eq!(given, [Complete::Lone(file("part.stl", 1))]);
}

#[test]
fn new_markings_or_a_new_mesh_make_a_new_pair() {
    let mut inbox = Inbox::new();
    inbox.ready(0, "part.stl", 1);
    inbox.ready(0, "part.seg", 1);
    let other_labels = inbox.ready(9, "part.seg", 2);
    assert_eq!(other_labels, pair(("part.stl", 1), ("part.seg", 2)));
    let other_mesh = inbox.ready(12, "part.stl", 3);
    assert_eq!(other_mesh, pair(("part.stl", 3), ("part.seg", 2)));
}

#[test]
fn a_half_that_is_gone_is_forgotten() {
    let mut inbox = Inbox::new();
    inbox.ready(0, "part.stl", 1);
    inbox.begins_to_change("part.stl");
    assert_eq!(inbox.step(100, Vec::new(), true), []);
}

#[test]
fn names_tell_which_halves_belong_together() {
    let stem_of = |path: &str| stem(Path::new(path));
    for half in ["a/part.stl", "a/part.OBJ", "a/part.seg", "a/part.edges.txt"] {
        assert_eq!(stem_of(half), Path::new("a/part"), "{half}");
    }
    assert_eq!(stem_of("v1.2.stl"), stem_of("v1.2.seg"));
    assert!(markings_in(Path::new("part.txt")).is_none());
    assert_eq!(meshes_of(Path::new("v1.2.SEG"))[0], Path::new("v1.2.stl"));
    assert_eq!(
        beside(Path::new("q/part-1.stl"), Path::new("in/part.edges.txt")),
        Path::new("q/part-1.edges.txt")
    );
}

#[test]
fn a_mesh_with_labels_and_edges_is_told_once_and_paired_when_one_of_them_goes() {
    let mut inbox = Inbox::new();
    inbox.ready(0, "in/part.seg", 1);
    inbox.ready(0, "in/part.edges.txt", 2);
    let mesh = Complete::Crowded(file("in/part.stl", 3));
    assert_eq!(inbox.ready(1, "in/part.stl", 3), [mesh]);
    assert!(inbox.step(100, Vec::new(), true).is_empty());
    inbox.begins_to_change("in/part.stl");
    inbox.begins_to_change("in/part.edges.txt");
    inbox.step(101, Vec::new(), false);
    let both = pair(("in/part.stl", 4), ("in/part.seg", 1));
    assert_eq!(inbox.ready(102, "in/part.stl", 4), both);
}
