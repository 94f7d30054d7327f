mod again;

use std::path::Path;
use std::thread;
use std::time::Duration;

use crossbeam_channel::{Sender, bounded, never};

use super::*;
use crate::ledger::{JobState, Row};
use crate::test_support::{HANGS, PANICS, REFUSED, SLOW, pipeline, strip};

/// A folder with `inbox` in it, and a configuration that watches it.
struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        let home = tempfile::tempdir().unwrap();
        fs::create_dir(home.path().join("inbox")).unwrap();
        Self(home)
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Drops a mesh of some faces into the folder, of a content no other name has.
    fn drop(&self, name: &str, faces: usize) {
        self.drop_text(name, &format!("# {name}\n{}", strip(faces)));
    }

    /// Drops a mesh of some faces, the same under every name.
    fn drop_plain(&self, name: &str, faces: usize) {
        self.drop_text(name, &strip(faces));
    }

    fn drop_text(&self, name: &str, text: &str) {
        let path = self.at("inbox").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn config(&self, more: &str) -> Config {
        self.config_stable_for(60, more)
    }

    fn config_stable_for(&self, stable_for_ms: u64, more: &str) -> Config {
        let path = self.at("watch.toml");
        let text = format!(
            "[[watch]]\nroot = 'inbox'\nstable_for_ms = {stable_for_ms}\n{more}\n[daemon]\nworkers = 2\nqueue = 1\n\
             [retry]\nattempts = 2\nfirst_ms = 20\n"
        );
        fs::write(&path, text).unwrap();
        Config::load(&path, &[]).unwrap()
    }

    fn rows(&self) -> Vec<Row> {
        Reader::open(&self.at("state")).unwrap().rows().unwrap()
    }

    fn states(&self) -> Vec<JobState> {
        self.rows().iter().map(|row| row.state).collect()
    }

    fn once(&self, more: &str) -> Summary {
        let options = RunOptions {
            once: true,
            dry_run: false,
        };
        run(setup(self.config(more)), None, options, never()).unwrap()
    }

    fn start(&self) -> Running {
        start(self.config(""))
    }

    fn has_result(&self, name: &str) -> bool {
        self.at("out")
            .join(format!("{name}.seamline/report.json"))
            .exists()
    }

    fn in_quarantine(&self, name: &str) -> Option<serde_json::Value> {
        let place = self.at("quarantine").join(name);
        let text = fs::read(crate::quarantine::reason_beside(&place)).ok()?;
        place
            .exists()
            .then(|| serde_json::from_slice(&text).unwrap())
    }
}

fn setup(config: Config) -> Setup {
    Setup::new(config, pipeline())
}

struct Running {
    stop: Sender<Order>,
    thread: thread::JoinHandle<Result<Summary, WatchError>>,
}

impl Running {
    fn stop(self) -> Summary {
        self.stop.send(Order::Stop).unwrap();
        self.thread.join().unwrap().unwrap()
    }
}

fn start(config: Config) -> Running {
    let (stop, stopped) = bounded(1);
    let thread = thread::spawn(move || run(setup(config), None, RunOptions::default(), stopped));
    Running { stop, thread }
}

fn wait_until(holds: impl Fn() -> bool) {
    for _ in 0..500 {
        if holds() {
            return;
        }
        thread::sleep(Duration::from_millis(20));
    }
    panic!("not within ten seconds");
}

fn summary(done: usize, failed: usize) -> Summary {
    Summary {
        done,
        failed,
        ..Summary::default()
    }
}

#[test]
fn once_deals_with_everything_that_is_there_and_ends() {
    let home = Home::new();
    for number in 0..20 {
        home.drop(&format!("{}/part{number}.obj", number % 3), 1);
    }
    home.drop_text("notes.txt", "not a mesh");
    home.drop_text("0/half.obj.part", "not a mesh");
    home.drop_text("empty.obj", "");
    assert_eq!(
        home.once(""),
        Summary {
            empty: 1,
            ..summary(20, 0)
        }
    );
    assert!((0..20).all(|number| home.has_result(&format!("{}/part{number}.obj", number % 3))));
    assert!(home.at("inbox/0/part0.obj").exists());
}

