//! How files come in: whole, once, and none is missed.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use seamline_tests::daemon::{
    Daemon, FailingDisk, Home, Mode, Signal, behind, cuboid, cuboids, skipped, torus, works,
};
use seamline_tests::in_both_modes;

/// Nothing is found by the periodic listing.
const NO_RESCAN: &str = "[daemon]\nrescan_ms = 3600000\n";

const METRICS: &str = "[http]\nlisten = \"127.0.0.1:0\"\n";

in_both_modes!(
    half_written_file_waits,
    rename_into_folder_is_picked_up,
    temp_suffix_ignored,
    files_present_at_start_go_through_the_same_tracker,
    files_dropped_while_it_was_down_are_taken,
    files_dropped_while_it_runs_are_taken_once,
    new_subdir_with_files_race,
    poll_survives_unmounted_dir,
    changed_while_reading_restarts,
    clock_jump,
    odd_names_and_kinds,
);

fn append(path: &Path, piece: &[u8]) {
    let mut file = File::options().append(true).open(path).unwrap();
    file.write_all(piece).unwrap();
}

fn half_written_file_waits(mode: Mode) {
    let home = Home::in_mode(mode, "stable_for_ms = 1500\n");
    let daemon = home.start();
    let text = cuboid(1.0);
    let path = home.drop("box.obj", "");
    let started = Instant::now();
    for piece in text.as_bytes().chunks(text.len().div_ceil(15)) {
        append(&path, piece);
        sleep(Duration::from_millis(200));
        assert!(!home.result("box.obj").exists());
    }
    assert!(started.elapsed() > Duration::from_secs(2));
    daemon.wait_for("the result", || home.labels("box.obj") == 6);
    let status = home.status();
    assert_eq!(status.jobs.len(), 1, "{status:#?}");
    assert_eq!(status.only("box.obj").attempts, 1);
    assert_eq!(home.results().quarantined(), [""; 0]);
    assert_eq!(daemon.terminate(), Some(0));
}

fn rename_into_folder_is_picked_up(mode: Mode) {
    let home = Home::in_mode(mode, &format!("stable_for_ms = 100\n{NO_RESCAN}"));
    let daemon = home.start();
    fs::write(home.at("elsewhere.obj"), cuboid(1.0)).unwrap();
    fs::rename(home.at("elsewhere.obj"), home.at("inbox/box.obj")).unwrap();
    daemon.wait_for("the result", || home.labels("box.obj") == 6);

    let upload = home.drop("other.obj.filepart", cuboid(2.0));
    sleep(Duration::from_millis(400));
    fs::rename(upload, home.at("inbox/other.obj")).unwrap();
    daemon.wait_for("the result", || home.labels("other.obj") == 6);

    fs::create_dir_all(home.at("elsewhere/deep")).unwrap();
    fs::write(home.at("elsewhere/deep/box.obj"), cuboid(3.0)).unwrap();
    fs::rename(home.at("elsewhere"), home.at("inbox/folder")).unwrap();
    daemon.wait_for("the result", || home.labels("folder/deep/box.obj") == 6);
    assert_eq!(home.status().jobs.len(), 3);
    assert_eq!(daemon.terminate(), Some(0));
}

fn temp_suffix_ignored(mode: Mode) {
    let home = Home::in_mode(mode, "stable_for_ms = 100\ninclude = [\"*\"]\n");
    let daemon = home.start();
    for name in [
        "a.obj.part",
        "b.obj.tmp",
        "c.filepart",
        "d.crdownload",
        "e.obj~",
        "._f.obj",
        ".g.obj",
        ".hidden/h.obj",
    ] {
        home.drop(name, cuboid(1.0));
    }
    sleep(Duration::from_millis(500));
    home.drop("box.obj", cuboid(2.0));
    daemon.wait_for("the result", || home.labels("box.obj") == 6);
    let status = home.status();
    assert_eq!(status.jobs.len(), 1, "{status:#?}");
    assert_eq!(home.results().names(), ["box.obj"]);
    assert_eq!(fs::read_dir(home.inbox()).unwrap().count(), 9);
    assert_eq!(daemon.terminate(), Some(0));
}

