//! What is there afterwards: results, and the sources where they were to go.

use std::fs;
use std::time::{Duration, SystemTime};

use seamline_tests::daemon::{Home, cuboid};

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
