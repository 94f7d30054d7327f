//! The daemon as somebody runs it: started, watched over, changed, stopped.

use std::fs;
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use seamline_tests::daemon::{Daemon, Home, Metrics, Signal, cuboid, cuboids, leftovers, torus};
use seamline_tests::run;

const METRICS: &str = "[http]\nlisten = \"127.0.0.1:0\"\n";

/// A queue of one place and three hundred files: names wait, meshes do not.
#[test]
fn backpressure() {
    const FILES: u32 = 300;
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[daemon]\nworkers = 1\nqueue = 1\n{METRICS}"
    ));
    let mesh = torus(8000);
    for number in 0..FILES {
        let mut mesh = mesh.clone();
        mesh[..4].copy_from_slice(&number.to_le_bytes());
        home.drop(format!("part{number}.stl"), mesh);
    }
    let daemon = home.start();
    let [mut most_waiting, mut most_reserved, mut oldest] = [0.0f64; 3];
    let mut most_pending = 0;
    daemon.wait_for("all of them", || {
        let metrics = daemon.metrics();
        let take = |most: &mut f64, name| *most = most.max(metrics.value(name, &[]));
        take(&mut most_waiting, "seamline_queue_jobs");
        take(&mut most_reserved, "seamline_memory_reserved_bytes");
        take(&mut oldest, "seamline_oldest_pending_seconds");
        let status = home.status();
        most_pending = most_pending.max(status.count("pending"));
        status.count("done") == u64::from(FILES)
    });
    assert!(most_waiting > 200.0, "{most_waiting}");
    assert!(most_pending > 200, "{most_pending}");
    assert!(oldest > 0.0);
    // Three hundred of these meshes at once would be ten times as much.
    assert!(most_reserved < f64::from(96 << 20), "{most_reserved}");
    assert!(
        daemon.memory("VmHWM") < 160 << 20,
        "{}",
        daemon.memory("VmHWM")
    );
    for name in ["seamline_queue_jobs", "seamline_oldest_pending_seconds"] {
        daemon.wait_for(name, || daemon.metrics().value(name, &[]) == 0.0);
    }
    assert_eq!(daemon.terminate(), Some(0));
}

/// Waits until a mesh, the first there is, has been read and is being cut.
fn cutting(daemon: &Daemon) {
    let read = [("stage", "read")];
    daemon.wait_for("a mesh to be cut", || {
        daemon.metrics().observed("seamline_stage_seconds", &read) >= 1.0
    });
}

#[test]
fn sigterm_drains() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[daemon]\nworkers = 1\nqueue = 1\n{METRICS}"
    ));
    let daemon = home.start();
    home.drop("a-large.stl", torus(150_000));
    cutting(&daemon);
    for (name, text) in cuboids(40) {
        home.drop(name, text);
    }
    daemon.wait_for("the others to wait", || home.status().jobs.len() == 41);
    assert_eq!(daemon.terminate(), Some(0));
    // What ran is done, what waited waits, and no row says anything else.
    let status = home.status();
    assert!(status.is("a-large.stl", "done"), "{status:#?}");
    assert!(home.labels("a-large.stl") > 0);
    assert_eq!(status.count("running"), 0, "{status:#?}");
    assert_eq!(
        status.count("done") + status.count("pending"),
        41,
        "{status:#?}"
    );
    assert_eq!(leftovers(&home.path()), [""; 0]);
    assert_eq!(fs::read_dir(home.inbox()).unwrap().count(), 41);

    let daemon = home.start();
    daemon.wait_for("the others", || home.status().count("done") == 41);
    assert_eq!(daemon.terminate(), Some(0));
}

/// The other half of `sigterm_drains`: what does not end in time is given up, and is done the next time.
#[test]
fn sigterm_past_the_limit_gives_the_job_back() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[daemon]\ndrain_s = 0\n{METRICS}"
    ));
    let mut daemon = home.start();
    home.drop("large.stl", torus(300_000));
    cutting(&daemon);
    daemon.signal(Signal::Term);
    let code = daemon.wait_exit(Duration::from_secs(20));
    assert_eq!(code, Some(1), "{}", daemon.log());
    assert!(!home.result("large.stl").exists());
    let status = home.status();
    assert_eq!(status.only("large.stl").state, "pending", "{status:#?}");
    assert!(!status.daemon.running);

    let daemon = home.start();
    daemon.wait_for("the job", || home.status().is("large.stl", "done"));
    assert_eq!(leftovers(&home.path()), [""; 0]);
    assert_eq!(daemon.terminate(), Some(0));
}