fn files_present_at_start_go_through_the_same_tracker(mode: Mode) {
    let home = Home::in_mode(mode, "stable_for_ms = 1500\n");
    let text = cuboid(1.0);
    let (start, rest) = text.split_at(text.len() / 2);
    let growing = home.drop("growing.obj", start);
    home.drop("deeper/still/BOX.OBJ", cuboid(2.0));
    let daemon = home.start();
    // Half of this file is a mesh of its own: taken at once, it would give a result.
    for piece in rest.as_bytes().chunks(rest.len().div_ceil(10)) {
        sleep(Duration::from_millis(200));
        assert!(!home.result("growing.obj").exists());
        append(&growing, piece);
    }
    daemon.wait_for("both results", || {
        home.labels("growing.obj") == 6 && home.labels("deeper/still/BOX.OBJ") == 6
    });
    assert_eq!(home.status().only("growing.obj").attempts, 1);
    assert_eq!(daemon.terminate(), Some(0));
}

fn files_dropped_while_it_was_down_are_taken(mode: Mode) {
    let home = Home::in_mode(mode, "stable_for_ms = 100\n");
    let daemon = home.start();
    home.drop("first.obj", cuboid(1.0));
    daemon.wait_for("the first result", || home.labels("first.obj") == 6);
    assert_eq!(daemon.terminate(), Some(0));

    home.drop("while/it/was/down.obj", cuboid(2.0));
    home.drop("first.obj", torus(200));
    let daemon = home.start();
    daemon.wait_for("both results", || {
        home.labels("while/it/was/down.obj") == 6 && home.labels("first.obj") > 6
    });
    assert_eq!(daemon.terminate(), Some(0));
}

fn files_dropped_while_it_runs_are_taken_once(mode: Mode) {
    let home = Home::in_mode(mode, "stable_for_ms = 100\n[daemon]\nrescan_ms = 200\n");
    let daemon = home.start();
    for (name, text) in cuboids(10) {
        home.drop(format!("new/{name}"), text);
    }
    daemon.wait_for("ten results", || home.results().names().len() == 10);
    let written = || {
        let report = home.result("new/part3.obj").join("report.json");
        report.metadata().unwrap().modified().unwrap()
    };
    let first = written();
    sleep(Duration::from_millis(1000));
    assert_eq!(written(), first);
    daemon.wait_for("ten rows", || home.status().count("done") == 10);
    assert_eq!(home.status().jobs.len(), 10);
    assert_eq!(daemon.terminate(), Some(0));
}

