//! What is remembered: nothing is done twice, and nothing that was done is lost.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::os::unix::fs::MetadataExt;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

use rusqlite::Connection;
use seamline_tests::daemon::{Home, Job, Status, cuboid, cuboids, leftovers, torus};
use seamline_tests::{run, seamline};

const METRICS: &str = "[http]\nlisten = \"127.0.0.1:0\"\n";

/// Where the results of a job are: its own, or those of the job of the same content.
fn result_of<'s>(status: &'s Status, job: &'s Job) -> Option<&'s Path> {
    let holder = job.same_as.unwrap_or(job.id);
    let holder = status.jobs.iter().find(|job| job.id == holder)?;
    assert_eq!(holder.content, job.content, "{status:#?}");
    holder.result.as_deref()
}

#[test]
fn same_content_twice_one_job() {
    let home = Home::with(&format!("stable_for_ms = 100\n{METRICS}"));
    let daemon = home.start();
    home.drop("first.obj", cuboid(1.0));
    daemon.wait_for("the first", || home.status().is("first.obj", "done"));
    let made = || home.result("first.obj").metadata().unwrap().ino();
    let first_made = made();

    home.drop("deep/second.obj", cuboid(1.0));
    daemon.wait_for("the second", || home.status().is("deep/second.obj", "done"));
    home.drop("first.obj", cuboid(1.0));
    let touched = || home.status().jobs_of("first.obj").len() == 2;
    daemon.wait_for("the first once more", || {
        touched() && home.status().is("first.obj", "done")
    });

    let status = home.status();
    let first = status.jobs_of("first.obj")[0];
    let second = status.only("deep/second.obj");
    assert_eq!(first.same_as, None);
    assert_eq!(
        result_of(&status, second),
        Some(&*home.path().join("out/first.obj.seamline"))
    );
    assert_eq!(
        result_of(&status, status.latest("first.obj").unwrap()),
        result_of(&status, second)
    );
    assert_eq!(second.content, first.content);
    assert_eq!(home.results().names(), ["first.obj"]);
    assert_eq!(made(), first_made);
    let metrics = daemon.metrics();
    let jobs = |outcome| metrics.find("seamline_jobs_total", &[("outcome", outcome)]);
    assert_eq!(jobs("done"), Some(1.0));
    assert_eq!(jobs("same_content"), Some(2.0));
    assert_eq!(daemon.terminate(), Some(0));

    // Also after a restart.
    let daemon = home.start();
    home.drop("third.obj", cuboid(1.0));
    daemon.wait_for("the third", || home.status().is("third.obj", "done"));
    let status = home.status();
    assert_eq!(
        result_of(&status, status.only("third.obj")),
        Some(&*home.path().join("out/first.obj.seamline"))
    );
    assert_eq!(made(), first_made);
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn same_content_under_other_settings_is_another_job() {
    let home = Home::with("stable_for_ms = 100\n");
    let daemon = home.start();
    home.drop("first.obj", cuboid(1.0));
    daemon.wait_for("the first", || home.status().is("first.obj", "done"));
    assert_eq!(daemon.terminate(), Some(0));

    // Under other settings nothing of what lies there has been done.
    home.configure("stable_for_ms = 100\n[sharp]\nangle_deg = 33.0\n");
    let daemon = home.start();
    let again = || home.status().jobs_of("first.obj").len() == 2;
    daemon.wait_for("it to be done again", || {
        again() && home.status().is("first.obj", "done")
    });
    let status = home.status();
    let [first, second] = status.jobs_of("first.obj")[..] else {
        panic!("{status:#?}");
    };
    assert_eq!(second.same_as, None, "{status:#?}");
    assert_eq!(second.content, first.content);
    assert_ne!(second.settings, first.settings);
    let report = home.results().report("first.obj").unwrap();
    assert_eq!(report["settings"]["sharp"]["angle_deg"], 33.0);
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn same_name_new_content_new_job() {
    let home = Home::with("stable_for_ms = 100\n");
    let daemon = home.start();
    home.drop("part.obj", cuboid(1.0));
    daemon.wait_for("the first", || home.status().is("part.obj", "done"));

    // Another file of the same length and the same time of change, renamed into the place.
    let modified = home
        .inbox()
        .join("part.obj")
        .metadata()
        .unwrap()
        .modified()
        .unwrap();
    fs::write(home.at("other.obj"), cuboid(2.0)).unwrap();
    let other = File::options()
        .write(true)
        .open(home.at("other.obj"))
        .unwrap();
    other.set_modified(modified).unwrap();
    fs::rename(home.at("other.obj"), home.inbox().join("part.obj")).unwrap();
    let done = |count| {
        let status = home.status();
        status.jobs_of("part.obj").len() == count && status.count("done") == count as u64
    };
    daemon.wait_for("the second", || done(2));
    let bytes = home.results().bytes("part.obj");

    // Overwritten in place.
    home.drop("part.obj", torus(200));
    daemon.wait_for("the third", || done(3));
    assert!(home.labels("part.obj") > 6);

    // Content that was there before, but is not what the name has a result of now.
    home.drop("part.obj", cuboid(2.0));
    daemon.wait_for("the fourth", || done(4));
    let status = home.status();
    let rows = status.jobs_of("part.obj");
    assert_eq!(rows[3].content, rows[1].content);
    assert_ne!(rows[1].content, rows[0].content);
    assert!(home.results().bytes("part.obj") == bytes);
    assert_eq!(daemon.terminate(), Some(0));
}

/// A copy whose results lay under another name has results of its own once those are replaced.
#[test]
fn results_that_others_share_are_not_lost_with_their_file() {
    let home = Home::with("stable_for_ms = 100\n");
    let daemon = home.start();
    home.drop("first.obj", cuboid(1.0));
    daemon.wait_for("the first", || home.status().is("first.obj", "done"));
    let bytes = home.results().bytes("first.obj");
    home.drop("copy.obj", cuboid(1.0));
    daemon.wait_for("the copy", || home.status().is("copy.obj", "done"));
    assert!(!home.result("copy.obj").exists());

    home.drop("first.obj", torus(200));
    daemon.wait_for("other results", || home.labels("first.obj") > 6);
    daemon.wait_for("results of the copy", || home.labels("copy.obj") == 6);
    assert!(home.results().bytes("copy.obj") == bytes);
    daemon.wait_for("its row", || home.status().is("copy.obj", "done"));
    assert_eq!(daemon.terminate(), Some(0));
}

/// Whoever looks at any time sees whole results only, new ones and such as take the place of others.
#[test]
fn output_is_atomic() {
    let home = Home::with("stable_for_ms = 50\n");
    let daemon = home.start();
    let results = home.results();
    let names: Vec<_> = (0..20).map(|n| format!("part{n}.obj")).collect();
    let ended = AtomicBool::new(false);
    let looks = thread::scope(|scope| {
        let looking = scope.spawn(|| {
            let (mut looks, mut seen) = (0, 0);
            while !ended.load(Ordering::Relaxed) {
                for name in &names {
                    let Ok(folder) = fs::File::open(results.folder(name)) else {
                        continue;
                    };
                    // By the open folder: the name may lead to another one in the next moment.
                    let here =
                        format!("/proc/self/fd/{}", std::os::fd::AsRawFd::as_raw_fd(&folder));
                    let file = |name: &str| fs::read(format!("{here}/{name}"));
                    let files = ["labels.seg", "patches.ply", "boundaries.obj", "report.json"];
                    let whole: Vec<_> = files.map(file).into_iter().collect();
                    // Replaced while it was read: what was opened is no longer of that name.
                    let still = || {
                        let now = fs::metadata(results.folder(name)).ok()?.ino();
                        Some(now == folder.metadata().ok()?.ino())
                    };
                    if whole.iter().any(Result::is_err) {
                        assert_eq!(still(), Some(false), "{name}: {whole:?}");
                        continue;
                    }
                    let report = whole[3].as_ref().unwrap();
                    let report: serde_json::Value = serde_json::from_slice(report).unwrap();
                    let labels = whole[0].as_ref().unwrap();
                    let lines = labels.iter().filter(|&&b| b == b'\n').count();
                    assert_eq!(report["input"]["faces"], lines, "{name}");
                    seen += 1;
                }
                looks += 1;
            }
            (looks, seen)
        });
        for round in 0..4 {
            for (at, name) in names.iter().enumerate() {
                home.drop(name, cuboid(f64::from(round) + 1.0 + at as f64 / 100.0));
            }
            let done = 20 * u64::try_from(round + 1).unwrap();
            daemon.wait_for("the round", || home.status().count("done") == done);
        }
        ended.store(true, Ordering::Relaxed);
        looking.join().unwrap()
    });
    assert!(looks.0 > 10 && looks.1 > 100, "{looks:?}");
    assert_eq!(leftovers(&home.path()), [""; 0]);
    assert_eq!(daemon.terminate(), Some(0));
}

#[test]
fn leftovers_of_a_crash_are_swept_at_start() {
    let home = Home::new();
    let left = home.at("out/deep/.seamline-left.tmp");
    fs::create_dir_all(&left).unwrap();
    fs::write(left.join("labels.seg"), "0\n").unwrap();
    fs::create_dir_all(home.at("quarantine")).unwrap();
    fs::write(home.at("quarantine/.seamline-left.tmp"), "{").unwrap();
    let daemon = home.start();
    daemon.wait_for("nothing left", || leftovers(&home.path()).is_empty());
    assert_eq!(daemon.terminate(), Some(0));
}

/// Killed after the results are there and before the ledger could say so: the job is done again, to the same
/// bytes.
#[test]
fn done_is_recorded_after_outputs() {
    let home = Home::with("stable_for_ms = 100\n");
    let daemon = home.start();
    home.drop("part.stl", torus(150_000));
    daemon.wait_for("the job to run", || home.status().is("part.stl", "running"));
    let ledger = Connection::open(home.at("state/ledger.sqlite")).unwrap();
    ledger.busy_timeout(Duration::from_secs(10)).unwrap();
    ledger.execute_batch("BEGIN EXCLUSIVE").unwrap();
    assert!(
        !home.result("part.stl").exists(),
        "too late: the mesh is too small for this machine"
    );
    daemon.wait_for("the results", || home.result("part.stl").exists());
    let bytes = home.results().bytes("part.stl");
    sleep(Duration::from_millis(200));
    let status = home.status();
    assert_eq!(status.only("part.stl").state, "running", "{status:#?}");
    daemon.kill();
    ledger.execute_batch("ROLLBACK").unwrap();
    drop(ledger);
    let first = home.result("part.stl").metadata().unwrap().ino();

    let daemon = home.start();
    daemon.wait_for("the job again", || home.status().is("part.stl", "done"));
    assert!(home.results().bytes("part.stl") == bytes);
    assert_ne!(home.result("part.stl").metadata().unwrap().ino(), first);
    let status = home.status();
    let done: Vec<_> = status
        .jobs
        .iter()
        .filter(|job| job.state == "done")
        .collect();
    assert_eq!(done.len(), 1, "{status:#?}");
    assert_eq!(done[0].attempts, 2, "{status:#?}");
    assert_eq!(home.results().names(), ["part.stl"]);
    assert_eq!(leftovers(&home.path()), [""; 0]);
    assert_eq!(daemon.terminate(), Some(0));
}

/// 200 files, some of them broken, kill -9 at random moments: the end is that of a run nobody disturbed.
#[test]
fn crash_resumes_all() {
    const FILES: u32 = 200;
    const KILLS: usize = 12;
    let mut random = fastrand::Rng::with_seed(20_051);
    let files: BTreeMap<String, Vec<u8>> = (0..FILES)
        .map(|n| match n % 20 {
            7 => (
                format!("bad{n}.obj"),
                format!("v 0 0 {n}\nf 1 2 3\n").into_bytes(),
            ),
            3 => (format!("torus{n}.stl"), torus(2000 + 10 * n as usize)),
            _ => (
                format!("deep/part{n}.obj"),
                cuboid(f64::from(n + 1)).into_bytes(),
            ),
        })
        .collect();
    let settings = "stable_for_ms = 50\n[retry]\nattempts = 1000\n";

    let calm = Home::with(settings);
    for (name, bytes) in &files {
        calm.drop(name, bytes);
    }
    calm.once().ended(1);

    let home = Home::with(settings);
    let mut waiting = files.iter();
    let mut kills = 0;
    let started = Instant::now();
    while kills < KILLS && started.elapsed() < Duration::from_secs(60) {
        let daemon = home.start();
        for (name, bytes) in waiting.by_ref().take(FILES as usize / KILLS + 1) {
            home.drop(name, bytes);
        }
        sleep(Duration::from_millis(random.u64(60..500)));
        daemon.kill();
        kills += 1;
    }
    assert_eq!(waiting.len(), 0);
    let daemon = home.start();
    let ended = || {
        let status = home.status();
        status.count("pending") + status.count("running") == 0
            && status.count("done") + status.count("quarantined") >= u64::from(FILES)
    };
    daemon.wait_for("every file done or quarantined", ended);
    home.requeue_casualties();
    daemon.wait_for("every file done or quarantined", ended);
    assert_eq!(daemon.terminate(), Some(0));

    let status = home.status();
    assert_eq!(
        status.count("done"),
        u64::from(FILES) * 19 / 20,
        "{status:#?}"
    );
    assert_eq!(
        status.count("quarantined"),
        u64::from(FILES) / 20,
        "{status:#?}"
    );
    assert_eq!(leftovers(&home.path()), [""; 0]);
    let [calm, home] = [calm.results(), home.results()];
    assert_eq!(home.quarantined(), calm.quarantined());
    assert!(
        calm.quarantined()
            .iter()
            .all(|name| home.reason(name).is_some())
    );
    let (calm, home) = (calm.all(), home.all());
    assert!(home.keys().eq(calm.keys()));
    for (name, bytes) in &calm {
        assert!(*bytes == home[name], "{name}");
    }
}

#[test]
fn second_instance_refused() {
    let home = Home::new();
    let daemon = home.start();
    let second = run(&mut home.watch()).ended(2);
    let pid = daemon.pid().to_string();
    assert!(
        second.err.contains(&pid),
        "{pid} is not named: {}",
        second.err
    );
    let status = home.status();
    assert!(status.daemon.running);
    assert_eq!(status.daemon.pid, Some(daemon.pid()));
    home.once().ended(2);

    // The first goes on, and when it is gone its place is free.
    home.drop("box.obj", cuboid(1.0));
    daemon.wait_for("the result", || home.labels("box.obj") == 6);
    daemon.kill();
    assert!(!home.status().daemon.running);
    home.once().ended(0);
}

#[test]
fn status_for_people_names_what_failed() {
    let home = Home::new();
    for (name, text) in cuboids(3) {
        home.drop(name, text);
    }
    home.drop("bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.once().ended(1);
    let told = run(seamline().arg("status").arg(home.config())).ended(0);
    assert!(told.out.contains("bad.obj"), "{}", told.out);
    assert!(told.out.contains("vertex 2"), "{}", told.out);
}
