//! Awkward and broken files through the program: each behaves as the table beside it says.

use std::fs;
use std::path::Path;
use std::process::Command;

use seamline_mesh::read;
use seamline_tests::{Ran, bench, run, seamline};

/// One row of the table: file name, what is wrong with it, what is expected.
fn table(readme: &str) -> Vec<[String; 3]> {
    let rows = readme.lines().filter(|line| line.starts_with('|'));
    // The first two lines of a table are its head and a rule.
    let rows = rows.skip(2).map(|row| {
        let cells: Vec<_> = row.trim_matches('|').split('|').map(str::trim).collect();
        match cells[..] {
            [file, wrong, expected] => [file, wrong, expected].map(str::to_owned),
            _ => panic!("a row of three cells: {row}"),
        }
    });
    rows.collect()
}

/// Runs `segment` on the file with 1.5 GB of address space: memory for what a lying header counts is then not
/// to be had. Two threads, since every thread reserves some of it.
fn segment_with_little_memory(file: &Path, output: &Path) -> Ran {
    let program = seamline();
    let mut shell = Command::new("sh");
    shell
        .args(["-c", "ulimit -v 1500000 && exec \"$@\"", "sh"])
        .arg(program.get_program())
        .args(["segment", "--threads", "2"])
        .arg(file)
        .arg("-o")
        .arg(output);
    for (name, value) in program.get_envs() {
        match value {
            Some(value) => shell.env(name, value),
            None => shell.env_remove(name),
        };
    }
    run(&mut shell)
}

/// What is wrong with how the file was refused.
fn check_refused(ran: &Ran, name: &str, output: &Path) -> Result<(), String> {
    if ran.code != Some(1) {
        return Err("exit status 1 is right".to_owned());
    }
    let [line] = ran.err.lines().collect::<Vec<_>>()[..] else {
        return Err("one line on standard error is right".to_owned());
    };
    let reason = line
        .split_once(&format!("{name}: "))
        .map(|(_, reason)| reason);
    if reason.is_none_or(|reason| reason.len() < 10) {
        return Err("the line names the file and the reason".to_owned());
    }
    if line.contains("panicked") || line.contains("RUST_BACKTRACE") {
        return Err("no panic is right".to_owned());
    }
    let left: Vec<_> = fs::read_dir(output).into_iter().flatten().collect();
    if !left.is_empty() {
        return Err(format!("nothing is to be written, but there is {left:?}"));
    }
    Ok(())
}

/// What is wrong with how the file was processed.
fn check_processed(ran: &Ran, file: &Path, name: &str, output: &Path) -> Result<(), String> {
    if ran.code != Some(0) {
        return Err("exit status 0 is right".to_owned());
    }
    let faces = read(file).map_err(|e| format!("reads: {e}"))?.face_count();
    let labels = output.join(format!("{name}.seamline/labels.seg"));
    let labels = fs::read_to_string(labels).map_err(|e| format!("labels.seg: {e}"))?;
    let good = labels.lines().filter(|line| line.parse::<u32>().is_ok());
    if (good.count(), labels.lines().count()) != (faces, faces) {
        return Err(format!("{faces} labels are right, one a face"));
    }
    Ok(())
}

#[test]
fn every_broken_file_is_refused_in_one_line_and_every_awkward_one_is_processed() {
    let Some(folder) = bench("bad") else { return };
    let readme = fs::read_to_string(folder.join("README.md")).expect("it has a table");
    let mut wrong = Vec::new();
    for [name, what, expected] in table(&readme) {
        let file = folder.join(&name);
        let output = tempfile::tempdir().expect("a folder for results");
        let ran = segment_with_little_memory(&file, output.path());
        let verdict = match (expected.as_str(), ran.code) {
            ("refuse", _) | ("either", Some(1)) => check_refused(&ran, &name, output.path()),
            ("process", _) | ("either", _) => check_processed(&ran, &file, &name, output.path()),
            (other, _) => panic!("{name}: what is `{other}`?"),
        };
        if let Err(verdict) = verdict {
            wrong.push(format!("{name} ({what}): {verdict}; it did: {ran:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_bad_file_is_in_the_table() {
    let Some(folder) = bench("bad") else { return };
    let readme = fs::read_to_string(folder.join("README.md")).expect("it has a table");
    let named: Vec<_> = table(&readme).into_iter().map(|[name, ..]| name).collect();
    for entry in fs::read_dir(&folder).expect("it can be listed") {
        let name = entry.expect("an entry").file_name();
        assert!(
            name == "README.md" || named.iter().any(|named| **named == *name),
            "{}",
            name.display()
        );
    }
}

#[test]
fn one_bad_file_of_every_kind_leaves_the_good_ones_done() {
    let Some(folder) = bench("bad") else { return };
    let readme = fs::read_to_string(folder.join("README.md")).expect("it has a table");
    let output = tempfile::tempdir().expect("a folder for results");
    let rows = table(&readme);
    let ran = run(seamline()
        .arg("segment")
        .args(rows.iter().map(|[name, ..]| folder.join(name)))
        .args(["--quiet", "-o"])
        .arg(output.path()))
    .ended(1);
    for [name, _, expected] in &rows {
        let done = output.path().join(format!("{name}.seamline")).exists();
        let told = ran
            .err
            .lines()
            .any(|line| line.contains(&format!("{name}: ")));
        assert_ne!(done, told, "{name}: done or told, and not both");
        match expected.as_str() {
            "process" => assert!(done, "{name}"),
            "refuse" => assert!(told, "{name}"),
            _ => {}
        }
    }
}

#[test]
fn a_prism_with_triangles_turned_inside_out_has_its_three_patches() {
    let Some(folder) = bench("bad") else { return };
    let output = tempfile::tempdir().expect("a folder for results");
    run(seamline()
        .args(["segment", "-o"])
        .arg(output.path())
        .arg(folder.join("flipped.stl")))
    .ended(0);
    let labels = fs::read_to_string(output.path().join("flipped.stl.seamline/labels.seg"));
    let labels = labels.expect("labels are there");
    let last = labels.lines().filter_map(|line| line.parse::<u32>().ok());
    assert_eq!(last.max(), Some(2));
}
