use std::fs;

use super::*;

const SETTINGS: &str = "s1";

struct Home {
    folder: tempfile::TempDir,
    ledger: Ledger,
}

impl Home {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self {
            ledger: Ledger::open(folder.path()).unwrap(),
            folder,
        }
    }

    fn take_in(&mut self, path: &str, stamp: &str) -> TakenIn {
        self.take_in_with(path, stamp, SETTINGS)
    }

    fn take_in_with(&mut self, path: &str, stamp: &str, settings: &str) -> TakenIn {
        let arrival = Arrival {
            path: Path::new(path),
            markings: None,
            relative: Path::new(path),
            stamp,
        };
        self.ledger.take_in(&[arrival], settings).unwrap().remove(0)
    }

    fn queue(&mut self, path: &str, stamp: &str) -> JobId {
        match self.take_in(path, stamp) {
            TakenIn::Queue { id, .. } => id,
            other => panic!("{other:?}"),
        }
    }

    /// A job that has come to its end.
    fn done(&mut self, path: &str, stamp: &str, content: &str) -> (JobId, Vec<PathBuf>) {
        let id = self.queue(path, stamp);
        self.ledger.begin(id, SETTINGS).unwrap();
        let result = format!("out/{path}");
        let stranded = self.ledger.done(id, content, Path::new(&result)).unwrap();
        (id, stranded)
    }

    fn reader(&self) -> Reader {
        Reader::open(self.folder.path()).unwrap()
    }

    fn row(&self, id: JobId) -> Row {
        let rows = self.reader().rows().unwrap();
        rows.into_iter().find(|row| row.id == id).unwrap()
    }

    fn reopen(self) -> Self {
        drop(self.ledger);
        Self {
            ledger: Ledger::open(self.folder.path()).unwrap(),
            folder: self.folder,
        }
    }
}

fn fault(of_content: bool) -> Fault {
    Fault {
        stage: "read".to_owned(),
        message: "line 3: not a number".to_owned(),
        hint: "export it again".to_owned(),
        of_content,
    }
}

#[test]
fn a_job_goes_from_pending_to_done() {
    let mut home = Home::new();
    let id = home.queue("a", "1");
    assert_eq!(home.row(id).state, JobState::Pending);
    assert_eq!(home.ledger.begin(id, SETTINGS).unwrap(), 1);
    assert_eq!(home.row(id).state, JobState::Running);
    assert_eq!(home.take_in("a", "1"), TakenIn::Running);
    home.ledger.done(id, "c1", Path::new("out/a")).unwrap();
    let row = home.row(id);
    assert_eq!((row.state, row.attempts), (JobState::Done, 1));
    assert_eq!(row.result, Some(PathBuf::from("out/a")));
    assert!(row.queued_at <= row.started_at.unwrap() && row.started_at <= row.ended_at);
    assert_eq!(home.take_in("a", "1"), TakenIn::Done(id));
}

#[test]
fn names_need_not_be_text() {
    use std::os::unix::ffi::OsStrExt;
    let mut home = Home::new();
    let name = Path::new(std::ffi::OsStr::from_bytes(b"\xff\n.stl"));
    let arrival = Arrival {
        path: name,
        markings: None,
        relative: name,
        stamp: "1",
    };
    home.ledger.take_in(&[arrival], SETTINGS).unwrap();
    assert_eq!(home.reader().rows().unwrap()[0].path, name);
}

#[test]
fn a_pending_job_whose_file_changed_keeps_its_row_and_counts_anew() {
    let mut home = Home::new();
    let id = home.queue("a", "1");
    home.ledger.begin(id, SETTINGS).unwrap();
    home.ledger.postpone(id, &fault(false), true).unwrap();
    assert_eq!(
        (home.row(id).attempts, home.row(id).state),
        (1, JobState::Pending)
    );
    assert_eq!(home.queue("a", "2"), id);
    assert_eq!(home.row(id).attempts, 0);
}

#[test]
fn new_content_under_an_old_name_is_a_new_job() {
    let mut home = Home::new();
    let (first, _) = home.done("a", "1", "c1");
    let (second, stranded) = home.done("a", "2", "c2");
    assert_ne!(first, second);
    assert_eq!((home.row(first).result, stranded.len()), (None, 0));
}

#[test]
fn done_work_is_done_again_under_other_settings_only() {
    let mut home = Home::new();
    let (id, _) = home.done("a", "1", "c1");
    assert_eq!(home.take_in("a", "1"), TakenIn::Done(id));
    assert!(
        matches!(home.take_in_with("a", "1", "s2"), TakenIn::Queue { id: other, .. } if other != id)
    );
}

#[test]
fn bytes_that_were_cut_are_known_under_the_same_settings_only() {
    let mut home = Home::new();
    let (holder, _) = home.done("a", "1", "c1");
    let [path, result] = ["a", "out/a"].map(PathBuf::from);
    let known = |settings| home.reader().known("c1", settings, Path::new("b")).unwrap();
    assert_eq!(
        known(SETTINGS),
        Some(Known::Done {
            holder,
            path,
            result
        })
    );
    assert_eq!(known("s2"), None);
    assert_eq!(
        home.reader().known("c2", SETTINGS, Path::new("b")).unwrap(),
        None
    );
}

