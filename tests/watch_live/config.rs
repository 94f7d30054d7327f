//! Configurations: refused, and changed while it runs.

use std::fs;

use seamline_tests::daemon::{Daemon, Home, Signal, cuboid};
use seamline_tests::run;

use crate::METRICS;

fn angle(home: &Home, name: &str) -> Option<f64> {
    let report = home.results().report(name)?;
    report["settings"]["sharp"]["angle_deg"].as_f64()
}

/// By signal and by change of the file; wrong ones change nothing; a new folder is looked into.
#[test]
fn config_reload() {
    let with =
        |angle: &str| format!("stable_for_ms = 100\n{METRICS}\n[sharp]\nangle_deg = {angle}\n");
    let home = Home::with(&with("31.0"));
    let mut daemon = home.start();
    let reloads = |daemon: &Daemon, result| {
        let found = daemon
            .metrics()
            .find("seamline_reloads_total", &[("result", result)]);
        found.unwrap_or(0.0)
    };
    home.drop("first.obj", cuboid(1.0));
    daemon.wait_for("the first", || angle(&home, "first.obj") == Some(31.0));

    home.configure(&with("32.0"));
    daemon.signal(Signal::Hup);
    daemon.wait_for("a reload", || reloads(&daemon, "ok") >= 1.0);
    home.drop("second.obj", cuboid(2.0));
    daemon.wait_for("the second", || angle(&home, "second.obj") == Some(32.0));

    let before = reloads(&daemon, "ok");
    home.configure(&with("33.0"));
    daemon.wait_for("a reload by itself", || reloads(&daemon, "ok") > before);
    home.drop("third.obj", cuboid(3.0));
    daemon.wait_for("the third", || angle(&home, "third.obj") == Some(33.0));

    let refused = reloads(&daemon, "refused");
    home.configure(&with("34.0").replace("angle_deg", "angle_dge"));
    daemon.signal(Signal::Hup);
    daemon.wait_for("a refusal", || reloads(&daemon, "refused") > refused);
    let log = daemon.log();
    for word in [
        "watch.toml:8",
        "sharp.angle_dge",
        "did you mean `angle_deg`?",
    ] {
        assert!(log.contains(word), "`{word}` is not told: {log}");
    }
    home.drop("fourth.obj", cuboid(4.0));
    daemon.wait_for("the fourth", || angle(&home, "fourth.obj") == Some(33.0));

    fs::create_dir(home.at("second-inbox")).unwrap();
    fs::write(home.at("second-inbox/fifth.obj"), cuboid(5.0)).unwrap();
    let second = "\n[[watch]]\nroot = \"second-inbox\"\nstable_for_ms = 100\n";
    home.configure(&format!("{}{second}", with("35.0")));
    daemon.wait_for("the fifth", || angle(&home, "fifth.obj") == Some(35.0));
    fs::write(home.at("second-inbox/sixth.obj"), cuboid(6.0)).unwrap();
    daemon.wait_for("the sixth", || angle(&home, "sixth.obj") == Some(35.0));
    home.drop("seventh.obj", cuboid(7.0));
    daemon.wait_for("the seventh", || angle(&home, "seventh.obj") == Some(35.0));

    // What was done under earlier settings stays as it was.
    assert_eq!(angle(&home, "first.obj"), Some(31.0));
    assert_eq!(angle(&home, "third.obj"), Some(33.0));
    assert!(!daemon.has_ended());
    assert_eq!(daemon.terminate(), Some(0));
}

#[track_caller]
fn refused(home: &Home) -> String {
    let ran = home.once().ended(2);
    assert!(!home.at("out").exists() && !home.at("state").exists());
    assert_eq!(run(&mut home.watch()).code, Some(2));
    ran.err
}

#[test]
fn bad_config_exits_before_watching() {
    let cases = [
        (
            "stable_for_sm = 2\n",
            "watch.toml:3: watch.stable_for_sm",
            "did you mean `stable_for_ms`?",
        ),
        (
            "\n[pipeline]\nclassifer = \"kmeans\"\n",
            "watch.toml:5: pipeline.classifer",
            "did you mean `classifier`?",
        ),
        (
            "\n[outptu]\ndir = \"out\"\n",
            "watch.toml:4: outptu",
            "`output`",
        ),
        (
            "[retry]\nattempts = 0\n",
            "watch.toml:4: retry.attempts",
            "1 to 1000",
        ),
        (
            "[limits]\nmemory_limit_bytes = 5\n",
            "watch.toml:4: limits.memory_limit_bytes",
            "64 MiB",
        ),
        (
            "[http]\nlisten = \"nowhere\"\n",
            "watch.toml:4: http.listen",
            "127.0.0.1:9464",
        ),
        (
            "[log]\nformat = \"xml\"\n",
            "watch.toml:4: log.format",
            "`json`",
        ),
        (
            "max_wait_ms = 5\n",
            "watch.toml:3: watch.max_wait_ms",
            "stable_for_ms",
        ),
        (
            "exclude = [\"[a\"]\n",
            "watch.toml:3: watch.exclude",
            "*_backup.stl",
        ),
    ];
    for (text, place, hint) in cases {
        let said = refused(&Home::with(text));
        assert!(
            said.contains(place) && said.contains(hint),
            "{text}: {said}"
        );
    }
}

#[test]
fn output_inside_watch_is_refused() {
    for (table, key) in [
        ("output", "output.dir"),
        ("state", "state.dir"),
        ("quarantine", "quarantine.dir"),
        ("done", "done.dir"),
    ] {
        let said = refused(&Home::with(&format!("\n[{table}]\ndir = \"inbox/here\"\n")));
        let place = format!("watch.toml:5: {key}");
        assert!(said.contains(&place), "{said}");
        assert!(said.contains("inside the watched folder"), "{said}");
    }
}
