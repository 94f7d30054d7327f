//! What goes wrong: broken files, failing and full disks, limits of the system. One costs one file at most.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use seamline_tests::daemon::{
    Daemon, FailingDisk, Home, behind, cuboid, cuboids, skipped, torus, wait_within, works,
};

const METRICS: &str = "[http]\nlisten = \"127.0.0.1:0\"\n";
const EIO: i32 = 5;
const EBUSY: i32 = 16;

/// One that is completed in time is done; one that is not is put aside, and not before its time.
#[test]
fn truncated_by_header_waits_then_quarantines() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\nmax_wait_ms = 3000\n{METRICS}"
    ));
    let daemon = home.start();
    let whole = torus(200);
    let half = &whole[..whole.len() / 2];
    let resumed = home.drop("resumed.stl", half);
    home.drop("given-up.stl", half);
    home.drop("whole.stl", torus(300));
    daemon.wait_for("the whole one", || home.labels("whole.stl") > 0);
    sleep(Duration::from_millis(1000));
    assert_eq!(home.results().quarantined(), [""; 0]);
    assert!(
        home.status().is("resumed.stl", "pending")
            || home.status().jobs_of("resumed.stl").is_empty()
    );
    let mut file = File::options().append(true).open(resumed).unwrap();
    file.write_all(&whole[half.len()..]).unwrap();
    drop(file);
    daemon.wait_for("the resumed one", || home.labels("resumed.stl") > 0);
    assert_eq!(
        home.labels("resumed.stl"),
        home.results().report("resumed.stl").unwrap()["input"]["faces"]
    );

    daemon.wait_for("the other", || home.reason("given-up.stl").is_some());
    let reason = home.reason("given-up.stl").unwrap();
    let message = reason["message"].as_str().unwrap();
    assert!(message.contains("incomplete"), "{reason}");
    assert_eq!(home.results().quarantined(), ["given-up.stl"]);
    assert!(!home.result("given-up.stl").exists());
    assert_eq!(daemon.terminate(), Some(0));
}

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

/// Broken files, and one that the disk does not give: the others are done, and `requeue` brings it back.
#[test]
fn poison_file_quarantined() {
    let retry = "[retry]\nattempts = 3\nfirst_ms = 100\nmost_ms = 400\n";
    let home = Home::with(&format!("stable_for_ms = 100\n{retry}"));
    let Some(disk) = FailingDisk::new(&home) else {
        return;
    };
    disk.fail(1000);
    let mut daemon = home.start_as(disk.under(&mut home.watch(), "inbox/a/sector.obj", EIO));
    home.drop("a/sector.obj", cuboid(50.0));
    home.drop("a/bad.stl", "this is no mesh at all\n");
    home.drop("a/bad.obj", "v 0 0 0\nf 1 2 3\n");
    for (name, text) in cuboids(5) {
        home.drop(name, text);
    }
    daemon.wait_for("the good results", || home.results().names().len() == 5);
    for (name, attempts) in [("a/bad.stl", 1), ("a/bad.obj", 1), ("a/sector.obj", 3)] {
        daemon.wait_for(name, || home.reason(name).is_some());
        daemon.wait_for(name, || home.status().is(name, "quarantined"));
        let reason = home.reason(name).unwrap();
        for key in ["stage", "message", "hint", "path", "program_version"] {
            let told = reason[key].as_str().is_some_and(|text| !text.is_empty());
            assert!(told, "{name}: {key}: {reason}");
        }
        assert_eq!(reason["attempts"], attempts, "{name}");
        assert_eq!(reason["blake3"].is_string(), attempts == 1, "{reason}");
        assert!(reason["settings"].is_object());
        assert!(home.at("quarantine").join(name).exists());
        assert!(!home.inbox().join(name).exists());
        assert!(!home.result(name).exists());
        let status = home.status();
        let row = status.only(name);
        assert_eq!(row.attempts, attempts);
        assert_eq!(row.message.as_deref(), reason["message"].as_str());
        assert_eq!(
            row.source.as_deref(),
            Some(&*home.path().join("quarantine").join(name))
        );
    }
    assert_eq!(disk.failures().len(), 3);
    assert!(!daemon.has_ended());

    disk.repair();
    let id = home.status().only("a/sector.obj").id.to_string();
    home.requeue(&[&id]);
    daemon.wait_for("it to be done", || home.status().is("a/sector.obj", "done"));
    assert_eq!(home.labels("a/sector.obj"), 6);
    assert!(!home.at("quarantine/a/sector.obj").exists());
    assert_eq!(home.reason("a/sector.obj"), None);

    // The others come back as well, and go the same way.
    home.requeue(&["--all-quarantined"]);
    daemon.wait_for("them to come back", || {
        let bad = ["a/bad.stl", "a/bad.obj"];
        bad.iter()
            .all(|name| home.status().is(name, "quarantined") && home.reason(name).is_some())
    });
    assert_eq!(
        home.status().count("quarantined"),
        2,
        "{:#?}",
        home.status()
    );
    assert_eq!(daemon.terminate(), Some(0));
}