/// A name outside the watched folder leads to the same file: who writes by that name is not heard of inside.
#[test]
fn missed_event_is_found_by_rescan() {
    let deaf = |rescan_ms: u32| {
        let watch = "watcher = \"native\"\nstable_for_ms = 100\n";
        let home = Home::with(&format!("{watch}[daemon]\nrescan_ms = {rescan_ms}\n"));
        let path = home.drop("box.obj", cuboid(1.0));
        fs::hard_link(path, home.at("elsewhere.obj")).unwrap();
        let daemon = home.start();
        daemon.wait_for("the result", || home.labels("box.obj") == 6);
        daemon.wait_for("its row", || home.status().is("box.obj", "done"));
        sleep(Duration::from_millis(500));
        fs::write(home.at("elsewhere.obj"), torus(200)).unwrap();
        (home, daemon)
    };
    let (without, daemon) = deaf(3_600_000);
    sleep(Duration::from_millis(2000));
    assert_eq!(without.labels("box.obj"), 6, "the event was to be missed");
    assert_eq!(daemon.terminate(), Some(0));

    let (with, daemon) = deaf(500);
    daemon.wait_for("the new result", || with.labels("box.obj") > 6);
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn overflow_triggers_full_scan() {
    let limit = fs::read_to_string("/proc/sys/fs/inotify/max_queued_events");
    let Some(limit) = limit.ok().and_then(|text| text.trim().parse::<u32>().ok()) else {
        return skipped("the system does not tell how many events it keeps");
    };
    let watch = "watcher = \"native\"\nstable_for_ms = 100\n";
    let home = Home::with(&format!("{watch}{NO_RESCAN}{METRICS}"));
    let daemon = home.start();
    let overflows = || daemon.metrics().value("seamline_overflows_total", &[]);
    assert_eq!(overflows(), 0.0);

    daemon.signal(Signal::Stop);
    let [a, b] = ["note-a.txt", "note-b.txt"].map(|name| home.inbox().join(name));
    fs::write(&a, "no mesh").unwrap();
    // Each of the two renames is two events.
    for _ in 0..limit / 4 + 100 {
        fs::rename(&a, &b).unwrap();
        fs::rename(&b, &a).unwrap();
    }
    for (name, text) in cuboids(10) {
        home.drop(format!("deep/{name}"), text);
    }
    daemon.signal(Signal::Cont);
    daemon.wait_for("ten results", || home.results().names().len() == 10);
    assert!(overflows() >= 1.0);
    // And it hears again.
    home.drop("deep/after.obj", cuboid(100.0));
    daemon.wait_for("another", || home.labels("deep/after.obj") == 6);
    assert_eq!(daemon.terminate(), Some(0));
}

fn new_subdir_with_files_race(mode: Mode) {
    let home = Home::in_mode(mode, &format!("stable_for_ms = 100\n{NO_RESCAN}"));
    let daemon = home.start();
    fs::create_dir_all(home.at("inbox/a/b/c")).unwrap();
    for (name, text) in cuboids(100) {
        fs::write(home.at("inbox/a/b/c").join(name), text).unwrap();
    }
    daemon.wait_for("a hundred rows", || home.status().count("done") == 100);
    assert_eq!(home.status().jobs.len(), 100);
    assert_eq!(home.results().names().len(), 100);
    assert_eq!(daemon.terminate(), Some(0));
}

/// The same files, good and bad, give the same results, reasons and rows, however they are noticed.
#[test]
fn poll_mode_same_results() {
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let take = |mode: Mode| {
        let home = Home::in_mode(mode, "stable_for_ms = 100\n");
        let daemon = home.start();
        for entry in fs::read_dir(&samples).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_owned();
            let is_mesh = |e: &std::ffi::OsStr| e == "stl" || e == "obj" || e == "ply";
            if path.extension().is_some_and(is_mesh) {
                home.drop(Path::new("samples").join(name), fs::read(&path).unwrap());
            }
        }
        for (name, text) in cuboids(20) {
            home.drop(name, text);
        }
        home.drop("again.obj", cuboid(1.0));
        home.drop("bad/bad.obj", "v 0 0 0\nf 1 2 3\n");
        home.drop("bad/bad.stl", "Dear all,\n");
        daemon.wait_for("every file to be dealt with", || {
            let status = home.status();
            status.count("done") == 28 && status.count("quarantined") == 2
        });
        assert_eq!(daemon.terminate(), Some(0));
        let states: BTreeMap<_, _> = home
            .status()
            .jobs
            .into_iter()
            .map(|job| (job.relative, (job.state, job.content, job.message)))
            .collect();
        let results = home.results();
        // Which of two files of the same content comes first is nobody's promise.
        let all = results.all().into_iter();
        let all = all.filter(|(name, _)| name != "again.obj" && name != "part0.obj");
        (all.collect::<BTreeMap<_, _>>(), states)
    };
    let [native, poll] = [Mode::Native, Mode::Poll].map(take);
    assert_eq!(native.0.len(), 26);
    assert!(native.0.keys().eq(poll.0.keys()));
    for (name, bytes) in &native.0 {
        assert!(*bytes == poll.0[name], "{name}");
    }
    assert_eq!(native.1, poll.1);
}

