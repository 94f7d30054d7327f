//! Disks that fail and disks that are full.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use seamline_tests::daemon::{
    Daemon, FailingDisk, Home, Results, behind, cuboid, cuboids, skipped, wait_within, works,
};

use crate::{EBUSY, EIO, METRICS};

#[test]
fn transient_vs_permanent() {
    for errno in [EIO, EBUSY] {
        let retry = "[retry]\nattempts = 10\nfirst_ms = 200\nmost_ms = 10000\n";
        let home = Home::with(&format!("stable_for_ms = 100\n{retry}{METRICS}"));
        let Some(disk) = FailingDisk::new(&home) else {
            return;
        };
        disk.fail(4);
        let daemon = home.start_as(disk.under(&mut home.watch(), "inbox/shaky", errno));
        home.drop("shaky.obj", cuboid(1.0));
        home.drop("bad.obj", "v 0 0 0\nf 1 2 3\n");
        home.drop("good.obj", cuboid(2.0));
        daemon.wait_for("the shaky one", || home.status().is("shaky.obj", "done"));
        assert_eq!(home.labels("shaky.obj"), 6);
        let status = home.status();
        assert_eq!(status.only("shaky.obj").attempts, 5);
        assert_eq!(status.only("bad.obj").attempts, 1);
        assert_eq!(status.only("bad.obj").state, "quarantined");
        assert_eq!(status.only("good.obj").attempts, 1);
        assert_eq!(home.results().quarantined(), ["bad.obj"]);

        // 200, 400, 800 ms, each give or take a quarter.
        let failures = disk.failures();
        let waits: Vec<_> = failures.windows(2).map(|w| w[1] - w[0]).collect();
        assert_eq!(waits.len(), 3);
        for (wait, least) in waits.iter().zip([150, 300, 600]) {
            assert!(wait.as_millis() >= least, "{waits:?}");
        }
        assert!(waits[2] > waits[0], "{waits:?}");
        let retried = [("outcome", "retried")];
        assert_eq!(daemon.metrics().value("seamline_jobs_total", &retried), 4.0);
        assert_eq!(daemon.terminate(), Some(0));
    }
}

/// A wait between two attempts outlives the daemon, and attempts are counted on.
#[test]
fn attempts_are_counted_across_restarts() {
    let retry = "[retry]\nattempts = 3\nfirst_ms = 300\nmost_ms = 300\n";
    let home = Home::with(&format!("stable_for_ms = 100\n{retry}"));
    let Some(disk) = FailingDisk::new(&home) else {
        return;
    };
    disk.fail(1000);
    let command = || {
        let mut command = home.watch();
        disk.under(&mut command, "inbox/sector", EIO);
        command
    };
    let daemon = home.start_as(&mut command());
    home.drop("sector.obj", cuboid(1.0));
    daemon.wait_for("the first attempt", || disk.failures().len() == 1);
    assert_eq!(daemon.terminate(), Some(0));
    let daemon = home.start_as(&mut command());
    daemon.wait_for("the end", || home.status().is("sector.obj", "quarantined"));
    assert_eq!(home.status().only("sector.obj").attempts, 3);
    assert_eq!(disk.failures().len(), 3);
    assert_eq!(daemon.terminate(), Some(0));
}

/// A small disk of its own for the results, which only the daemon sees under that name.
fn on_a_small_disk(home: &Home, megabytes: u32) -> Option<(Daemon, PathBuf)> {
    let mount = [
        "unshare",
        "-Urm",
        "sh",
        "-c",
        "mount -t tmpfs -o size=1m none /mnt",
        "sh",
    ];
    if !works(&mount) {
        skipped("no disk of its own: `unshare -Urm` with a tmpfs does not work");
        return None;
    }
    fs::create_dir(home.at("out")).unwrap();
    let out = home.path().join("out");
    let mount = format!(
        "mount -t tmpfs -o size={megabytes}m none '{}' && exec \"$@\"",
        out.display()
    );
    let first = ["unshare", "-Urm", "sh", "-c", &mount, "sh"];
    let daemon = home.start_as(&mut behind(&first, &home.watch()));
    let seen = PathBuf::from(format!("/proc/{}/root{}", daemon.pid(), out.display()));
    Some((daemon, seen))
}

fn fill(disk: &Path) {
    let mut ballast = File::create(disk.join("ballast")).unwrap();
    for piece in [65_536, 4096, 1] {
        while ballast.write_all(&vec![0; piece]).is_ok() {}
    }
}

