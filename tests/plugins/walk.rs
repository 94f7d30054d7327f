//! The walk of `plugins/README.md`, gone: its files compile beside the project's own crates, and their tests pass.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use seamline_tests::run;

/// The first block of a language after a text.
pub fn block<'a>(page: &'a str, after: &str, language: &str) -> &'a str {
    let (_, rest) = page.split_once(after).expect("the page names the file");
    let (_, rest) = rest
        .split_once(&format!("```{language}\n"))
        .expect("a block follows");
    rest.split_once("```").expect("the block ends").0
}

#[test]
fn the_classifier_of_the_walk_compiles_keeps_the_contract_and_cuts_a_part() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()
        .unwrap();
    let page = fs::read_to_string(root.join("plugins/README.md")).unwrap();
    let manifest = block(&page, "`plugins/bands/Cargo.toml`", "toml");
    let source = block(&page, "`plugins/bands/src/lib.rs`", "rust");

    // Always the same place, so that the second time is soon done.
    let walk = Path::new(env!("CARGO_TARGET_TMPDIR")).join("walk");
    let crate_folder = walk.join("plugins/bands");
    fs::create_dir_all(crate_folder.join("src")).unwrap();
    fs::write(crate_folder.join("Cargo.toml"), manifest).unwrap();
    fs::write(crate_folder.join("src/lib.rs"), source).unwrap();
    let workspace = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let members = workspace
        .lines()
        .find(|line| line.starts_with("members"))
        .unwrap();
    let alone = "members = [\"plugins/bands\", \"crates/seamline-ecs\", \"crates/seamline-segment\", \"crates/seamline-mesh\"]";
    let workspace = workspace
        .replace(members, alone)
        .replace("default-members", "# default-members");
    fs::write(walk.join("Cargo.toml"), workspace).unwrap();
    fs::copy(root.join("Cargo.lock"), walk.join("Cargo.lock")).unwrap();
    if !walk.join("crates").exists() {
        symlink(root.join("crates"), walk.join("crates")).unwrap();
    }

    let cargo = std::env::var("CARGO").unwrap_or("cargo".to_owned());
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    let mut test = Command::new(cargo);
    test.args(["test", "--release", "--offline", "-p", "seamline-bands"])
        .current_dir(&walk)
        .env("CARGO_TARGET_DIR", target);
    let ran = run(&mut test).ended(0);
    assert!(ran.out.contains("test result: ok. 3 passed"), "{}", ran.out);
}
