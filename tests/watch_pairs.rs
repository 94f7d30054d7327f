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

/// The same without its last face, and its labels.
fn open_cuboid() -> (String, String) {
    let whole = cuboid(1.0);
    let (open, _) = whole.trim_end().rsplit_once('\n').expect("it has faces");
    let labels = labels();
    (format!("{open}\n"), labels[..labels.len() - 2].to_owned())
}

/// As a PLY, with the same faces.
fn as_ply(obj: &str) -> String {
    let rows = |start: &str| -> Vec<Vec<&str>> {
        let of = obj.lines().filter_map(|line| line.strip_prefix(start));
        of.map(|line| line.split_whitespace().collect()).collect()
    };
    let [vertices, faces] = ["v ", "f "].map(rows);
    let mut ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        vertices.len(),
        faces.len()
    );
    for vertex in vertices {
        ply += &format!("{}\n", vertex.join(" "));
    }
    for face in faces {
        let corners = face
            .iter()
            .map(|corner| corner.parse::<usize>().expect("a vertex"));
        let corners: Vec<String> = corners.map(|corner| (corner - 1).to_string()).collect();
        ply += &format!("{} {}\n", corners.len(), corners.join(" "));
    }
    ply
}

#[test]
fn a_mesh_written_anew_before_its_labels_waits_for_them_and_is_cut_with_the_new_ones() {
    for after in ["keep", "move"] {
        let home = Home::with(&format!(
            "stable_for_ms = 200\nmax_wait_ms = 60000\nafter = \"{after}\"\n{RULE}"
        ));
        let (open, five) = open_cuboid();
        let daemon = home.start();
        home.drop("pairs/part.seg", labels());
        home.drop("pairs/part.obj", &open);
        daemon.wait_for("they are found not to fit", || {
            daemon.log().contains("labels for 5 faces")
        });
        assert!(home.reason("pairs/part.obj").is_none());
        home.drop("pairs/part.seg", five);
        daemon.wait_for("it is cut", || home.labels("pairs/part.obj") == 5);
        assert_eq!(daemon.terminate(), Some(0));
    }
}

#[test]
fn labels_written_anew_after_their_mesh_was_cut_have_it_cut_again() {
    let home = Home::with(&format!("stable_for_ms = 200\n{RULE}"));
    let patches = || {
        let report = home.results().report("pairs/part.obj");
        report.and_then(|report| report["patches"].as_array().map(Vec::len))
    };
    let daemon = home.start();
    home.drop("pairs/part.seg", labels());
    home.drop("pairs/part.obj", cuboid(1.0));
    daemon.wait_for("it is cut", || patches() == Some(6));
    home.drop("pairs/part.obj", cuboid(2.0));
    daemon.wait_for("it is cut with the labels that are there", || {
        daemon.log().matches("cut in").count() == 2
    });
    home.drop("pairs/part.seg", "1\n".repeat(6));
    daemon.wait_for("it is cut with the new ones", || patches() == Some(1));
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn requeue_joins_labels_that_came_too_late_with_their_mesh() {
    let home = pairs(60_000);
    let (open, five) = open_cuboid();
    home.drop("pairs/part.obj", open);
    home.drop("pairs/part.seg", labels());
    home.once().ended(1);
    assert!(home.reason("pairs/part.obj").is_some());
    home.drop("pairs/part.seg", &five);
    home.once().ended(1);
    home.requeue(&["--all-quarantined"]);
    let beside = fs::read_to_string(home.inbox().join("pairs/part.seg"));
    assert_eq!(beside.expect("they are brought back"), five);
    assert!(!home.inbox().join("pairs/part-1.seg").exists());
    home.once().ended(0);
    assert_eq!(home.labels("pairs/part.obj"), 5);
}

#[test]
fn a_lone_half_that_was_requeued_waits_no_longer_once_it_is_part_of_a_pair() {
    let home = Home::with(&format!("stable_for_ms = 200\nmax_wait_ms = 1000\n{RULE}"));
    home.drop("pairs/part.seg", labels());
    home.once().ended(1);
    home.requeue(&["--all-quarantined"]);
    home.drop("pairs/part.obj", cuboid(1.0));
    home.once().ended(0);
    assert_eq!(home.labels("pairs/part.obj"), 6);
    let status = home.status();
    assert_eq!(
        status.counts.get("pending").copied().unwrap_or(0),
        0,
        "{status:?}"
    );
}

#[test]
fn meshes_of_one_stem_share_their_labels_which_are_moved_with_the_last_of_them() {
    let home = pairs(60_000);
    home.drop("pairs/part.obj", cuboid(1.0));
    home.drop("pairs/part.ply", as_ply(&cuboid(2.0)));
    home.drop("pairs/part.seg", labels());
    home.once().ended(0);
    for name in ["part.obj", "part.ply"] {
        let name = format!("pairs/{name}");
        assert_eq!(home.labels(&name), 6, "{name}");
        assert!(home.at("done").join(&name).exists(), "{name}");
    }
    assert!(home.at("done/pairs/part.seg").exists());
    assert!(!home.inbox().join("pairs/part.seg").exists());
}

#[test]
fn a_mesh_that_fails_takes_a_copy_of_labels_that_another_needs() {
    let home = pairs(60_000);
    let (open, _) = open_cuboid();
    home.drop("pairs/part.obj", open);
    home.drop("pairs/part.ply", as_ply(&cuboid(1.0)));
    home.drop("pairs/part.seg", labels());
    home.once().ended(1);
    assert_eq!(home.labels("pairs/part.ply"), 6);
    assert!(home.reason("pairs/part.obj").is_some());
    assert!(home.at("quarantine/pairs/part.seg").exists());
    assert!(home.at("done/pairs/part.seg").exists());
}
