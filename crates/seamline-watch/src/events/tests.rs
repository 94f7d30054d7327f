use std::fs;
use std::io::Write;
use std::os::unix::fs::symlink;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::*;
use crate::config::After;
use crate::include::Patterns;
use crate::scan::{Listing, Search};

mod refused;

const LONG: Duration = Duration::from_secs(60);
const SHORT: Duration = Duration::from_millis(300);

fn watched(root: &Path, watcher: Watcher) -> Watched {
    Watched {
        root: root.to_owned(),
        recursive: true,
        include: Patterns::new(&["*"]).unwrap(),
        exclude: Patterns::new::<&str>(&[]).unwrap(),
        stable_for: Duration::from_millis(1),
        max_wait: Duration::from_millis(1),
        watcher,
        poll_every: Duration::from_millis(100),
        after: After::Keep,
    }
}

fn native(root: &Path) -> Events {
    let events = Events::listen(&[watched(root, Watcher::Native)]);
    assert!(!events.is_polled(root));
    events
}

/// Waits until each of these was named, and gives all that were.
fn named(events: &mut Events, wanted: &[&Path]) -> HashSet<PathBuf> {
    let until = Instant::now() + LONG;
    let mut all = HashSet::new();
    while !wanted.iter().all(|path| all.contains(*path)) {
        let woken = events.hints().recv_deadline(until);
        assert!(
            woken.is_ok(),
            "heard of {all:?} and not of all of {wanted:?}"
        );
        for hint in events.take() {
            match hint {
                Hint::Changed(path) => all.insert(path),
                Hint::Everything { .. } => panic!("{hint:?}"),
            };
        }
    }
    all
}

fn nothing_more(events: &mut Events) {
    while events.hints().recv_timeout(SHORT).is_ok() {
        events.take();
    }
}

/// What somebody finds who looks wherever a hint points.
fn files_found(events: &mut Events, wanted: usize) -> (HashSet<PathBuf>, usize) {
    let roots: Vec<PathBuf> = events
        .roots
        .iter()
        .map(|root| root.watched.root.clone())
        .collect();
    let until = Instant::now() + LONG;
    let (mut found, mut wakes) = (HashSet::new(), 0);
    while found.len() < wanted {
        let woken = events.hints().recv_deadline(until);
        assert!(woken.is_ok(), "{} of {wanted}", found.len());
        wakes += 1;
        for hint in events.take() {
            let places = match hint {
                Hint::Changed(path) => vec![path],
                Hint::Everything { .. } => roots.clone(),
            };
            for place in places {
                if place.is_file() {
                    found.insert(place);
                } else if let Ok(listing) = everything(&place) {
                    found.extend(listing.files.into_iter().map(|file| file.path));
                }
            }
        }
    }
    (found, wakes)
}

fn everything(root: &Path) -> std::io::Result<Listing> {
    let [include, exclude] = [&["*"][..], &[]].map(|of| Patterns::new(of).unwrap());
    let search = Search {
        root,
        recursive: true,
        include: &include,
        exclude: &exclude,
        markings: false,
    };
    search.all()
}

/// Is this root polled for no other reason than that it was not there?
fn waits_for(events: &Events, root: &Path) -> bool {
    matches!(events.ear(root), Some(Ear::Waiting))
}

#[test]
fn each_kind_of_change_names_its_path() {
    let [home, elsewhere] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let root = home.path();
    fs::create_dir(root.join("sub")).unwrap();
    let [a, b, inside, outside] =
        ["a.stl", "b.stl", "sub/c.stl", "c.stl"].map(|name| root.join(name));
    let away = elsewhere.path().join("away.stl");
    let mut events = native(root);

    let mut file = fs::File::create(&a).unwrap();
    named(&mut events, &[&a]);
    file.write_all(b"x").unwrap();
    named(&mut events, &[&a]);
    nothing_more(&mut events);
    drop(file);
    named(&mut events, &[&a]);
    fs::rename(&a, &b).unwrap();
    named(&mut events, &[&a, &b]);
    fs::rename(&b, &inside).unwrap();
    named(&mut events, &[&b, &inside]);
    fs::rename(&inside, &away).unwrap();
    assert!(!named(&mut events, &[&inside]).contains(&away));
    fs::rename(&away, &outside).unwrap();
    named(&mut events, &[&outside]);
    nothing_more(&mut events);
    fs::remove_file(&outside).unwrap();
    assert_eq!(named(&mut events, &[&outside]).len(), 1);
}