/// Also with no daemon about, and for a file the daemon then takes.
#[test]
fn requeue_works_while_no_daemon_runs() {
    let home = Home::new();
    home.drop("bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.once().ended(1);
    home.requeue(&["--all-quarantined"]);
    assert!(home.inbox().join("bad.obj").exists());
    assert!(!home.at("quarantine/bad.obj").exists());
    home.once().ended(1);
    assert!(home.at("quarantine/bad.obj").exists());
    let ran = seamline_tests::run(
        seamline_tests::seamline()
            .arg("requeue")
            .arg(home.config())
            .arg("4711"),
    );
    assert_ne!(ran.code, Some(0), "{ran:#?}");
    assert!(ran.err.contains("4711"), "{ran:#?}");
}

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

/// Files that want more than there is are refused, each for its reason, and cost no memory.
#[test]
fn too_large_or_packed_is_refused() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\nmax_wait_ms = 200\n[limits]\nmax_file_bytes = 200000\nmax_triangles = 2000\n{METRICS}"
    ));
    let daemon = home.start();
    let promise = |file: &mut Vec<u8>| file.extend(u32::MAX.to_le_bytes());
    let mut stl = vec![b' '; 80];
    promise(&mut stl);
    stl.extend([0; 50]);
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\n\
               property float y\nproperty float z\nelement face 4294967295\n\
               property list uchar int vertex_indices\nend_header\n\0\0\0\0";
    let gzip = [b"\x1f\x8b\x08\0\0\0\0\0\0\x03".to_vec(), vec![0x5a; 500]].concat();
    let zip = [b"PK\x03\x04\x14\0\0\0\x08\0".to_vec(), vec![0x5a; 500]].concat();
    let cases: [(&str, Vec<u8>, &[&str]); 6] = [
        ("long.obj", vec![b'#'; 200_001], &["200001", "200000"]),
        ("fine.stl", torus(3000), &["2000", "triangles"]),
        ("promise.stl", stl, &["incomplete"]),
        ("promise.ply", ply.into(), &["incomplete"]),
        ("gzip.stl", gzip, &["archive"]),
        ("zip.stl", zip, &["archive"]),
    ];
    for (name, bytes, _) in &cases {
        home.drop(name, bytes);
    }
    home.drop("good.obj", cuboid(1.0));
    for (name, _, words) in &cases {
        daemon.wait_for(name, || home.reason(name).is_some());
        let reason = home.reason(name).unwrap();
        let told = format!("{} {}", reason["message"], reason["hint"]);
        for word in *words {
            assert!(told.contains(word), "{name}: `{word}` is not told: {told}");
        }
        daemon.wait_for(name, || home.status().is(name, "quarantined"));
        assert_eq!(home.status().only(name).attempts, 1, "{name}");
    }
    daemon.wait_for("the good one", || home.labels("good.obj") == 6);
    assert!(daemon.memory("VmHWM") < 200 << 20);
    assert_eq!(daemon.terminate(), Some(0));
}

/// `count` meshes of so many triangles, dropped at once, under a limit of memory: never more than that is
/// taken, and all are done.
fn stays_in_bounds(count: u32, triangles: usize, limit: u64, patience: Duration) {
    let daemon_table = "[daemon]\nworkers = 2\n";
    let home = Home::with(&format!(
        "stable_for_ms = 300\n{daemon_table}[limits]\nmemory_limit_bytes = {limit}\n{METRICS}"
    ));
    let mesh = torus(triangles);
    for number in 0..count {
        // The header is the part of a binary STL that means nothing: other bytes, the same mesh.
        let mut mesh = mesh.clone();
        mesh[..4].copy_from_slice(&number.to_le_bytes());
        home.drop(format!("part{number}.stl"), mesh);
    }
    let daemon = home.start();
    let mut most_reserved = 0.0f64;
    daemon.wait_longer("all of them", patience, || {
        let metrics = daemon.metrics();
        let reserved = metrics.value("seamline_memory_reserved_bytes", &[]);
        most_reserved = most_reserved.max(reserved);
        home.results().names().len() == count as usize
    });
    let most = daemon.memory("VmHWM");
    eprintln!(
        "{count} meshes of {triangles} triangles: {most} bytes at most, {most_reserved} reserved, limit {limit}"
    );
    assert!(most < limit, "{most} of {limit}");
    assert!(
        most_reserved > 0.0 && most_reserved <= limit as f64 * 0.75,
        "{most_reserved}"
    );
    let metrics = daemon.metrics();
    assert_eq!(
        metrics.value("seamline_memory_limit_bytes", &[]),
        limit as f64
    );
    daemon.wait_for("the rows", || {
        home.status().count("done") == u64::from(count)
    });
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn bounded_memory() {
    stays_in_bounds(10, 250_000, 800 << 20, Duration::from_secs(180));
}

#[test]
#[ignore = "takes about 15 minutes"]
fn bounded_memory_in_full() {
    stays_in_bounds(200, 1_000_000, 3200 << 20, Duration::from_secs(3600));
}

/// A mesh that would not fit alone is refused.
#[test]
fn a_mesh_over_the_whole_limit_is_refused() {
    let home = Home::with("stable_for_ms = 100\n[limits]\nmemory_limit_bytes = 67108864\n");
    let daemon = home.start();
    home.drop("giant.stl", torus(600_000));
    home.drop("good.obj", cuboid(1.0));
    daemon.wait_for("the giant", || home.reason("giant.stl").is_some());
    let reason = home.reason("giant.stl").unwrap();
    assert!(
        reason["message"].as_str().unwrap().contains("memory"),
        "{reason}"
    );
    daemon.wait_for("the other", || home.labels("good.obj") == 6);
    assert!(daemon.memory("VmHWM") < 128 << 20);
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
