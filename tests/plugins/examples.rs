//! The example programs of `plugins/command`, where what they need is installed.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use seamline_tests::{run, seamline};

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

/// A Python with pyarrow and scikit-learn: that of `SEAMLINE_TEST_PYTHON`, else `python3`.
fn python() -> Option<String> {
    let python = std::env::var("SEAMLINE_TEST_PYTHON").unwrap_or("python3".to_owned());
    if works(&python, &["-c", "import pyarrow, sklearn"]) {
        return Some(python);
    }
    eprintln!("SKIPPED: {python} has no pyarrow and scikit-learn");
    None
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
    if let Some(python) = python() {
        keeps_the_contract("classify", &[&python, "birch.py"]);
    }
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
