//! A watched folder that delivers pairs: a mesh, and what another tool has marked on it.

use std::fs;
use std::time::Duration;

use seamline_tests::daemon::{Home, cuboid};
use seamline_tests::run;

const RULE: &str = "[[rules]]\nfiles = [\"pairs/**\"]\npipeline = \"rectify\"\n";

fn pairs(max_wait_ms: u64) -> Home {
    Home::with(&format!(
        "stable_for_ms = 200\nmax_wait_ms = {max_wait_ms}\nafter = \"move\"\n{RULE}"
    ))
}

/// A label for each side of a cuboid.
fn labels() -> String {
    (0..6).map(|face| format!("{face}\n")).collect()
}

#[test]
fn a_pair_is_rectified_once_both_halves_are_there_and_both_are_moved() {
    let home = pairs(60_000);
    let daemon = home.start();
    home.drop("pairs/part.obj", cuboid(1.0));
    std::thread::sleep(Duration::from_millis(800));
    assert_eq!(home.labels("pairs/part.obj"), 0, "half of it is enough");
    home.drop("pairs/part.seg", labels());
    daemon.wait_for("both are moved", || home.at("done/pairs/part.seg").exists());
    assert!(home.at("done/pairs/part.obj").exists());
    assert_eq!(home.labels("pairs/part.obj"), 6);
    let report = home.results().report("pairs/part.obj").expect("a report");
    assert_eq!(report["input"]["markings"]["count"], 6);
    assert_eq!(report["settings"]["pipeline"]["kind"], "rectify");
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn a_lone_half_waits_and_is_then_quarantined_with_that_reason() {
    let home = pairs(1_000);
    let daemon = home.start();
    home.drop("pairs/mesh.obj", cuboid(1.0));
    home.drop("pairs/marks.seg", labels());
    daemon.wait_for("both are in quarantine", || {
        home.reason("pairs/mesh.obj").is_some() && home.reason("pairs/marks.seg").is_some()
    });
    let reason = |name: &str| {
        let reason = home.reason(name).expect("it is in quarantine");
        [&reason["message"], &reason["hint"]]
            .map(|text| text.as_str().unwrap_or_default().to_owned())
    };
    let [message, hint] = reason("pairs/mesh.obj");
    assert_eq!(message, "has no labels and no edges beside it");
    assert!(hint.contains("mesh.seg or mesh.edges.txt"), "{hint}");
    let [message, hint] = reason("pairs/marks.seg");
    assert_eq!(message, "has no mesh beside it");
    assert!(
        hint.contains("marks.stl or marks.obj or marks.ply"),
        "{hint}"
    );
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn files_that_no_rule_pairs_are_cut_alone() {
    let home = pairs(60_000);
    home.drop("alone.obj", cuboid(1.0));
    home.drop("alone.seg", labels());
    home.once().ended(0);
    assert_eq!(home.labels("alone.obj"), 6);
    assert!(home.inbox().join("alone.seg").exists());
}

#[test]
fn markings_that_do_not_fit_put_the_pair_into_quarantine_and_requeue_brings_both_back() {
    let home = pairs(60_000);
    home.drop("pairs/part.obj", cuboid(1.0));
    home.drop("pairs/part.edges.txt", "0 1\n0 99\n");
    home.once().ended(1);
    let reason = home.reason("pairs/part.obj").expect("it is in quarantine");
    let message = reason["message"].as_str().unwrap_or_default().to_owned();
    assert!(
        message.starts_with("part.edges.txt: line 2: vertex 99"),
        "{message}"
    );
    assert!(home.at("quarantine/pairs/part.edges.txt").exists());
    home.requeue(&["--all-quarantined"]);
    assert!(home.inbox().join("pairs/part.obj").exists());
    assert!(home.inbox().join("pairs/part.edges.txt").exists());
    fs::remove_file(home.inbox().join("pairs/part.edges.txt")).expect("it was brought back");
    home.drop("pairs/part.seg", labels());
    home.once().ended(0);
    assert_eq!(home.labels("pairs/part.obj"), 6);
}

#[test]
fn other_labels_for_the_same_mesh_are_another_job() {
    let home = Home::with(&format!("stable_for_ms = 200\n{RULE}"));
    home.drop("pairs/part.obj", cuboid(1.0));
    home.drop("pairs/part.seg", labels());
    home.once().ended(0);
    assert_eq!(home.once().ended(0).err.matches("cut in").count(), 0);
    let patches = || {
        let report = home.results().report("pairs/part.obj").expect("a report");
        report["patches"].as_array().map(Vec::len)
    };
    assert_eq!(patches(), Some(6));
    home.drop("pairs/part.seg", "1\n".repeat(6));
    home.once().ended(0);
    assert_eq!(patches(), Some(1));
}

#[test]
fn a_mesh_with_labels_and_edges_beside_it_is_quarantined_and_the_one_that_stays_serves() {
    let home = pairs(60_000);
    home.drop("pairs/part.obj", cuboid(1.0));
    home.drop("pairs/part.seg", labels());
    home.drop("pairs/part.edges.txt", "0 1\n");
    home.once().ended(1);
    let reason = home.reason("pairs/part.obj").expect("it is in quarantine");
    let message = "has labels and edges beside it, part.seg and part.edges.txt";
    assert_eq!(reason["message"], message);
    fs::remove_file(home.inbox().join("pairs/part.edges.txt")).expect("it is where it was");
    home.requeue(&["--all-quarantined"]);
    home.once().ended(0);
    assert_eq!(home.labels("pairs/part.obj"), 6);
}

#[test]
fn a_dry_run_lists_pairs_by_their_mesh_and_markings_without_one_by_themselves() {
    let home = pairs(60_000);
    home.drop("pairs/part.obj", cuboid(1.0));
    home.drop("pairs/part.seg", labels());
    home.drop("pairs/lone.seg", labels());
    home.drop("alone.obj", cuboid(2.0));
    home.drop("alone.seg", labels());
    let told = run(home.watch().arg("--dry-run")).ended(0).out;
    let mut names: Vec<&str> = told
        .lines()
        .filter_map(|line| line.rsplit('/').next())
        .collect();
    names.sort_unstable();
    assert_eq!(names, ["alone.obj", "lone.seg", "part.obj"]);
}