#[test]
fn disk_full() {
    let home = Home::with(&format!("stable_for_ms = 100\n{METRICS}"));
    let Some((mut daemon, disk)) = on_a_small_disk(&home, 4) else {
        return;
    };
    let labels = |name: &str| {
        let path = disk.join(format!("{name}.seamline/labels.seg"));
        fs::read_to_string(path).map_or(0, |text| text.lines().count())
    };
    home.drop("before.obj", cuboid(100.0));
    daemon.wait_for("a result", || labels("before.obj") == 6);
    assert_eq!(daemon.get("/ready").0, 200);

    fill(&disk);
    for (name, text) in cuboids(12) {
        home.drop(name, text);
    }
    daemon.wait_for("/ready to go red", || daemon.get("/ready").0 == 503);
    let (_, why) = daemon.get("/ready");
    assert!(why.contains("out") && why.contains("full"), "{why}");
    let paused = |daemon: &Daemon| daemon.metrics().value("seamline_paused", &[]);
    daemon.wait_for("the pause to be told", || paused(&daemon) == 1.0);
    assert_eq!(daemon.get("/health").0, 200);
    sleep(Duration::from_millis(1500));
    let status = home.status();
    assert_eq!(status.count("quarantined"), 0, "{status:#?}");
    assert_eq!(status.count("done"), 1, "{status:#?}");
    assert_eq!(home.results().quarantined(), [""; 0]);
    assert!(!daemon.has_ended());

    fs::remove_file(disk.join("ballast")).unwrap();
    daemon.wait_for("all of them", || {
        (0..12).all(|number| labels(&format!("part{number}.obj")) == 6)
    });
    daemon.wait_for("/ready to go green", || daemon.get("/ready").0 == 200);
    daemon.wait_for("the rows", || home.status().count("done") == 13);
    daemon.wait_for("its end to be told", || paused(&daemon) == 0.0);
    assert_eq!(seamline_tests::daemon::leftovers(&disk), [""; 0]);
    assert_eq!(daemon.terminate(), Some(0));
}

/// Told to stop while the disk is full, it stops, and what waits for room is done the next time.
#[test]
fn a_full_disk_does_not_keep_it_from_stopping() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[daemon]\ndrain_s = 1\n{METRICS}"
    ));
    let Some((mut daemon, disk)) = on_a_small_disk(&home, 1) else {
        return;
    };
    fill(&disk);
    home.drop("part.obj", cuboid(1.0));
    daemon.wait_for("/ready to go red", || daemon.get("/ready").0 == 503);
    daemon.signal(seamline_tests::daemon::Signal::Term);
    daemon.wait_exit(Duration::from_secs(20));
    assert!(wait_within(Duration::from_secs(5), || home
        .status()
        .is("part.obj", "pending")));
    home.once().ended(0);
    assert_eq!(home.labels("part.obj"), 6);
}

/// A disk that stays full is left behind by a configuration that names another folder.
#[test]
fn a_full_disk_is_escaped_by_another_output_folder() {
    let with = |more: &str| format!("stable_for_ms = 100\n{METRICS}{more}");
    let home = Home::with(&with(""));
    let Some((daemon, disk)) = on_a_small_disk(&home, 1) else {
        return;
    };
    fill(&disk);
    for (name, text) in cuboids(12) {
        home.drop(name, text);
    }
    daemon.wait_for("/ready to go red", || daemon.get("/ready").0 == 503);
    home.configure(&with("[output]\ndir = \"elsewhere\"\n"));
    let elsewhere = Results {
        out: home.at("elsewhere"),
        ..home.results()
    };
    daemon.wait_for("all of them", || elsewhere.names().len() == 12);
    daemon.wait_for("the rows", || home.status().count("done") == 12);
    daemon.wait_for("/ready to go green", || daemon.get("/ready").0 == 200);
    assert_eq!(daemon.metrics().value("seamline_paused", &[]), 0.0);
    for (name, _) in cuboids(12) {
        assert_eq!(elsewhere.labels(&name), 6);
        assert_eq!(home.status().only(&name).attempts, 1, "{name}");
    }
    assert_eq!(elsewhere.quarantined(), [""; 0]);
    assert_eq!(seamline_tests::daemon::leftovers(&disk), [""; 0]);
    assert_eq!(daemon.terminate(), Some(0));
}

/// The new content is entered while the old is still being read: the old is gone then, and nothing waits in the end.
#[test]
fn what_is_replaced_while_it_is_read_does_not_wait_for_ever() {
    let home = Home::with("stable_for_ms = 100\n");
    let Some(disk) = FailingDisk::new(&home) else {
        return;
    };
    disk.hold();
    let daemon = home.start_as(disk.under(&mut home.watch(), "inbox/slow", EIO));
    home.drop("slow.obj", cuboid(1.0));
    daemon.wait_for("the read to begin", || disk.is_holding());
    home.drop("slow.obj", cuboid(2.0));
    daemon.wait_for("the new content to be entered", || {
        home.status().jobs_of("slow.obj").len() == 2
    });
    disk.let_go();
    daemon.wait_for("the result", || home.status().is("slow.obj", "done"));
    let status = home.status();
    let states: Vec<_> = status.jobs.iter().map(|job| &job.state[..]).collect();
    assert_eq!(states, ["gone", "done"], "{status:#?}");
    assert_eq!(daemon.terminate(), Some(0));
}
