//! Much to do, and told to stop in the middle of it.

use std::fs;
use std::time::Duration;

use seamline_tests::daemon::{Daemon, Home, Signal, cuboids, leftovers, torus};

use crate::METRICS;

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