#[test]
fn bytes_at_fault_are_known_and_failing_disks_are_not() {
    let mut home = Home::new();
    for (path, of_content) in [("a", true), ("b", false)] {
        let id = home.queue(path, "1");
        home.ledger.begin(id, SETTINGS).unwrap();
        home.ledger
            .quarantine(id, Some(path), &fault(of_content))
            .unwrap();
    }
    assert_eq!(
        home.reader().known("a", SETTINGS, Path::new("c")).unwrap(),
        Some(Known::Bad(fault(true)))
    );
    assert_eq!(
        home.reader().known("b", SETTINGS, Path::new("c")).unwrap(),
        None
    );
}

#[test]
fn a_touched_file_takes_over_the_results_of_its_own_content() {
    let mut home = Home::new();
    let (first, _) = home.done("a", "1", "c1");
    let (copy, touched) = (home.queue("b", "1"), home.queue("a", "2"));
    assert!(home.ledger.same_content(copy, "c1", first).unwrap());
    assert!(home.ledger.same_content(touched, "c1", first).unwrap());
    assert!(!home.ledger.same_content(copy, "c1", first).unwrap());
    assert_eq!(home.row(first).result, None);
    assert_eq!(home.row(touched).result, Some(PathBuf::from("out/a")));
    assert_eq!(
        (home.row(touched).same_as, home.row(copy).same_as),
        (None, Some(touched))
    );
}

#[test]
fn files_of_the_same_content_as_replaced_results_are_named() {
    let mut home = Home::new();
    let (holder, _) = home.done("a", "1", "c1");
    let copy = home.queue("b", "1");
    home.ledger.begin(copy, SETTINGS).unwrap();
    assert!(home.ledger.same_content(copy, "c1", holder).unwrap());
    assert_eq!(home.take_in("b", "1"), TakenIn::Done(copy));
    let (_, stranded) = home.done("a", "2", "c2");
    assert_eq!(stranded, [PathBuf::from("b")]);
    assert!(matches!(home.take_in("b", "1"), TakenIn::Queue { .. }));
}

#[test]
fn what_a_crash_left_running_is_pending_again_until_it_was_begun_too_often() {
    let mut home = Home::new();
    let id = home.queue("a", "1");
    for attempt in 1..=3 {
        assert_eq!(home.ledger.begin(id, SETTINGS).unwrap(), attempt);
        home = home.reopen();
        let expected = if attempt < 3 { (1, 0) } else { (0, 1) };
        assert_eq!(home.ledger.recover().unwrap(), expected);
    }
    let row = home.row(id);
    assert_eq!(row.state, JobState::Quarantined);
    assert!(row.message.unwrap().contains("3 times"));
    assert!(matches!(home.take_in("a", "1"), TakenIn::Quarantined(_)));
}

#[test]
fn what_ran_beside_others_in_a_crash_is_suspected_and_not_given_up() {
    let mut home = Home::new();
    let ids = [home.queue("a", "1"), home.queue("b", "1")];
    for _ in 0..10 {
        for id in ids {
            home.ledger.begin(id, SETTINGS).unwrap();
        }
        home = home.reopen();
        assert_eq!(home.ledger.recover().unwrap(), (2, 0));
        assert_eq!(
            home.take_in("a", "1"),
            TakenIn::Queue {
                id: ids[0],
                suspicion: 1
            }
        );
    }
    assert_eq!(
        home.take_in("a", "2"),
        TakenIn::Queue {
            id: ids[0],
            suspicion: 0
        }
    );
    assert_eq!(
        home.take_in("a", "2"),
        TakenIn::Queue {
            id: ids[0],
            suspicion: 0
        }
    );
}

#[test]
fn what_was_not_begun_in_earnest_does_not_count_as_an_attempt() {
    let mut home = Home::new();
    let id = home.queue("a", "1");
    for _ in 0..10 {
        assert_eq!(home.ledger.begin(id, SETTINGS).unwrap(), 1);
        home.ledger.put_back(id).unwrap();
    }
}

#[test]
fn another_process_that_writes_is_noticed() {
    let mut home = Home::new();
    let path = home.folder.path().join("a");
    let (id, _) = home.done(path.to_str().unwrap(), "1", "c1");
    assert!(!home.ledger.changed_elsewhere().unwrap());
    let source = home.folder.path().join("source");
    fs::write(&source, "x").unwrap();
    home.ledger.settled(id, &source).unwrap();
    let put_back = requeue(home.folder.path(), Some(&[id])).unwrap();
    let back = put_back[0].1.as_ref().unwrap().clone();
    assert!(back.exists() && !source.exists());
    assert!(home.ledger.changed_elsewhere().unwrap());
    assert!(!home.ledger.changed_elsewhere().unwrap());
    assert_eq!(home.ledger.pending().unwrap(), [(id, back)]);
}