#[test]
fn reading_and_listing_and_unfinished_names_give_no_hint() {
    let home = tempfile::tempdir().unwrap();
    let part = home.path().join("a/part.stl");
    fs::create_dir_all(home.path().join("a")).unwrap();
    fs::create_dir_all(home.path().join(".trash")).unwrap();
    fs::write(&part, "x").unwrap();
    let mut events = native(home.path());
    fs::read(&part).unwrap();
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 2);
    assert_eq!(fs::read_dir(home.path().join("a")).unwrap().count(), 1);
    fs::write(home.path().join("a/other.stl.part"), "x").unwrap();
    fs::write(home.path().join(".trash/x.stl"), "x").unwrap();
    assert!(events.hints().recv_timeout(SHORT).is_err());
    assert_eq!(events.take(), []);
}

#[test]
fn folders_made_with_files_in_them_are_named_and_then_listened_to() {
    let home = tempfile::tempdir().unwrap();
    let mut events = native(home.path());
    for number in 0..20 {
        let folder = home.path().join(format!("{number}/a/b/c"));
        fs::create_dir_all(&folder).unwrap();
        for file in 0..10 {
            fs::write(folder.join(format!("{file}.stl")), "x").unwrap();
        }
    }
    files_found(&mut events, 200);
    nothing_more(&mut events);
    for number in 0..20 {
        let late = home.path().join(format!("{number}/a/b/c/late.stl"));
        fs::write(&late, "x").unwrap();
        named(&mut events, &[&late]);
    }
}

#[test]
fn a_folder_moved_in_or_within_is_listened_to_under_its_new_name() {
    let [home, elsewhere] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let mut events = native(home.path());
    fs::create_dir_all(elsewhere.path().join("a/b")).unwrap();
    let [here, there] = ["here", "there"].map(|name| home.path().join(name));
    fs::rename(elsewhere.path().join("a"), &here).unwrap();
    named(&mut events, &[&here]);
    fs::rename(&here, &there).unwrap();
    named(&mut events, &[&here, &there]);
    nothing_more(&mut events);
    let part = there.join("b/part.stl");
    fs::write(&part, "x").unwrap();
    assert_eq!(named(&mut events, &[&part]).len(), 1);
}

#[test]
fn links_to_folders_are_not_followed_and_without_recursion_no_folder_is() {
    let [home, elsewhere] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    symlink(elsewhere.path(), home.path().join("link")).unwrap();
    let mut events = native(home.path());
    fs::write(elsewhere.path().join("a.stl"), "x").unwrap();
    assert!(events.hints().recv_timeout(SHORT).is_err());

    let flat = Watched {
        recursive: false,
        ..watched(home.path(), Watcher::Native)
    };
    events.retarget(&[flat]);
    let sub = home.path().join("sub");
    fs::create_dir(&sub).unwrap();
    named(&mut events, &[&sub]);
    nothing_more(&mut events);
    fs::write(sub.join("a.stl"), "x").unwrap();
    assert!(events.hints().recv_timeout(SHORT).is_err());
}

#[test]
fn a_root_that_went_away_is_heard_again_when_it_is_back() {
    let home = tempfile::tempdir().unwrap();
    let root = home.path().join("inbox");
    fs::create_dir_all(root.join("a")).unwrap();
    let watched = watched(&root, Watcher::Auto);
    let mut events = Events::listen(std::slice::from_ref(&watched));
    for leaves_by in [fs::remove_dir_all::<&Path>, |root: &Path| {
        fs::rename(root, root.with_extension("old"))
    }] {
        assert!(!events.is_polled(&root) && !waits_for(&events, &root));
        leaves_by(&root).unwrap();
        named(&mut events, &[&root]);
        nothing_more(&mut events);
        assert!(events.is_polled(&root) && waits_for(&events, &root));

        fs::create_dir_all(root.join("a")).unwrap();
        events.hear_again(&watched);
        let part = root.join("a/part.stl");
        fs::write(&part, "x").unwrap();
        named(&mut events, &[&part]);
    }
}

