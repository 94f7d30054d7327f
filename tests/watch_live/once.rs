//! Runs that have an end.

use std::fs::File;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use seamline_tests::daemon::{Home, cuboid};
use seamline_tests::run;

#[test]
fn once_and_dry_run() {
    let home = Home::with("stable_for_ms = 100\n");
    home.drop("a/box.obj", cuboid(1.0));
    home.drop("other.obj", cuboid(2.0));
    home.drop("empty.obj", "");
    let told = run(home.watch().arg("--dry-run")).ended(0);
    assert!(
        told.out.contains("a/box.obj") && told.out.contains("other.obj"),
        "{told:#?}"
    );
    assert!(!told.out.contains("empty.obj"), "{told:#?}");
    for folder in ["out", "quarantine", "state", "done"] {
        assert!(!home.at(folder).exists(), "{folder}");
    }

    home.once().ended(0);
    assert_eq!(home.labels("a/box.obj"), 6);
    assert_eq!(home.labels("other.obj"), 6);
    let status = home.status();
    assert_eq!(status.count("done"), 2, "{status:#?}");
    assert!(!status.daemon.running);

    // What is done would not be done again, and is not.
    let told = run(home.watch().arg("--dry-run")).ended(0);
    assert_eq!(told.out, "");
    let written = || {
        home.result("other.obj")
            .join("report.json")
            .metadata()
            .unwrap()
            .modified()
            .unwrap()
    };
    let before = written();
    home.once().ended(0);
    assert_eq!(written(), before);
    assert_eq!(home.status().jobs.len(), 2);

    // One that fails is named, and the others are done first.
    home.drop("bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.drop("third.obj", cuboid(3.0));
    let ran = home.once().ended(1);
    assert!(ran.err.contains("bad.obj"), "{ran:#?}");
    assert_eq!(home.labels("third.obj"), 6);
    assert!(home.reason("bad.obj").is_some());
}

#[test]
fn once_on_an_empty_folder_is_all_done() {
    Home::new().once().ended(0);
}

/// A file that somebody writes to all the time is named and left after `max_wait_ms`.
#[test]
fn once_ends_though_one_file_grows_for_ever() {
    let home = Home::with("stable_for_ms = 500\nmax_wait_ms = 2000\n");
    home.drop("box.obj", cuboid(1.0));
    let growing = home.drop("growing.obj", cuboid(2.0));
    let ended = AtomicBool::new(false);
    let ran = thread::scope(|scope| {
        scope.spawn(|| {
            let mut file = File::options().append(true).open(&growing).unwrap();
            while !ended.load(Ordering::Relaxed) {
                file.write_all(b"# more\n").unwrap();
                thread::sleep(Duration::from_millis(50));
            }
        });
        let ran = home.once();
        ended.store(true, Ordering::Relaxed);
        ran
    });
    let ran = ran.ended(1);
    assert!(
        ran.err.contains("growing.obj: is still being written to"),
        "{ran:#?}"
    );
    assert_eq!(home.labels("box.obj"), 6);
    assert!(growing.exists() && !home.result("growing.obj").exists());
    home.once().ended(0);
    assert_eq!(home.labels("growing.obj"), 6);
}
