//! Folders that vanish and come back, and those the system does not tell of.

use std::fs;
use std::time::Duration;

use seamline_tests::daemon::{Daemon, Home, behind, cuboid, cuboids, skipped, torus, works};
use seamline_tests::run;

use crate::METRICS;

/// Two limits of the system, each a namespace of its own for the daemon.
#[test]
fn inotify_limit_falls_back_to_poll() {
    if !works(&[
        "unshare",
        "-Ur",
        "sh",
        "-c",
        "echo 0 > /proc/sys/user/max_inotify_instances",
    ]) {
        return skipped("no namespace with limits of its own: `unshare -Ur` does not work");
    }
    for limit in ["max_inotify_instances", "max_inotify_watches"] {
        let home =
            Home::with("poll_ms = 200\nstable_for_ms = 100\n[daemon]\nrescan_ms = 3600000\n");
        let set = format!("echo 0 > /proc/sys/user/{limit} && exec \"$@\"");
        let first = ["unshare", "-Ur", "sh", "-c", &set, "sh"];
        let daemon = home.start_as(&mut behind(&first, &home.watch()));
        home.drop("deep/box.obj", cuboid(1.0));
        daemon.wait_for("the result", || home.labels("deep/box.obj") == 6);
        home.drop("deeper/still/box.obj", cuboid(2.0));
        daemon.wait_for("another", || home.labels("deeper/still/box.obj") == 6);
        let log = daemon.log();
        let warnings: Vec<_> = log.lines().filter(|line| line.contains("WARN")).collect();
        let sysctl = format!("fs.inotify.{}", limit.replace("inotify_", "user_"));
        assert_eq!(warnings.len(), 1, "{log}");
        assert!(
            warnings[0].contains(&sysctl),
            "{sysctl} is not named: {log}"
        );
        assert_eq!(daemon.terminate(), Some(0));
    }
}

/// The second of two folders, beside the inbox, with the same defaults.
const SECOND: &str = "[[watch]]\nroot = \"second\"\nstable_for_ms = 100\n";

fn is_ready(daemon: &Daemon) -> bool {
    daemon.get("/ready").0 == 200
}

/// The results of both would have one place: the folder named first has it while both wait, and afterwards the one
/// whose results are there.
#[test]
fn of_two_folders_with_files_of_one_name_one_gets_the_place() {
    let home = Home::with(&format!("stable_for_ms = 100\n{SECOND}"));
    fs::create_dir(home.at("second")).unwrap();
    home.drop("both.obj", cuboid(1.0));
    fs::write(home.at("second/both.obj"), eight_faces()).unwrap();
    fs::write(home.at("second/later.obj"), eight_faces()).unwrap();
    home.once().ended(1);
    assert_eq!(home.labels("both.obj"), 6);
    let message = home.reason("both.obj").unwrap()["message"].to_string();
    assert!(message.contains("inbox/both.obj"), "{message}");
    assert!(!home.at("second/both.obj").exists());
    assert!(home.inbox().join("both.obj").exists());

    let faces = home.labels("later.obj");
    assert!(faces > 6);
    home.drop("later.obj", cuboid(2.0));
    home.once().ended(1);
    assert_eq!(home.labels("later.obj"), faces);
    let message = home.reason("later.obj").unwrap()["message"].to_string();
    assert!(message.contains("second/later.obj"), "{message}");
    assert!(!home.inbox().join("later.obj").exists());
}

/// A mesh with more than six faces.
fn eight_faces() -> String {
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n".to_owned()
        + &"f 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n".repeat(2)
}

/// A share that is not mounted may be mounted later: what is put there until then would be lost under it.
#[test]
fn an_output_folder_that_vanished_is_not_made_anew() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n{METRICS}[retry]\nfirst_ms = 100\nmost_ms = 300\n"
    ));
    let daemon = home.start();
    home.drop("before.obj", cuboid(1.0));
    daemon.wait_for("a result", || home.labels("before.obj") == 6);
    daemon.wait_for("readiness", || is_ready(&daemon));
    fs::rename(home.at("out"), home.at("unmounted")).unwrap();
    daemon.wait_for("/ready to go red", || !is_ready(&daemon));
    home.drop("meanwhile.obj", cuboid(2.0));
    daemon.wait_for("two attempts", || {
        daemon.log().matches("not there any more").count() >= 2
    });
    assert!(!home.at("out").exists());
    assert!(home.status().is("meanwhile.obj", "pending"));
    assert_eq!(home.results().quarantined(), [""; 0]);

    fs::rename(home.at("unmounted"), home.at("out")).unwrap();
    daemon.wait_for("the result", || home.labels("meanwhile.obj") == 6);
    daemon.wait_for("readiness again", || is_ready(&daemon));
    assert_eq!(daemon.terminate(), Some(0));
}