/// The folder is gone and comes back, twice: as a disk that is taken away, with all that is on it.
fn poll_survives_unmounted_dir(mode: Mode) {
    let watch = "stable_for_ms = 100\n[daemon]\nrescan_ms = 300\n";
    let home = Home::in_mode(mode, &format!("{watch}{METRICS}"));
    let mut daemon = home.start();
    let ready = |daemon: &Daemon| daemon.get("/ready").0;
    daemon.wait_for("readiness", || ready(&daemon) == 200);
    home.drop("before.obj", cuboid(1.0));
    daemon.wait_for("the first result", || home.labels("before.obj") == 6);

    for round in 0..2 {
        let name = format!("deep/while{round}.obj");
        fs::rename(home.inbox(), home.at("away")).unwrap();
        daemon.wait_for("/ready to go red", || ready(&daemon) == 503);
        let (_, why) = daemon.get("/ready");
        assert!(why.contains("inbox"), "{why}");
        assert_eq!(daemon.get("/health").0, 200);
        fs::create_dir_all(home.at("away/deep")).unwrap();
        fs::write(home.at("away").join(&name), cuboid(f64::from(round + 2))).unwrap();
        fs::rename(home.at("away"), home.inbox()).unwrap();
        daemon.wait_for("/ready to go green", || ready(&daemon) == 200);
        daemon.wait_for("what came meanwhile", || home.labels(&name) == 6);
    }
    home.drop("after.obj", cuboid(9.0));
    daemon.wait_for("what comes now", || home.labels("after.obj") == 6);
    daemon.wait_for("the ledger", || home.status().count("running") == 0);
    let status = home.status();
    assert_eq!(
        status.count("done"),
        status.jobs.len() as u64,
        "{status:#?}"
    );
    assert_eq!(status.jobs_of("before.obj").len(), 1, "{status:#?}");
    assert!(!daemon.has_ended());
    assert_eq!(daemon.terminate(), Some(0));
}

fn changed_while_reading_restarts(mode: Mode) {
    let home = Home::in_mode(mode, &format!("stable_for_ms = 100\n{METRICS}"));
    let Some(disk) = FailingDisk::new(&home) else {
        return;
    };
    let daemon = home.start_as(disk.under(&mut home.watch(), "inbox/slow", 5));
    disk.hold();
    home.drop("slow.obj", cuboid(1.0));
    daemon.wait_for("the read to begin", || disk.is_holding());
    home.drop("slow.obj", torus(200));
    disk.let_go();
    daemon.wait_for("the result of the new content", || {
        home.labels("slow.obj") > 6
    });
    let changed = [("outcome", "changed")];
    assert!(daemon.metrics().value("seamline_jobs_total", &changed) >= 1.0);
    daemon.wait_for("the row", || home.status().is("slow.obj", "done"));
    let status = home.status();
    assert_eq!(status.count("done"), 1, "{status:#?}");
    assert_eq!(status.count("quarantined"), 0, "{status:#?}");
    let report = home.results().report("slow.obj").unwrap();
    assert_eq!(
        report["input"]["blake3"].as_str(),
        status.latest("slow.obj").unwrap().content.as_deref()
    );
    assert_eq!(daemon.terminate(), Some(0));
}

fn set_modified(path: &Path, time: SystemTime) {
    let file = File::options().write(true).open(path).unwrap();
    file.set_modified(time).unwrap();
}

/// Times of change far in the future and the past, and going back while the file is still being written.
fn clock_jump(mode: Mode) {
    let home = Home::in_mode(mode, "stable_for_ms = 700\n");
    let daemon = home.start();
    let future = SystemTime::now() + Duration::from_secs(20 * 365 * 86_400);
    let past = SystemTime::UNIX_EPOCH + Duration::from_secs(1000);
    set_modified(&home.drop("future.obj", cuboid(1.0)), future);
    set_modified(&home.drop("past.obj", cuboid(2.0)), past);
    let jumping = home.drop("jumping.obj", cuboid(3.0));
    for (round, time) in [future, past, SystemTime::now(), past, future]
        .into_iter()
        .enumerate()
    {
        append(&jumping, format!("# {round}\n").as_bytes());
        set_modified(&jumping, time);
        sleep(Duration::from_millis(200));
        assert!(!home.result("jumping.obj").exists());
    }
    for name in ["future.obj", "past.obj", "jumping.obj"] {
        daemon.wait_for(name, || home.labels(name) == 6);
    }
    daemon.wait_for("three rows", || home.status().count("done") == 3);
    assert_eq!(home.status().jobs.len(), 3);
    assert_eq!(daemon.terminate(), Some(0));
}

