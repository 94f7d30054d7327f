//! Never more memory than the limit.

use std::time::Duration;

use seamline_tests::daemon::{Home, cuboid, torus};

use crate::METRICS;

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

/// By hand: `cargo test --release -p seamline-tests --test watch_faults bounded_memory_in_full -- --ignored --nocapture`,
/// with 30 GB of room where `TMPDIR` points to.
#[test]
#[ignore = "takes about 15 minutes and 30 GB"]
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