fn angle(home: &Home, name: &str) -> Option<f64> {
    let report = home.results().report(name)?;
    report["settings"]["sharp"]["angle_deg"].as_f64()
}

/// By signal and by change of the file; wrong ones change nothing; a new folder is looked into.
#[test]
fn config_reload() {
    let with =
        |angle: &str| format!("stable_for_ms = 100\n{METRICS}\n[sharp]\nangle_deg = {angle}\n");
    let home = Home::with(&with("31.0"));
    let mut daemon = home.start();
    let reloads = |daemon: &Daemon, result| {
        let found = daemon
            .metrics()
            .find("seamline_reloads_total", &[("result", result)]);
        found.unwrap_or(0.0)
    };
    home.drop("first.obj", cuboid(1.0));
    daemon.wait_for("the first", || angle(&home, "first.obj") == Some(31.0));

    home.configure(&with("32.0"));
    daemon.signal(Signal::Hup);
    daemon.wait_for("a reload", || reloads(&daemon, "ok") >= 1.0);
    home.drop("second.obj", cuboid(2.0));
    daemon.wait_for("the second", || angle(&home, "second.obj") == Some(32.0));

    let before = reloads(&daemon, "ok");
    home.configure(&with("33.0"));
    daemon.wait_for("a reload by itself", || reloads(&daemon, "ok") > before);
    home.drop("third.obj", cuboid(3.0));
    daemon.wait_for("the third", || angle(&home, "third.obj") == Some(33.0));

    let refused = reloads(&daemon, "refused");
    home.configure(&with("34.0").replace("angle_deg", "angle_dge"));
    daemon.signal(Signal::Hup);
    daemon.wait_for("a refusal", || reloads(&daemon, "refused") > refused);
    let log = daemon.log();
    for word in [
        "watch.toml:8",
        "sharp.angle_dge",
        "did you mean `angle_deg`?",
    ] {
        assert!(log.contains(word), "`{word}` is not told: {log}");
    }
    home.drop("fourth.obj", cuboid(4.0));
    daemon.wait_for("the fourth", || angle(&home, "fourth.obj") == Some(33.0));

    fs::create_dir(home.at("second-inbox")).unwrap();
    fs::write(home.at("second-inbox/fifth.obj"), cuboid(5.0)).unwrap();
    let second = "\n[[watch]]\nroot = \"second-inbox\"\nstable_for_ms = 100\n";
    home.configure(&format!("{}{second}", with("35.0")));
    daemon.wait_for("the fifth", || angle(&home, "fifth.obj") == Some(35.0));
    fs::write(home.at("second-inbox/sixth.obj"), cuboid(6.0)).unwrap();
    daemon.wait_for("the sixth", || angle(&home, "sixth.obj") == Some(35.0));
    home.drop("seventh.obj", cuboid(7.0));
    daemon.wait_for("the seventh", || angle(&home, "seventh.obj") == Some(35.0));

    // What was done under earlier settings stays as it was.
    assert_eq!(angle(&home, "first.obj"), Some(31.0));
    assert_eq!(angle(&home, "third.obj"), Some(33.0));
    assert!(!daemon.has_ended());
    assert_eq!(daemon.terminate(), Some(0));
}

#[track_caller]
fn refused(home: &Home) -> String {
    let ran = home.once().ended(2);
    assert!(!home.at("out").exists() && !home.at("state").exists());
    assert_eq!(run(&mut home.watch()).code, Some(2));
    ran.err
}

#[test]
fn bad_config_exits_before_watching() {
    let cases = [
        (
            "stable_for_sm = 2\n",
            "watch.toml:3: watch.stable_for_sm",
            "did you mean `stable_for_ms`?",
        ),
        (
            "\n[pipeline]\nclassifer = \"kmeans\"\n",
            "watch.toml:5: pipeline.classifer",
            "did you mean `classifier`?",
        ),
        (
            "\n[outptu]\ndir = \"out\"\n",
            "watch.toml:4: outptu",
            "`output`",
        ),
        (
            "[retry]\nattempts = 0\n",
            "watch.toml:4: retry.attempts",
            "1 to 1000",
        ),
        (
            "[limits]\nmemory_limit_bytes = 5\n",
            "watch.toml:4: limits.memory_limit_bytes",
            "64 MiB",
        ),
        (
            "[http]\nlisten = \"nowhere\"\n",
            "watch.toml:4: http.listen",
            "127.0.0.1:9464",
        ),
        (
            "[log]\nformat = \"xml\"\n",
            "watch.toml:4: log.format",
            "`json`",
        ),
        (
            "max_wait_ms = 5\n",
            "watch.toml:3: watch.max_wait_ms",
            "stable_for_ms",
        ),
        (
            "exclude = [\"[a\"]\n",
            "watch.toml:3: watch.exclude",
            "*_backup.stl",
        ),
    ];
    for (text, place, hint) in cases {
        let said = refused(&Home::with(text));
        assert!(
            said.contains(place) && said.contains(hint),
            "{text}: {said}"
        );
    }
}

