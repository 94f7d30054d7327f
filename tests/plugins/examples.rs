//! The example programs of `plugins/command`, where what they need is installed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use seamline_tests::daemon::Home;
use seamline_tests::{run, seamline};

use crate::walk::block;

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugins/command/examples")
}

/// Does a program run, so that what it needs is there?
fn works(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(examples());
    let quiet = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

/// Is there a Python that has all these? If not, a word on standard error.
fn python_has(modules: &str) -> bool {
    let has = works("python3", &["-c", &format!("import {modules}")]);
    if !has {
        eprintln!("SKIPPED: no python3 with {modules}");
    }
    has
}

#[track_caller]
fn keeps_the_contract(stage: &str, command: &[&str]) {
    let mut check = seamline();
    check
        .args(["plugins", "check", "--stage", stage])
        .args(command);
    let ran = run(check.current_dir(examples())).ended(0);
    assert!(ran.out.ends_with("keeps the contract\n"), "{}", ran.out);
}

#[test]
fn the_classifier_in_python_keeps_the_contract() {
    if python_has("pyarrow, sklearn") {
        keeps_the_contract("classify", &["python3", "birch.py"]);
    }
}

#[test]
fn the_classifier_of_the_readme_keeps_the_contract_and_cuts_a_part() {
    if !python_has("pyarrow, numpy") {
        return;
    }
    let page = fs::read_to_string(examples().join("../../README.md")).unwrap();
    let home = Home::new();
    let program = home.at("steep.py");
    fs::write(&program, block(&page, "`steep.py`", "python")).unwrap();
    let steep = program.to_str().unwrap();

    let mut check = seamline();
    check.args(["plugins", "check", "--send", "samples", "python3", steep]);
    let kept = run(&mut check).ended(0);
    assert!(kept.out.ends_with("keeps the contract\n"), "{}", kept.out);

    let shaft = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/shaft.stl");
    let chosen = format!("{{ command = ['python3', '{steep}'], send = ['samples'] }}");
    let mut segment = seamline();
    segment.args(["segment", "--json", "--classifier", &chosen, "-o"]);
    let report = run(segment.arg(home.at("out")).arg(shaft)).json();
    assert_eq!(report["stages"][5]["counts"]["clusters"], 3);
}

/// An empty input ends a program that has all it needs with status 0.
#[test]
fn the_rectifier_in_javascript_keeps_the_contract() {
    if works("node", &["majority.mjs"]) {
        keeps_the_contract("rectify", &["node", "majority.mjs"]);
    } else {
        eprintln!("SKIPPED: there is no node with apache-arrow");
    }
}
