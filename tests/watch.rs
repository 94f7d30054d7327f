//! The watch folder from outside: the real program on real folders.

use std::fs::{self, File};
use std::io::Write;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use seamline_tests::seamline;

/// A folder with `inbox` in it and a configuration beside that.
struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        Self::with("stable_for_ms = 300\n")
    }

    /// `more` is the end of the `[[watch]]` table, and whatever is to follow it.
    fn with(more: &str) -> Self {
        let home = Self(tempfile::tempdir().unwrap());
        fs::create_dir(home.at("inbox")).unwrap();
        fs::write(
            home.config(),
            format!("[[watch]]\nroot = \"inbox\"\n{more}"),
        )
        .unwrap();
        home
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn config(&self) -> PathBuf {
        self.at("watch.toml")
    }

    fn drop(&self, name: &str, text: &str) -> PathBuf {
        let path = self.at("inbox").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        path
    }

    fn once(&self) -> Output {
        seamline()
            .arg("watch")
            .arg(self.config())
            .arg("--once")
            .output()
            .unwrap()
    }

    fn start(&self) -> Daemon {
        let child = seamline()
            .arg("watch")
            .arg(self.config())
            .stdout(Stdio::null())
            .stderr(File::create(self.at("log")).unwrap())
            .spawn()
            .unwrap();
        wait_for("the folder of results", || self.at("out").exists());
        Daemon(child)
    }

    fn result(&self, name: &str) -> PathBuf {
        self.at("out").join(format!("{name}.seamline"))
    }

    fn labels(&self, name: &str) -> usize {
        let labels = fs::read_to_string(self.result(name).join("labels.seg"));
        labels.map_or(0, |text| text.lines().count())
    }
}

/// A running daemon; killed if a test ends without stopping it.
struct Daemon(Child);

impl Daemon {
    /// Sends SIGTERM and gives the exit code.
    fn terminate(mut self) -> Option<i32> {
        let killed = Command::new("kill")
            .args(["-TERM", &self.0.id().to_string()])
            .status()
            .unwrap();
        assert!(killed.success());
        self.0.wait().unwrap().code()
    }

    fn has_ended(&mut self) -> bool {
        self.0.try_wait().unwrap().is_some()
    }
}