#[test]
fn a_bad_file_is_put_aside_and_the_others_go_on() {
    let home = Home::new();
    home.drop_text("a/bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.drop("a/refused.obj", REFUSED);
    home.drop("panics.obj", PANICS);
    for number in 0..4 {
        home.drop(&format!("part{number}.obj"), 2);
    }
    assert_eq!(home.once(""), summary(4, 3));

    assert_eq!(home.in_quarantine("a/bad.obj").unwrap()["stage"], "read");
    let refused = home.in_quarantine("a/refused.obj").unwrap();
    assert_eq!(refused["stage"], "grow");
    assert_eq!(refused["message"], "three faces are refused");
    assert_eq!(refused["hint"], "take another number of faces");
    assert_eq!(refused["blake3"].as_str().unwrap().len(), 64);
    let panicked = home.in_quarantine("panics.obj").unwrap();
    assert_eq!(panicked["message"], "panicked: four faces are too many");
    assert!(!home.at("inbox/a/bad.obj").exists() && !home.has_result("panics.obj"));
}

#[test]
fn a_worker_that_panicked_takes_the_next_mesh() {
    let home = Home::new();
    for number in 0..6 {
        home.drop(&format!("panics{number}.obj"), PANICS);
        home.drop(&format!("part{number}.obj"), 1);
    }
    assert_eq!(home.once(""), summary(6, 6));
}

#[test]
fn files_dropped_while_running_are_taken_once() {
    let home = Home::new();
    let running = home.start();
    wait_until(|| home.at("out").exists());
    for number in 0..5 {
        home.drop(&format!("new/part{number}.obj"), 2);
    }
    wait_until(|| (0..5).all(|number| home.has_result(&format!("new/part{number}.obj"))));
    thread::sleep(Duration::from_millis(300));
    assert_eq!(running.stop(), summary(5, 0));
}

#[test]
fn new_content_under_an_old_name_is_a_new_job() {
    let home = Home::new();
    let labels = home.at("out/part.obj.seamline/labels.seg");
    let lines = || fs::read_to_string(&labels).map_or(0, |text| text.lines().count());
    home.drop("part.obj", 2);
    let running = home.start();
    wait_until(|| lines() == 2);
    home.drop("part.obj", 7);
    wait_until(|| lines() == 7);
    assert_eq!(running.stop(), summary(2, 0));
}

#[test]
fn a_file_that_grows_waits_until_it_is_whole() {
    let home = Home::new();
    // Long against the pauses below, on a busy machine too.
    let running = start(home.config_stable_for(600, ""));
    let text = strip(40);
    for end in (0..text.len()).step_by(100) {
        home.drop_text("part.obj", &text[..end]);
        thread::sleep(Duration::from_millis(15));
        assert!(!home.has_result("part.obj"));
    }
    home.drop_text("part.obj", &text);
    wait_until(|| home.has_result("part.obj"));
    let labels = fs::read_to_string(home.at("out/part.obj.seamline/labels.seg")).unwrap();
    assert_eq!(labels.lines().count(), 40);
    assert_eq!(running.stop(), summary(1, 0));
}

#[test]
fn stopping_finishes_what_runs_and_drops_what_waits() {
    let home = Home::new();
    for number in 0..12 {
        home.drop(&format!("slow{number:02}.obj"), SLOW);
    }
    let running = home.start();
    wait_until(|| home.has_result("slow00.obj"));
    let summary = running.stop();
    let results = (0..12)
        .filter(|number| home.has_result(&format!("slow{number:02}.obj")))
        .count();
    assert_eq!(results, summary.done);
    assert!(summary.done < 12 && summary.failed == 0, "{summary:?}");
    assert_eq!(summary.done + summary.dropped, 12);
    assert_eq!(fs::read_dir(home.at("inbox")).unwrap().count(), 12);
}

#[test]
fn a_done_file_is_moved_or_deleted_as_wished() {
    for (after, moved) in [("move", true), ("delete", false)] {
        let home = Home::new();
        home.drop("a/part.obj", 1);
        assert_eq!(home.once(&format!("after = '{after}'")), summary(1, 0));
        assert!(home.has_result("a/part.obj"));
        assert!(!home.at("inbox/a/part.obj").exists());
        assert_eq!(home.at("done/a/part.obj").exists(), moved);
    }
}

#[test]
fn a_dry_run_says_what_would_be_taken_and_does_nothing() {
    let home = Home::new();
    home.drop("b.obj", 1);
    home.drop("a/a.obj", 1);
    home.drop_text("empty.obj", "");
    let options = RunOptions {
        once: false,
        dry_run: true,
    };
    let summary = run(setup(home.config("")), None, options, never()).unwrap();
    let inbox = home.at("inbox").canonicalize().unwrap();
    assert_eq!(summary.listed, [inbox.join("a/a.obj"), inbox.join("b.obj")]);
    assert!(!home.at("out").exists() && !home.at("state").exists());
}

#[test]
fn results_that_cannot_be_written_leave_the_file_where_it_is() {
    let home = Home::new();
    home.drop("part.obj", 1);
    fs::create_dir(home.at("out")).unwrap();
    fs::write(home.at("out/part.obj.seamline"), "in the way").unwrap();
    assert_eq!(home.once(""), summary(0, 1));
    assert!(home.at("inbox/part.obj").exists());
}

#[test]
fn results_of_two_folders_do_not_replace_each_other() {
    let home = Home::new();
    fs::create_dir(home.at("second")).unwrap();
    fs::write(home.at("second/part.obj"), strip(7)).unwrap();
    home.drop("part.obj", 2);
    let summary_of_both = home.once("[[watch]]\nroot = 'second'\nstable_for_ms = 60\n");
    assert_eq!(summary_of_both, summary(1, 1));
    let labels = fs::read_to_string(home.at("out/part.obj.seamline/labels.seg")).unwrap();
    assert_eq!(labels.lines().count(), 2);
    let reason = home.in_quarantine("part.obj").unwrap();
    assert!(
        reason["message"]
            .as_str()
            .unwrap()
            .contains("would replace")
    );
}

#[test]
fn leftovers_of_a_crash_are_swept_at_the_start() {
    let home = Home::new();
    fs::create_dir_all(home.at("out/a/.seamline-123.tmp")).unwrap();
    home.once("");
    assert!(home.at("out/a").exists() && !home.at("out/a/.seamline-123.tmp").exists());
}

#[test]
fn a_folder_that_cannot_be_created_ends_the_daemon_with_its_name() {
    let home = Home::new();
    let config = home.config("");
    fs::write(home.at("out"), "a file").unwrap();
    let error = run(setup(config), None, RunOptions::default(), never()).unwrap_err();
    assert!(
        error.to_string().contains("out cannot be created"),
        "{error}"
    );
    assert!(Path::new(&home.at("out")).is_file());
}

#[test]
fn a_mesh_that_hangs_costs_its_own_job_and_no_other() {
    let home = Home::new();
    for number in 0..3 {
        home.drop(&format!("hangs{number}.obj"), HANGS);
        home.drop(&format!("part{number}.obj"), 1 + 5 * number);
    }
    let summary = home.once("[limits]\njob_timeout_s = 1\n");
    assert_eq!((summary.done + summary.same, summary.failed), (3, 3));
    let reason = home.in_quarantine("hangs0.obj").unwrap();
    assert_eq!(reason["message"], "was not cut within 1 s");
}

#[test]
fn two_daemons_do_not_share_a_state_folder() {
    let home = Home::new();
    let running = home.start();
    wait_until(|| home.at("state/lock").exists());
    thread::sleep(Duration::from_millis(200));
    let options = RunOptions {
        once: true,
        dry_run: false,
    };
    let refused = run(setup(home.config("")), None, options, never()).unwrap_err();
    assert!(matches!(refused, WatchError::Locked(_)), "{refused}");
    running.stop();
}

#[test]
fn the_longest_names_have_results_and_reasons_too() {
    let home = Home::new();
    let [good, bad] = ["g", "b"].map(|letter| letter.repeat(251) + ".obj");
    home.drop(&good, 1);
    home.drop_text(&bad, "v 0 0 0\nf 1 2 3\n");
    assert_eq!(home.once("after = 'move'"), summary(1, 1));
    assert!(home.at("done").join(&good).exists());
    assert!(home.in_quarantine(&bad).is_some());
    let result = home.rows()[1].result.clone().unwrap();
    assert!(result.join("report.json").exists());
}