/// They are crossed out while it is away, and taken again once it is back.
#[test]
fn files_that_wait_while_their_folder_goes_and_comes_back_are_cut() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[daemon]\nworkers = 1\nqueue = 1\n{METRICS}"
    ));
    let daemon = home.start();
    home.drop("a-large.stl", torus(800_000));
    daemon.wait_for("the large one", || {
        home.status().is("a-large.stl", "running")
    });
    for (name, text) in cuboids(40) {
        home.drop(name, text);
    }
    daemon.wait_for("the others to wait", || home.status().jobs.len() == 41);
    fs::rename(home.inbox(), home.at("away")).unwrap();
    daemon.wait_for("/ready to go red", || !is_ready(&daemon));
    daemon.wait_for("all to be dealt with", || {
        let status = home.status();
        status.count("pending") + status.count("running") == 0
    });
    assert!(home.status().count("gone") > 0);
    fs::rename(home.at("away"), home.inbox()).unwrap();
    daemon.wait_for("all results", || home.results().names().len() == 41);
    daemon.wait_for("readiness", || is_ready(&daemon));
    assert_eq!(home.results().quarantined(), [""; 0]);
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn a_source_that_cannot_be_moved_is_tried_again() {
    let home = Home::with("stable_for_ms = 100\nafter = \"move\"\n");
    let daemon = home.start();
    fs::remove_dir(home.at("done")).unwrap();
    let source = home.drop("a/box.obj", cuboid(1.0));
    daemon.wait_for("a word on it", || {
        daemon.log().contains("stays where it is")
    });
    assert!(home.status().is("a/box.obj", "done"));
    assert!(source.exists() && !home.at("done").exists());
    fs::create_dir(home.at("done")).unwrap();
    daemon.wait_for("the move", || home.at("done/a/box.obj").exists());
    assert!(!source.exists());
    daemon.wait_for("its row", || {
        home.status().only("a/box.obj").source.is_some()
    });
    assert_eq!(home.status().only("a/box.obj").attempts, 1);
    assert_eq!(daemon.terminate(), Some(0));
}

/// What it would do from now on could not be remembered, and another could start beside it.
#[test]
fn a_state_folder_that_is_deleted_ends_the_daemon() {
    let home = Home::new();
    let mut daemon = home.start();
    // All its threads have opened the ledger by then.
    home.drop("box.obj", cuboid(1.0));
    daemon.wait_for("a result", || home.labels("box.obj") == 6);
    fs::remove_dir_all(home.at("state")).unwrap();
    assert_eq!(daemon.wait_exit(Duration::from_secs(20)), Some(1));
    assert!(daemon.log().contains("was taken away"), "{}", daemon.log());
}

/// A share that comes up after the daemon: waited for, in words, and taken up when it is there.
#[test]
fn a_watched_folder_that_is_not_there_at_the_start_is_waited_for() {
    let home = Home::with(&format!("stable_for_ms = 100\n{METRICS}"));
    fs::remove_dir(home.inbox()).unwrap();
    for option in ["--once", "--dry-run"] {
        let ran = run(home.watch().arg(option)).ended(2);
        assert!(ran.err.contains("inbox is not there"), "{ran:#?}");
        assert!(!home.at("state").exists());
    }
    let daemon = home.start();
    daemon.wait_for("a word on it", || daemon.log().contains("waiting for it"));
    daemon.wait_for("the reason", || {
        let (code, why) = daemon.get("/ready");
        code == 503
            && why
                .trim()
                .ends_with("No such file or directory (os error 2)")
    });
    assert_eq!(daemon.get("/health").0, 200);
    home.drop("deep/box.obj", cuboid(1.0));
    daemon.wait_for("the result", || home.labels("deep/box.obj") == 6);
    daemon.wait_for("readiness", || is_ready(&daemon));

    // And so is one that comes with a new configuration.
    home.configure(&format!("stable_for_ms = 100\n{METRICS}{SECOND}"));
    daemon.wait_for("/ready to go red", || !is_ready(&daemon));
    let (_, why) = daemon.get("/ready");
    assert!(why.contains("second"), "{why}");
    fs::create_dir(home.at("second")).unwrap();
    fs::write(home.at("second/later.obj"), cuboid(2.0)).unwrap();
    daemon.wait_for("its result", || home.labels("later.obj") == 6);
    daemon.wait_for("readiness again", || is_ready(&daemon));
    assert_eq!(daemon.terminate(), Some(0));
}

/// What waits in a folder that is watched no longer is nobody's delay.
#[test]
fn what_waits_in_a_folder_that_is_watched_no_longer_does_not_count_as_oldest() {
    let long = format!("stable_for_ms = 100\n{METRICS}");
    let home = Home::with(&format!("{long}{SECOND}"));
    fs::create_dir(home.at("second")).unwrap();
    let daemon = home.start();
    let half = torus(200);
    fs::write(home.at("second/half.stl"), &half[..half.len() / 2]).unwrap();
    let oldest = || {
        daemon
            .metrics()
            .value("seamline_oldest_pending_seconds", &[])
    };
    daemon.wait_for("it to wait", || oldest() > 1.0);
    home.configure(&long);
    daemon.wait_for("it not to count", || oldest() == 0.0);
    assert!(home.status().is("half.stl", "pending"));
    home.configure(&format!("{long}{SECOND}"));
    daemon.wait_for("it to count again", || oldest() > 1.0);
    assert_eq!(daemon.terminate(), Some(0));
}
