//! Swapping by configuration while files flow: reports show who saw which mesh.

use std::process::Command;

use seamline_tests::daemon::{Daemon, Home, Signal, cuboid};

fn classifier_of(home: &Home, name: &str) -> Option<String> {
    let report = home.results().report(name)?;
    let settings = &report["settings"]["pipeline"];
    settings["classifier"].as_str().map(str::to_owned)
}

fn with(classifier: &str, more: &str) -> String {
    format!(
        "stable_for_ms = 100\n[http]\nlisten = \"127.0.0.1:0\"\n[pipeline]\nclassifier = \"{classifier}\"\n{more}"
    )
}

#[test]
fn the_classifier_is_swapped_by_reload_while_files_flow() {
    let home = Home::with(&with("kmeans", ""));
    let daemon: Daemon = home.start();
    let mut height = 0.0;
    for (round, classifier) in ["kmeans", "histogram", "gmm", "mean-shift"]
        .into_iter()
        .enumerate()
    {
        if round > 0 {
            let before = daemon
                .log()
                .matches("the configuration was read anew")
                .count();
            home.configure(&with(classifier, ""));
            daemon.signal(Signal::Hup);
            daemon.wait_for("the reload", || true);
            while daemon
                .log()
                .matches("the configuration was read anew")
                .count()
                <= before
            {
                std::thread::sleep(std::time::Duration::from_millis(20));
            }
        }
        for i in 0..3 {
            height += 1.0;
            home.drop(format!("{classifier}-{i}.obj"), cuboid(height));
        }
        let last = format!("{classifier}-2.obj");
        daemon.wait_for("the last of a round", || {
            classifier_of(&home, &last).is_some()
        });
    }
    daemon.terminate();
    for classifier in ["kmeans", "histogram", "gmm", "mean-shift"] {
        for i in 0..3 {
            let name = format!("{classifier}-{i}.obj");
            assert_eq!(
                classifier_of(&home, &name).as_deref(),
                Some(classifier),
                "{name}"
            );
        }
    }
}

#[test]
fn a_rule_chooses_by_path_and_the_first_that_takes_a_file_holds() {
    let home = Home::with(&with(
        "kmeans",
        "[merge]\nthreshold = 0.6\n\
         [[rules]]\nfiles = ['castings/**']\nprofile = 'lavoue2005'\nclassifier = 'gmm'\nrectifier = 'none'\n\
         [rules.settings.gmm]\nmax_components = 5\n[rules.settings.merge]\nthreshold = 'auto'\n\
         [[rules]]\nfiles = ['*_scan.obj']\nclassifier = 'histogram'\n",
    ));
    std::fs::create_dir(home.inbox().join("castings")).unwrap();
    home.drop("plain.obj", cuboid(1.0));
    home.drop("a_scan.obj", cuboid(2.0));
    home.drop("castings/b_scan.obj", cuboid(3.0));
    home.once().ended(0);
    let settings = |name: &str| home.results().report(name).expect(name)["settings"].clone();

    let plain = settings("plain.obj");
    assert_eq!(plain["pipeline"]["classifier"], "kmeans");
    assert_eq!(plain["merge"]["threshold"], 0.6);
    let scan = settings("a_scan.obj");
    assert_eq!(scan["pipeline"]["classifier"], "histogram");
    assert_eq!(scan["pipeline"]["profile"], "cad");
    assert_eq!(scan["merge"]["threshold"], 0.6);
    let casting = settings("castings/b_scan.obj");
    assert_eq!(casting["pipeline"]["classifier"], "gmm");
    assert_eq!(casting["pipeline"]["rectifier"], "none");
    assert_eq!(casting["pipeline"]["profile"], "lavoue2005");
    assert_eq!(casting["gmm"]["max_components"], 5);
    assert_eq!(casting["merge"]["threshold"], "auto");

    // What is done is done under the rule's settings: nothing is cut again.
    home.once().ended(0);
    assert_eq!(home.status().only("castings/b_scan.obj").attempts, 1);
}

#[test]
fn the_same_bytes_under_two_rules_are_cut_in_two_ways() {
    let home = Home::with(&with(
        "kmeans",
        "[[rules]]\nfiles = ['b.obj']\nclassifier = 'histogram'\n",
    ));
    home.drop("a.obj", cuboid(1.0));
    home.drop("b.obj", cuboid(1.0));
    home.once().ended(0);
    assert_eq!(classifier_of(&home, "a.obj").as_deref(), Some("kmeans"));
    assert_eq!(classifier_of(&home, "b.obj").as_deref(), Some("histogram"));
}

#[test]
fn what_is_wrong_with_a_rule_is_told_with_its_line_and_key() {
    for (rule, said) in [
        (
            "files = ['*.stl']\nclassifer = 'gmm'",
            "watch.toml:5: rules.classifer: unknown key",
        ),
        (
            "files = ['*.stl']\nclassifier = 'gmmm'",
            "watch.toml:5: rules.classifier: unknown classifier `gmmm`; did you mean `gmm`?",
        ),
        (
            "files = ['*.stl']\n[rules.settings.merge]\ntreshold = 3",
            "watch.toml:6: rules.settings.merge.treshold",
        ),
        (
            "files = ['*.stl']\nprofile = 'cda'",
            "watch.toml:5: rules.profile",
        ),
        ("classifier = 'gmm'", "watch.toml:3: rules.files"),
        ("files = ['a[']", "rules.files"),
    ] {
        let home = Home::with(&format!("[[rules]]\n{rule}\n"));
        let mut check: Command = seamline_tests::seamline();
        let ran = seamline_tests::run(check.args(["config", "check"]).arg(home.config())).ended(2);
        assert!(ran.err.contains(said), "{rule}: {}", ran.err);
    }
}
