//! Which setting holds, and what is wrong use.

use crate::home::Home;

fn home() -> Home {
    let home = Home::new();
    home.put_sample("bracket.obj");
    home
}

#[test]
fn the_command_line_beats_the_environment_which_beats_the_file_which_beats_the_default() {
    let home = home();
    home.put(
        "file.toml",
        "[merge]\nthreshold = 0.5\n\n[pipeline]\nprofile = \"lavoue2005\"\n",
    );
    let threshold = |line: &str, environment: &[(&str, &str)]| {
        home.settings_in_force(line, environment)["merge"]["threshold"].clone()
    };
    let environment = [("SEAMLINE_MERGE__THRESHOLD", "0.25")];
    let default = threshold("", &[]);
    assert!(
        default != 0.5 && default != 0.25 && default != 0.125,
        "{default}"
    );
    assert_eq!(threshold("--config file.toml", &[]), 0.5);
    assert_eq!(threshold("--config file.toml", &environment), 0.25);
    assert_eq!(threshold("", &environment), 0.25);
    assert_eq!(
        threshold(
            "--config file.toml --set merge.threshold=0.125",
            &environment
        ),
        0.125
    );

    let profile = |line: &str, environment: &[(&str, &str)]| {
        home.settings_in_force(line, environment)["pipeline"]["profile"].clone()
    };
    let environment = [("SEAMLINE_PROFILE", "cad")];
    assert_eq!(profile("", &[]), "cad");
    assert_eq!(profile("--config file.toml", &[]), "lavoue2005");
    assert_eq!(profile("--config file.toml", &environment), "cad");
    assert_eq!(profile("--profile lavoue2005", &environment), "lavoue2005");
}

#[test]
fn merging_tells_the_threshold_it_found_and_that_threshold_gives_the_same_patches() {
    let home = home();
    let merged = |threshold: &str| {
        let line = format!(
            "segment bracket.obj --json --set surfaces.enabled=false --set merge.threshold={threshold}"
        );
        let report = home.run(&line).json();
        let stages = report["stages"].as_array().unwrap();
        let merge = stages.iter().find(|stage| stage["stage"] == "merge");
        let told = merge.unwrap()["measures"]["threshold"].as_f64();
        (told.unwrap(), report["patches"].clone())
    };
    let (found, patches) = merged("auto");
    assert!((0.4..=1.0).contains(&found) && found != 0.65, "{found}");
    assert_eq!(merged(&found.to_string()), (found, patches));

    let line = "segment bracket.obj -v --set surfaces.enabled=false --set merge.threshold=auto";
    let told = home.run(line).ended(0).err;
    assert!(told.contains(&format!("threshold {found:.3}")), "{told}");
}

/// Neither a number of regions nor patches that surfaces have settled are a matter of threshold.
#[test]
fn where_no_threshold_decides_none_is_told() {
    let home = home();
    for setting in ["merge.regions=3", "surfaces.enabled=true"] {
        let line = format!("segment bracket.obj --json --set {setting}");
        let report = home.run(&line).json();
        let stages = report["stages"].as_array().unwrap();
        assert_eq!(stages.len(), 11);
        assert!(
            stages
                .iter()
                .all(|stage| stage["measures"] == serde_json::json!({})),
            "{setting}: {stages:#?}"
        );
    }
}

#[test]
fn the_environment_reaches_tables_whose_name_has_a_dash() {
    let set = [("SEAMLINE_CONTOUR_TRACKING__CORRECT_BELOW_DEG", "5")];
    let settings = home().settings_in_force("", &set);
    assert_eq!(settings["contour-tracking"]["correct_below_deg"], 5.0);
}

#[test]
fn a_rectifier_is_told_in_the_settings_and_none_has_no_table() {
    let home = home();
    let tracking = home.settings_in_force("--rectifier contour-tracking", &[]);
    assert_eq!(tracking["pipeline"]["rectifier"], "contour-tracking");
    assert!(tracking["contour-tracking"].is_object());
    let none = home.settings_in_force("--rectifier none", &[]);
    assert_eq!(none["pipeline"]["rectifier"], "none");
    assert!(none["contour-tracking"].is_null());
}

#[test]
fn wrong_use_ends_with_2_names_what_was_meant_and_writes_nothing() {
    let home = home();
    home.put("wrong.toml", "[merge]\nthreshold = 0.5\nregoins = 3\n");
    home.put("broken.toml", "[merge\n");
    for (line, said) in [
        ("--set merge.treshold=3", "did you mean `threshold`?"),
        ("--set mergee.threshold=3", "did you mean `merge`?"),
        ("--set merge.threshold=much", "merge.threshold"),
        ("--set merge.threshold=-1", "merge.threshold"),
        ("--set merge.threshold", "KEY=VALUE"),
        ("--profile cda", "did you mean `cad`?"),
        ("--classifier kmean", "did you mean `kmeans`?"),
        (
            "--rectifier contour-trackin",
            "did you mean `contour-tracking`?",
        ),
        ("--config wrong.toml", "wrong.toml:3: merge.regoins"),
        ("--config broken.toml", "broken.toml:1"),
        ("--config missing.toml", "missing.toml"),
        ("--threads many", "--threads"),
        ("--no-such-flag", "--no-such-flag"),
        ("-q -v", "--quiet"),
    ] {
        let ran = home
            .run(&format!("segment bracket.obj -o out {line}"))
            .ended(2);
        assert!(ran.err.contains(said), "{line}: {}", ran.err);
        assert!(!ran.err.contains("panicked"), "{line}: {}", ran.err);
        assert_eq!(ran.out, "", "{line}");
    }
    let mut environment = home.command("segment bracket.obj -o out");
    let ran = seamline_tests::run(environment.env("SEAMLINE_CLASSIFER", "kmeans")).ended(2);
    assert!(
        ran.err.contains("did you mean `SEAMLINE_CLASSIFIER`?"),
        "{}",
        ran.err
    );
    assert_eq!(
        home.listed("."),
        ["bracket.obj", "broken.toml", "wrong.toml"]
    );
}

#[test]
fn without_arguments_it_says_how_it_is_used_and_ends_with_2() {
    let home = Home::new();
    for line in [
        "",
        "segment",
        "inspect",
        "watch",
        "config",
        "segmnet part.stl",
    ] {
        let ran = home.run(line).ended(2);
        assert!(ran.err.contains("Usage: seamline"), "{line}: {}", ran.err);
        assert_eq!(ran.out, "", "{line}");
    }
}

#[test]
fn help_and_version_are_asked_for_and_end_with_0() {
    let home = Home::new();
    assert!(home.run("--version").ended(0).out.starts_with("seamline "));
    assert!(
        home.run("segment --help")
            .ended(0)
            .out
            .contains("--profile")
    );
}
