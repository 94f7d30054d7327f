//! What can be seen from outside: health, metrics, logs.

use std::thread::sleep;
use std::time::Duration;

use seamline_tests::daemon::{Home, Metrics, cuboid};

use crate::METRICS;

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