#[test]
fn output_inside_watch_is_refused() {
    for (table, key) in [
        ("output", "output.dir"),
        ("state", "state.dir"),
        ("quarantine", "quarantine.dir"),
        ("done", "done.dir"),
    ] {
        let said = refused(&Home::with(&format!("\n[{table}]\ndir = \"inbox/here\"\n")));
        let place = format!("watch.toml:5: {key}");
        assert!(said.contains(&place), "{said}");
        assert!(said.contains("inside the watched folder"), "{said}");
    }
}

/// Every family has its help and its kind, is told once, and moves with what happens.
#[test]
fn metrics_exist_and_move() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[daemon]\nrescan_ms = 2000\n{METRICS}"
    ));
    let daemon = home.start();
    let (alive, word) = daemon.get("/health");
    assert_eq!((alive, word.trim()), (200, "ok"));
    daemon.wait_for("readiness", || daemon.get("/ready").0 == 200);
    assert_eq!(daemon.get("/ready").1.trim(), "ready");
    assert_eq!(daemon.get("/no-such-page").0, 404);

    daemon.wait_for("the first look", || {
        daemon.metrics().value("seamline_scans_total", &[]) >= 1.0
    });
    let before = daemon.metrics();
    assert!(before.text.ends_with("# EOF\n"));
    let states = ["pending", "running", "done", "quarantined", "gone"];
    for state in states {
        assert_eq!(
            before.value("seamline_ledger_jobs", &[("state", state)]),
            0.0
        );
    }
    for name in [
        "seamline_queue_jobs",
        "seamline_oldest_pending_seconds",
        "seamline_overflows_total",
        "seamline_read_bytes_total",
        "seamline_memory_reserved_bytes",
        "seamline_paused",
        "seamline_abandoned_workers",
    ] {
        assert_eq!(before.value(name, &[]), 0.0, "{name}");
    }
    assert!(before.value("seamline_memory_limit_bytes", &[]) > 0.0);
    assert_eq!(
        before.value("seamline_watch_folders", &[("state", "present")]),
        1.0
    );
    assert_eq!(
        before.value("seamline_watch_folders", &[("state", "away")]),
        0.0
    );
    let version = [("version", env!("CARGO_PKG_VERSION"))];
    assert_eq!(before.value("seamline_build_info", &version), 1.0);

    let [good, same, bad] = [cuboid(1.0), cuboid(1.0), "v 0 0 0\nf 1 2 3\n".to_owned()];
    let bytes = good.len() + same.len() + bad.len();
    home.drop("good.obj", good);
    daemon.wait_for("the good one", || home.status().is("good.obj", "done"));
    home.drop("same.obj", same);
    home.drop("bad.obj", bad);
    daemon.wait_for("the others", || {
        home.status().is("same.obj", "done") && home.status().is("bad.obj", "quarantined")
    });
    daemon.wait_for("the counters", || {
        let metrics = daemon.metrics();
        let outcome = |outcome| metrics.find("seamline_jobs_total", &[("outcome", outcome)]);
        [
            outcome("done"),
            outcome("same_content"),
            outcome("quarantined"),
        ] == [Some(1.0); 3]
    });
    for (state, jobs) in [("done", 2.0), ("quarantined", 1.0), ("pending", 0.0)] {
        daemon.wait_for(state, || {
            let now = daemon.metrics();
            now.value("seamline_ledger_jobs", &[("state", state)]) == jobs
        });
    }
    let after = daemon.metrics();
    assert_eq!(after.value("seamline_read_bytes_total", &[]), bytes as f64);
    daemon.wait_for("another listing", || {
        let scans = |metrics: &Metrics| metrics.value("seamline_scans_total", &[]);
        scans(&daemon.metrics()) > scans(&before)
    });
    for stage in [
        "read",
        "import",
        "sharp",
        "curvature",
        "classify",
        "merge",
        "export",
        "write",
    ] {
        let observed = after.observed("seamline_stage_seconds", &[("stage", stage)]);
        assert!(observed >= 1.0, "{stage}\n{}", after.text);
    }
    assert!(after.observed("seamline_job_seconds", &[]) >= 1.0);

    for text in [&before.text, &after.text] {
        let kinds: Vec<_> = text
            .lines()
            .filter_map(|line| line.strip_prefix("# TYPE "))
            .collect();
        let mut names: Vec<_> = kinds.iter().map(|kind| kind.split(' ').next()).collect();
        names.sort();
        names.dedup();
        assert_eq!(
            names.len(),
            kinds.len(),
            "a family of metrics is told twice:\n{text}"
        );
    }
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn mtime_kept_on_move() {
    let home = Home::with("stable_for_ms = 100\nafter = \"move\"\n");
    let long_ago = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000);
    let path = home.drop("a/box.obj", cuboid(1.0));
    fs::File::options()
        .write(true)
        .open(&path)
        .unwrap()
        .set_modified(long_ago)
        .unwrap();
    home.once().ended(0);
    assert!(!path.exists());
    let moved = home.at("done/a/box.obj");
    assert_eq!(moved.metadata().unwrap().modified().unwrap(), long_ago);
    let status = home.status();
    let source = home.path().join("done/a/box.obj");
    assert_eq!(
        status.only("a/box.obj").source.as_deref(),
        Some(&*source),
        "{status:#?}"
    );

    home.drop("a/box.obj", cuboid(2.0));
    home.once().ended(0);
    assert_eq!(
        fs::read_to_string(home.at("done/a/box-1.obj")).unwrap(),
        cuboid(2.0)
    );
    assert_eq!(fs::read_to_string(moved).unwrap(), cuboid(1.0));

    // Content that was done before under another name goes the way of all, with results of its own.
    home.drop("a/again.obj", cuboid(2.0));
    home.once().ended(0);
    assert!(home.at("done/a/again.obj").exists());
    assert_eq!(home.results().names(), ["a/again.obj", "a/box.obj"]);
}