#[test]
fn a_root_replaced_at_once_is_heard_without_being_asked_for() {
    let home = tempfile::tempdir().unwrap();
    let root = home.path().join("inbox");
    fs::create_dir(&root).unwrap();
    let mut events = native(&root);
    fs::rename(&root, home.path().join("old")).unwrap();
    fs::create_dir(&root).unwrap();
    named(&mut events, &[&root]);
    nothing_more(&mut events);
    assert!(!events.is_polled(&root));
    let part = root.join("part.stl");
    fs::write(&part, "x").unwrap();
    named(&mut events, &[&part]);
}

#[test]
fn a_burst_of_files_loses_none_and_wakes_seldom() {
    const FILES: usize = 20_000;
    let home = tempfile::tempdir().unwrap();
    let mut events = native(home.path());
    for number in 0..FILES {
        fs::File::create(home.path().join(format!("{number}.stl"))).unwrap();
    }
    let (found, wakes) = files_found(&mut events, FILES);
    assert_eq!(found.len(), FILES);
    assert!(wakes < 1000, "{wakes}");
}

#[test]
fn what_overflows_the_queue_of_the_system_is_told_and_new_folders_are_found() {
    let home = tempfile::tempdir().unwrap();
    let mut events = native(home.path());
    let most: usize = fs::read_to_string("/proc/sys/fs/inotify/max_queued_events")
        .unwrap()
        .trim()
        .parse()
        .unwrap();
    let late = home.path().join("a/late.stl");
    let names = ["1.stl", "2.stl"].map(|name| home.path().join(name));
    fs::write(&names[0], "x").unwrap();
    {
        let Ear::Native(listener) = &events.roots[0].ear else {
            panic!("polled");
        };
        // The thread that hears waits, as behind a slow machine, until the queue is full.
        let _deaf = listener.deafen();
        for number in 0..most {
            fs::rename(&names[number % 2], &names[(number + 1) % 2]).unwrap();
        }
        fs::create_dir(late.parent().unwrap()).unwrap();
    }
    let until = Instant::now() + LONG;
    loop {
        assert!(
            events.hints().recv_deadline(until).is_ok(),
            "no overflow was told"
        );
        if events.take().contains(&Hint::Everything { overflow: true }) {
            break;
        }
    }
    nothing_more(&mut events);
    fs::write(&late, "x").unwrap();
    named(&mut events, &[&late]);
}

#[test]
fn polling_and_a_missing_root_are_no_errors() {
    let home = tempfile::tempdir().unwrap();
    let missing = home.path().join("missing");
    let said = said_while(|| {
        let events = Events::listen(&[
            watched(home.path(), Watcher::Poll),
            watched(&missing, Watcher::Auto),
        ]);
        assert!(events.is_polled(home.path()) && !waits_for(&events, home.path()));
        assert!(events.is_polled(&missing) && waits_for(&events, &missing));
        assert!(events.is_polled(Path::new("/never/named")));
    });
    assert_eq!(said, "");
}

#[test]
fn other_roots_are_listened_to_after_a_reload() {
    let [one, two, three] = [(); 3].map(|()| tempfile::tempdir().unwrap());
    let given = [&one, &two, &three].map(|home| watched(home.path(), Watcher::Native));
    let mut events = Events::listen(&given[..2]);
    // Heard and not taken yet: what stays is not begun anew.
    fs::write(two.path().join("early.stl"), "x").unwrap();
    events.retarget(&given[1..]);
    assert!(events.is_polled(one.path()));
    fs::write(one.path().join("a.stl"), "x").unwrap();
    fs::write(three.path().join("a.stl"), "x").unwrap();
    let wanted = [two.path().join("early.stl"), three.path().join("a.stl")];
    let heard = named(&mut events, &[&wanted[0], &wanted[1]]);
    assert_eq!(heard.len(), 2);
}

/// The log lines of this thread.
fn said_while(act: impl FnOnce()) -> String {
    let lines = Arc::new(Mutex::new(Vec::new()));
    let to = Arc::clone(&lines);
    let subscriber = tracing_subscriber::fmt()
        .with_ansi(false)
        .with_writer(move || Lines(Arc::clone(&to)))
        .finish();
    tracing::subscriber::with_default(subscriber, act);
    String::from_utf8(lines.lock().unwrap().clone()).unwrap()
}

struct Lines(Arc<Mutex<Vec<u8>>>);

impl Write for Lines {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