#[test]
fn a_job_that_is_unknown_or_waits_is_not_put_back() {
    let mut home = Home::new();
    let id = home.queue("a", "1");
    let put_back = requeue(home.folder.path(), Some(&[id, JobId(77)])).unwrap();
    assert_eq!(
        put_back[0].1.as_ref().unwrap_err().to_string(),
        "job 1 is pending already"
    );
    assert_eq!(
        put_back[1].1.as_ref().unwrap_err().to_string(),
        "there is no job 77"
    );
}

#[test]
fn a_folder_without_a_ledger_and_a_newer_ledger_are_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let none = Reader::open(folder.path()).err().unwrap();
    assert!(none.to_string().starts_with("there is no ledger at"));
    let ledger = Ledger::open(folder.path()).unwrap();
    ledger
        .connection
        .pragma_update(None, "user_version", 9)
        .unwrap();
    drop(ledger);
    let newer = Ledger::open(folder.path()).err().unwrap();
    assert!(newer.to_string().contains("form 9"));
    fs::write(
        folder.path().join(FILE_NAME),
        "no database at all, but long enough to look like one",
    )
    .unwrap();
    let broken = Ledger::open(folder.path()).err().unwrap();
    assert!(!broken.may_pass() && broken.hint().contains("move it away"));
}

#[test]
fn a_job_that_was_followed_by_other_content_does_not_wait_again() {
    let mut home = Home::new();
    for back in [
        |home: &mut Home, id| home.ledger.put_back(id),
        |home: &mut Home, id| home.ledger.postpone(id, &fault(false), true),
    ] {
        let old = home.queue("a", "1");
        home.ledger.begin(old, SETTINGS).unwrap();
        let new = home.queue("a", "2");
        assert_ne!(old, new);
        assert!(!back(&mut home, old).unwrap());
        assert_eq!(home.row(old).state, JobState::Gone);
        home.ledger.begin(new, SETTINGS).unwrap();
        assert!(back(&mut home, new).unwrap());
        assert_eq!(home.row(new).state, JobState::Pending);
        home.ledger.gone(new).unwrap();
    }
    let old = home.queue("a", "3");
    home.ledger.begin(old, SETTINGS).unwrap();
    let new = home.queue("a", "4");
    let mut home = home.reopen();
    home.ledger.recover().unwrap();
    assert_eq!(home.row(old).state, JobState::Gone);
    assert_eq!(home.row(new).state, JobState::Pending);
}

#[test]
fn of_what_waits_only_what_is_watched_counts_as_oldest() {
    let mut home = Home::new();
    let oldest = |home: &Home, root: &str| {
        let watched = |path: &Path| path.starts_with(root);
        home.ledger.oldest_pending(watched).unwrap()
    };
    assert_eq!(oldest(&home, "/"), None);
    let first = home.queue("/in/a", "1");
    std::thread::sleep(Duration::from_millis(5));
    let second = home.queue("/other/a", "1");
    let [first, second] = [first, second].map(|id| Some(home.row(id).queued_at));
    assert!(first < second);
    assert_eq!(oldest(&home, "/"), first);
    assert_eq!(oldest(&home, "/other"), second);
    assert_eq!(oldest(&home, "/nowhere"), None);
}

#[test]
fn the_version_changes_with_every_change_and_with_nothing_else() {
    let mut home = Home::new();
    let new = home.ledger.version().unwrap();
    home.ledger.counts().unwrap();
    assert_eq!(home.ledger.version().unwrap(), new);
    let id = home.queue("a", "1");
    let queued = home.ledger.version().unwrap();
    assert_ne!(queued, new);
    let other = Connection::open(home.folder.path().join(FILE_NAME)).unwrap();
    other
        .execute("UPDATE jobs SET state = 'gone' WHERE id = ?1", [id.0])
        .unwrap();
    assert_ne!(home.ledger.version().unwrap(), queued);
}

#[test]
fn a_job_has_ended_for_the_state_of_its_file_and_its_settings_only() {
    let mut home = Home::new();
    let ended = |home: &Home, path: &str, stamp: &str, settings: &str| {
        home.reader()
            .has_ended(Path::new(path), stamp, settings)
            .unwrap()
    };
    home.done("a", "1", "x");
    let bad = home.queue("bad", "1");
    home.ledger.begin(bad, SETTINGS).unwrap();
    assert!(!ended(&home, "bad", "1", SETTINGS));
    home.ledger.quarantine(bad, None, &fault(true)).unwrap();
    home.queue("waits", "1");
    assert!(ended(&home, "a", "1", SETTINGS) && ended(&home, "bad", "1", SETTINGS));
    for (path, stamp, settings) in [
        ("a", "2", SETTINGS),
        ("a", "1", "s2"),
        ("waits", "1", SETTINGS),
        ("unknown", "1", SETTINGS),
    ] {
        assert!(!ended(&home, path, stamp, settings), "{path}");
    }
}
