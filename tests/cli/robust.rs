//! What must not bring the program down.

use std::ffi::OsStr;
use std::fs::File;
use std::os::unix::ffi::OsStrExt;
use std::process::Stdio;

use seamline_tests::run;

use crate::home::Home;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn full_disk() -> File {
    File::options()
        .write(true)
        .open("/dev/full")
        .expect("this system has /dev/full")
}

#[test]
fn a_reader_that_goes_away_has_seen_enough() {
    let home = Home::new();
    let mut child = home
        .command("config schema")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    drop(child.stdout.take());
    let ended = child.wait_with_output().expect("it ends");
    assert_eq!(
        ended.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&ended.stderr)
    );
}

#[test]
fn standard_output_on_a_full_disk_is_told_in_one_line() {
    let home = Home::new();
    home.put("part.obj", TRIANGLE);
    for line in [
        "plugins",
        "plugins --json",
        "inspect part.obj",
        "config schema",
        "segment --json -q part.obj",
    ] {
        let ran = run(home.command(line).stdout(full_disk())).ended(1);
        assert_eq!(ran.err.lines().count(), 1, "{line}: {}", ran.err);
        assert!(ran.err.starts_with("error: "), "{line}: {}", ran.err);
    }
}

#[test]
fn a_log_that_cannot_be_written_stops_no_work() {
    let home = Home::new();
    home.put("inbox/part.obj", TRIANGLE);
    home.put(
        "watch.toml",
        "[[watch]]\nroot = 'inbox'\nstable_for_ms = 50\n",
    );
    run(home.command("watch watch.toml --once").stderr(full_disk())).ended(0);
    run(home
        .command("segment inbox/part.obj -o out2")
        .stderr(full_disk()))
    .ended(0);
    assert_eq!(home.labels("out/part.obj.seamline"), [0]);
    assert_eq!(home.labels("out2/part.obj.seamline"), [0]);
}

#[test]
fn a_variable_that_is_not_text_is_wrong_use_if_it_is_ours_and_nothing_if_it_is_not() {
    let home = Home::new();
    home.put("part.obj", TRIANGLE);
    let not_text = OsStr::from_bytes(b"\xff");
    run(home.command("segment part.obj").env("ANOTHER", not_text)).ended(0);
    let ran = run(home
        .command("segment part.obj")
        .env("SEAMLINE_PROFILE", not_text))
    .ended(2);
    assert!(
        ran.err.contains("SEAMLINE_PROFILE: is not text"),
        "{}",
        ran.err
    );
}

#[test]
fn values_out_of_range_are_wrong_use_and_named_by_their_key() {
    let home = Home::new();
    home.put("part.obj", TRIANGLE);
    for setting in [
        "kmeans.max_rounds=0",
        "kmeans.clusters=0",
        "kmeans.clusters=100000",
        "pipeline.threads=1000000",
        "merge.threshold=inf",
        "merge.threshold=nan",
        "merge.regions=-1",
        "merge.distance=absolute",
        "mesh.scale=box",
        "sharp.angle_deg=0",
        "facets.median_rounds=4294967295",
        "curvature.ball_radius=2",
        "curvature.tensor=blob",
    ] {
        let ran = home
            .run(&format!("segment part.obj -o out --set {setting}"))
            .ended(2);
        let key = setting.split('=').next().expect("a key");
        assert!(
            ran.err.starts_with(&format!("error: {key}: ")),
            "{setting}: {}",
            ran.err
        );
        assert_eq!(ran.err.lines().count(), 1, "{setting}: {}", ran.err);
    }
    assert!(home.listed("out").is_empty());
}

#[test]
fn an_output_that_is_a_file_is_wrong_use() {
    let home = Home::new();
    home.put("part.obj", TRIANGLE);
    let ran = home.run("segment part.obj -o part.obj").ended(2);
    assert!(ran.err.contains("part.obj: is not a folder"), "{}", ran.err);
}

#[test]
fn a_part_too_large_to_compute_with_is_refused() {
    let home = Home::new();
    home.put("part.obj", TRIANGLE.replace("1 0 0", "1e200 0 0"));
    let ran = home.run("segment part.obj -o out").ended(1);
    assert!(ran.err.contains("the part is 1e200 long"), "{}", ran.err);
    assert!(home.listed("out").is_empty());
}

#[test]
fn a_plate_whose_faces_are_there_twice_is_one_patch() {
    let home = Home::new();
    let side = 8;
    let mut obj = String::new();
    for (x, y) in (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y))) {
        obj += &format!("v {x} {y} 0\n");
    }
    for _ in 0..2 {
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            let a = y * (side + 1) + x + 1;
            obj += &format!("f {a} {} {} {}\n", a + 1, a + side + 2, a + side + 1);
        }
    }
    home.put("plate.obj", obj);
    home.run("segment plate.obj").ended(0);
    assert_eq!(home.labels("plate.obj.seamline"), vec![0; 128]);
    let report = home.json("plate.obj.seamline/report.json");
    assert_eq!(report["findings"]["duplicate_faces"], 64);
    assert_eq!(report["patches"][0]["area"], 64.0);
}

#[test]
fn patches_that_meet_at_a_non_manifold_edge_are_neighbours_all_of_them() {
    let home = Home::new();
    let fan = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n";
    home.put("fan.obj", fan);
    home.run("segment fan.obj").ended(0);
    assert_eq!(home.labels("fan.obj.seamline"), [0, 1, 2]);
    let report = home.json("fan.obj.seamline/report.json");
    let pairs: Vec<_> = report["boundaries"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|b| b["patches"].to_string())
        .collect();
    assert_eq!(pairs, ["[0,1]", "[0,2]", "[1,2]"]);
    assert!(
        report["boundaries"]
            .as_array()
            .expect("a list")
            .iter()
            .all(|b| b["length"] == 1.0)
    );
}

#[test]
fn a_cube_every_third_triangle_of_which_is_inside_out_has_six_patches() {
    let home = Home::new();
    let mut text = String::new();
    for i in 0..8 {
        text += &format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2);
    }
    let squares = [
        [1, 3, 4, 2],
        [5, 6, 8, 7],
        [1, 2, 6, 5],
        [3, 7, 8, 4],
        [1, 5, 7, 3],
        [2, 4, 8, 6],
    ];
    let halves = squares
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    for (i, [a, b, c]) in halves.enumerate() {
        text += &if i % 3 == 0 {
            format!("f {a} {c} {b}\n")
        } else {
            format!("f {a} {b} {c}\n")
        };
    }
    home.put("cube.obj", text);
    home.run("segment cube.obj").ended(0);
    let labels = home.labels("cube.obj.seamline");
    assert_eq!(labels, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
    let report = home.json("cube.obj.seamline/report.json");
    let stages = report["stages"].as_array().expect("stages");
    let import = stages.iter().find(|stage| stage["stage"] == "import");
    assert_eq!(
        import.expect("it is there")["counts"]["turned_triangles"],
        4
    );
    // What the file was like is told as it was.
    let oriented = serde_json::to_string(&report)
        .expect("JSON")
        .contains("\"oriented\":false");
    assert!(oriented);
}