#[test]
fn a_file_is_deleted_only_after_its_results_are_written() {
    let home = Home::with("stable_for_ms = 100\nafter = \"delete\"\n");
    home.drop("good.obj", cuboid(1.0));
    home.drop("bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.once().ended(1);
    assert!(!home.inbox().join("good.obj").exists());
    assert_eq!(home.labels("good.obj"), 6);
    assert!(home.at("quarantine/bad.obj").exists());
}

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

#[test]
fn results_are_whole_and_nothing_lies_beside_them() {
    let home = Home::new();
    home.drop("box.obj", cuboid(1.0));
    home.once().ended(0);
    for name in ["labels.seg", "patches.ply", "boundaries.obj", "report.json"] {
        let file = home.result("box.obj").join(name);
        assert!(file.metadata().unwrap().len() > 0, "{name}");
    }
    let report = home.results().report("box.obj").unwrap();
    assert_eq!(report["schema_version"], 1);
    assert_eq!(report["input"]["faces"], 6);
    assert_eq!(report["patches"].as_array().unwrap().len(), 6);
    assert_eq!(fs::read_dir(home.at("out")).unwrap().count(), 1);
}

#[test]
fn two_runs_give_the_same_bytes() {
    let bytes = || {
        let home = Home::new();
        home.drop("box.obj", cuboid(1.0));
        home.once().ended(0);
        home.results().bytes("box.obj")
    };
    assert!(bytes() == bytes());
}

/// As JSON, every line is an object of its own.
#[test]
fn log_lines_can_be_read_by_programs() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[log]\nformat = \"json\"\n{METRICS}"
    ));
    let daemon = home.start();
    home.drop("box.obj", cuboid(1.0));
    home.drop("bad\nname.obj", "v 0 0 0\nf 1 2 3\n");
    daemon.wait_for("both", || {
        let status = home.status();
        status.count("done") == 1 && status.count("quarantined") == 1
    });
    sleep(Duration::from_millis(100));
    let log = daemon.log();
    assert!(log.lines().count() >= 3, "{log}");
    for line in log.lines() {
        let line: serde_json::Value =
            serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"));
        assert!(line.is_object());
    }
    assert_eq!(daemon.terminate(), Some(0));
}