impl Drop for Daemon {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn wait_for(what: &str, holds: impl Fn() -> bool) {
    let started = Instant::now();
    while !holds() {
        assert!(
            started.elapsed() < Duration::from_secs(30),
            "waited for {what}"
        );
        sleep(Duration::from_millis(20));
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A box of six squares, as OBJ.
fn cuboid(height: f64) -> String {
    let corners = (0..8).map(|i| {
        format!(
            "v {} {} {}\n",
            i & 1,
            i >> 1 & 1,
            f64::from(i >> 2) * height
        )
    });
    let faces = [
        "1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6",
    ];
    corners
        .chain(faces.iter().map(|face| format!("f {face}\n")))
        .collect()
}

#[test]
fn files_present_at_start_go_through_the_same_tracker() {
    let home = Home::new();
    home.drop("box.obj", &cuboid(1.0));
    home.drop("deeper/still/BOX.OBJ", &cuboid(2.0));
    let output = home.once();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(home.labels("box.obj"), 6);
    assert_eq!(home.labels("deeper/still/BOX.OBJ"), 6);
    assert!(home.at("inbox/box.obj").exists());
}

#[test]
fn results_are_whole_and_nothing_lies_beside_them() {
    let home = Home::new();
    home.drop("box.obj", &cuboid(1.0));
    home.once();
    for name in ["labels.seg", "patches.ply", "boundaries.obj", "report.json"] {
        assert!(
            home.result("box.obj").join(name).metadata().unwrap().len() > 0,
            "{name}"
        );
    }
    let report = fs::read(home.result("box.obj").join("report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
    assert_eq!(report["schema_version"], 1);
    assert_eq!(report["input"]["faces"], 6);
    assert_eq!(report["patches"].as_array().unwrap().len(), 6);
    assert_eq!(fs::read_dir(home.at("out")).unwrap().count(), 1);
}

#[test]
fn two_runs_give_the_same_bytes() {
    let home = Home::new();
    home.drop("box.obj", &cuboid(1.0));
    let bytes = || {
        home.once();
        let file = |name: &str| fs::read(home.result("box.obj").join(name)).unwrap();
        let mut report: serde_json::Value = serde_json::from_slice(&file("report.json")).unwrap();
        report.as_object_mut().unwrap().remove("seconds").unwrap();
        (
            ["labels.seg", "patches.ply", "boundaries.obj"].map(file),
            report.to_string(),
        )
    };
    assert!(bytes() == bytes());
}

#[test]
fn files_dropped_while_it_runs_are_taken_once() {
    let home = Home::new();
    let daemon = home.start();
    for number in 0..10 {
        home.drop(
            &format!("new/box{number}.obj"),
            &cuboid(f64::from(number + 1)),
        );
    }
    let done = |number| home.labels(&format!("new/box{number}.obj")) == 6;
    wait_for("ten results", || (0..10).all(done));
    let written = || {
        home.result("new/box3.obj")
            .join("report.json")
            .metadata()
            .unwrap()
            .modified()
            .unwrap()
    };
    let first = written();
    sleep(Duration::from_millis(1000));
    assert_eq!(written(), first);
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn half_written_file_waits() {
    let home = Home::with("stable_for_ms = 1000\n");
    let daemon = home.start();
    let text = cuboid(1.0);
    let path = home.drop("box.obj", "");
    for piece in text.as_bytes().chunks(text.len() / 8) {
        File::options()
            .append(true)
            .open(&path)
            .unwrap()
            .write_all(piece)
            .unwrap();
        sleep(Duration::from_millis(300));
        assert!(!home.result("box.obj").exists());
    }
    wait_for("the result", || home.labels("box.obj") == 6);
    assert!(!home.at("quarantine/box.obj").exists());
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn rename_into_folder_is_picked_up() {
    let home = Home::new();
    let daemon = home.start();
    fs::write(home.at("elsewhere.obj"), cuboid(1.0)).unwrap();
    fs::rename(home.at("elsewhere.obj"), home.at("inbox/box.obj")).unwrap();
    wait_for("the result", || home.labels("box.obj") == 6);
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn temp_suffix_ignored() {
    let home = Home::with("stable_for_ms = 100\ninclude = [\"*\"]\n");
    for name in [
        "a.obj.part",
        "b.obj.tmp",
        "c.filepart",
        "d.crdownload",
        "e.obj~",
        "._f.obj",
        ".g.obj",
    ] {
        home.drop(name, "half a mesh");
    }
    home.drop("box.obj", &cuboid(1.0));
    let output = home.once();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(fs::read_dir(home.at("out")).unwrap().count(), 1);
    assert_eq!(fs::read_dir(home.at("quarantine")).unwrap().count(), 0);
}

#[test]
fn poison_file_quarantined() {
    let home = Home::new();
    let mut daemon = home.start();
    home.drop("a/bad.stl", "this is no mesh at all\n");
    home.drop("a/bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.drop("box.obj", &cuboid(1.0));
    wait_for("the good result", || home.labels("box.obj") == 6);
    for name in ["a/bad.stl", "a/bad.obj"] {
        let reason = home.at(&format!("quarantine/{name}.error.json"));
        wait_for(name, || reason.exists());
        let reason: serde_json::Value = serde_json::from_slice(&fs::read(reason).unwrap()).unwrap();
        for key in [
            "stage",
            "message",
            "hint",
            "path",
            "blake3",
            "program_version",
        ] {
            assert!(
                reason[key].as_str().is_some_and(|text| !text.is_empty()),
                "{name}: {key}"
            );
        }
        assert_eq!(reason["attempts"], 1);
        assert!(reason["settings"].is_object());
        assert!(home.at("quarantine").join(name).exists());
        assert!(!home.at("inbox").join(name).exists());
        assert!(!home.result(name).exists());
    }
    assert!(!daemon.has_ended());
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn once_with_a_bad_file_names_it_and_fails_after_the_others_are_done() {
    let home = Home::new();
    home.drop("bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.drop("box.obj", &cuboid(1.0));
    let output = home.once();
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("bad.obj"), "{}", said(&output));
    assert_eq!(home.labels("box.obj"), 6);
    assert!(home.at("quarantine/bad.obj.error.json").exists());
}

#[test]
fn once_on_an_empty_folder_is_all_done() {
    let output = Home::new().once();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
}

#[test]
fn dry_run_says_what_would_be_done_and_does_none_of_it() {
    let home = Home::new();
    home.drop("a/box.obj", &cuboid(1.0));
    let output = seamline()
        .arg("watch")
        .arg(home.config())
        .arg("--dry-run")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("a/box.obj"));
    assert!(
        !home.at("out").exists() && !home.at("quarantine").exists() && !home.at("state").exists()
    );
}

#[test]
fn sigterm_drains() {
    let home = Home::with("stable_for_ms = 100\n");
    for number in 0..40 {
        home.drop(&format!("box{number}.obj"), &cuboid(f64::from(number + 1)));
    }
    let daemon = home.start();
    wait_for("the first results", || {
        fs::read_dir(home.at("out")).is_ok_and(|entries| entries.count() > 1)
    });
    assert_eq!(daemon.terminate(), Some(0));
    for entry in fs::read_dir(home.at("out")).unwrap() {
        let folder = entry.unwrap().path();
        assert!(folder.join("report.json").exists(), "{}", folder.display());
    }
    assert_eq!(fs::read_dir(home.at("inbox")).unwrap().count(), 40);
}

#[test]
fn mtime_kept_on_move() {
    let home = Home::with("stable_for_ms = 100\nafter = \"move\"\n");
    let path = home.drop("a/box.obj", &cuboid(1.0));
    let modified = path.metadata().unwrap().modified().unwrap();
    assert_eq!(home.once().status.code(), Some(0));
    assert!(!path.exists());
    assert_eq!(
        home.at("done/a/box.obj")
            .metadata()
            .unwrap()
            .modified()
            .unwrap(),
        modified
    );

    home.drop("a/box.obj", &cuboid(2.0));
    assert_eq!(home.once().status.code(), Some(0));
    assert!(home.at("done/a/box-1.obj").exists());
}

fn refused(home: &Home) -> String {
    let output = home.once();
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(!home.at("out").exists() && !home.at("state").exists());
    said(&output)
}

#[test]
fn bad_config_exits_before_watching() {
    let frame = refused(&Home::with("stable_for_sm = 2\n"));
    assert!(
        frame.contains("watch.toml:3: watch.stable_for_sm"),
        "{frame}"
    );
    assert!(frame.contains("did you mean `stable_for_ms`?"), "{frame}");

    let pipeline = refused(&Home::with("\n[pipeline]\nclassifer = \"kmeans\"\n"));
    assert!(
        pipeline.contains("watch.toml:5: pipeline.classifer"),
        "{pipeline}"
    );
    assert!(
        pipeline.contains("did you mean `classifier`?"),
        "{pipeline}"
    );

    let table = refused(&Home::with("\n[outptu]\ndir = \"out\"\n"));
    assert!(
        table.contains("watch.toml:4: outptu") && table.contains("`output`"),
        "{table}"
    );
}

#[test]
fn output_inside_watch_is_refused() {
    let text = refused(&Home::with("\n[output]\ndir = \"inbox/out\"\n"));
    assert!(
        text.contains("watch.toml:5: output.dir") && text.contains("inside the watched folder"),
        "{text}"
    );
}
