//! A file that brings the daemon down.

use seamline_tests::daemon::{FailingDisk, Home, cuboid, cuboids, torus};

use crate::EIO;

/// The process dies on a file each time: after as many attempts as are set, it is put aside unread.
#[test]
fn a_file_that_kills_the_daemon_is_quarantined_in_the_end() {
    let home =
        Home::with("stable_for_ms = 100\n[retry]\nattempts = 3\nfirst_ms = 10\nmost_ms = 10\n");
    let Some(disk) = FailingDisk::new(&home) else {
        return;
    };
    home.drop("deadly.obj", cuboid(1.0));
    for attempt in 1..=3 {
        disk.hold();
        let daemon = home.start_as(disk.under(&mut home.watch(), "inbox/deadly", EIO));
        daemon.wait_for("the attempt", || disk.is_holding());
        assert_eq!(home.status().only("deadly.obj").attempts, attempt);
        daemon.kill();
    }
    disk.hold();
    let daemon = home.start_as(disk.under(&mut home.watch(), "inbox/deadly", EIO));
    daemon.wait_for("the end", || home.reason("deadly.obj").is_some());
    assert_eq!(home.reason("deadly.obj").unwrap()["attempts"], 3);
    home.drop("good.obj", cuboid(2.0));
    daemon.wait_for("another", || home.labels("good.obj") == 6);
    assert_eq!(daemon.terminate(), Some(0));
}

/// Files that were in work beside it, and that come before and after it, are not taken for it.
#[test]
fn a_file_that_kills_the_daemon_takes_no_others_with_it() {
    let home = Home::with("stable_for_ms = 100\n[daemon]\nworkers = 1\n");
    let Some(disk) = FailingDisk::new(&home) else {
        return;
    };
    home.drop("deadly.obj", cuboid(100.0));
    for (name, text) in cuboids(8) {
        home.drop(format!("after-{name}"), text);
    }
    home.drop("before.stl", torus(20_000));
    let mut kills = 0;
    while home.reason("deadly.obj").is_none() {
        assert!(kills < 10, "{:#?}", home.status());
        disk.hold();
        let daemon = home.start_as(disk.under(&mut home.watch(), "inbox/deadly", EIO));
        daemon.wait_for("the end of the file or of the daemon", || {
            disk.is_holding() || home.reason("deadly.obj").is_some()
        });
        daemon.kill();
        kills += 1;
    }
    disk.let_go();
    home.once().ended(0);
    let status = home.status();
    assert_eq!(status.count("done"), 9, "{status:#?}");
    assert_eq!(home.results().quarantined(), ["deadly.obj"]);
    assert_eq!(home.results().names().len(), 9);
}