fn odd_names_and_kinds(mode: Mode) {
    let home = Home::in_mode(mode, "stable_for_ms = 100\n");
    let names = [
        "Größe 1 – Ü.obj",
        "zwei Teile.obj",
        "neue\nZeile.obj",
        "部品/ねじ.obj",
        "-q.obj",
        "quote'\".obj",
    ];
    let mut daemon = home.start();
    for (name, (_, text)) in names.iter().zip(cuboids(6)) {
        home.drop(name, text);
    }
    fs::write(home.at("behind-the-link.obj"), cuboid(10.0)).unwrap();
    symlink(
        home.at("behind-the-link.obj"),
        home.inbox().join("link.obj"),
    )
    .unwrap();
    symlink(home.at("nowhere"), home.inbox().join("dangling.obj")).unwrap();
    symlink(home.inbox(), home.inbox().join("loop")).unwrap();
    let pipe = home.inbox().join("pipe.obj");
    assert!(Command::new("mkfifo").arg(pipe).status().unwrap().success());
    let empty = home.drop("empty.obj", "");
    fs::create_dir(home.inbox().join("folder.obj")).unwrap();

    for name in names.iter().chain(&["link.obj"]) {
        daemon.wait_for(name, || home.labels(name) == 6);
    }
    // A name of no encoding at all.
    let broken = std::os::unix::ffi::OsStringExt::from_vec(b"br\xffken.obj".to_vec());
    let broken: std::ffi::OsString = broken;
    home.drop(&broken, cuboid(11.0));
    let mut folder = broken;
    folder.push(".seamline/labels.seg");
    daemon.wait_for("the name of no encoding", || {
        home.at("out").join(&folder).exists()
    });

    assert!(!home.result("empty.obj").exists());
    append(&empty, cuboid(12.0).as_bytes());
    daemon.wait_for("content", || home.labels("empty.obj") == 6);
    daemon.wait_for("nine rows", || home.status().count("done") == 9);
    assert_eq!(home.status().jobs.len(), 9);
    assert_eq!(home.results().quarantined(), [""; 0]);
    assert!(!daemon.has_ended());
    assert_eq!(daemon.terminate(), Some(0));
}

/// A file that may not be read is said to be so, and is taken once it may.
#[test]
fn a_file_without_permission_is_reported_and_taken_once_it_may_be_read() {
    let home = Home::with(
        "stable_for_ms = 100\n[retry]\nattempts = 1000\nfirst_ms = 100\nmost_ms = 200\n",
    );
    let path = home.drop("secret.obj", cuboid(1.0));
    home.drop("open.obj", cuboid(2.0));
    fs::set_permissions(&path, fs::Permissions::from_mode(0o000)).unwrap();
    let everybody = fs::Permissions::from_mode(0o777);
    fs::set_permissions(home.path(), everybody.clone()).unwrap();
    fs::set_permissions(home.inbox(), everybody).unwrap();

    let mut command = home.watch();
    if File::open(&path).is_ok() {
        // Who tests may read everything; nobody may not.
        let nobody = ["setpriv", "--reuid", "65534", "--clear-groups"];
        let program = command.get_program().to_str().unwrap();
        if !works(&[&nobody[..], &[program, "--version"]].concat()) {
            return skipped("every file can be read, and `setpriv` does not help");
        }
        command = behind(&nobody, &command);
    }
    let daemon = home.start_as(&mut command);
    daemon.wait_for("the other file", || home.labels("open.obj") == 6);
    daemon.wait_for("a word on it", || daemon.log().contains("secret.obj"));
    daemon.wait_for("its row", || home.status().is("secret.obj", "pending"));
    assert!(!home.result("secret.obj").exists());
    fs::set_permissions(&path, fs::Permissions::from_mode(0o644)).unwrap();
    daemon.wait_for("the file", || home.labels("secret.obj") == 6);
    assert_eq!(daemon.terminate(), Some(0));
}
