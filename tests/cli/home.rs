//! A folder of a test's own, with sample parts in it.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use seamline_tests::samples::{Sample, samples};
use seamline_tests::{Ran, run, seamline};
use serde_json::Value;

/// A triangle whose third vertex is missing.
pub const BAD_OBJ: &str = "v 0 0 0\nv 1 0 0\nf 1 2 3\n";

/// A temporary folder; commands run in it.
pub struct Home(tempfile::TempDir);

impl Home {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    pub fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file, and the folders above it.
    pub fn put(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.at(name);
        fs::create_dir_all(path.parent().expect("it lies below")).expect("a folder for it");
        fs::write(&path, bytes).expect("a file to put");
    }

    /// Writes one of the sample parts, under the name it has there.
    pub fn put_sample(&self, name: &str) -> Sample {
        let found = samples().into_iter().find(|sample| sample.path == name);
        let sample = found.expect("a sample of this name");
        self.put(name, &sample.bytes);
        sample
    }

    /// The program in this folder, with arguments in between spaces.
    pub fn command(&self, line: &str) -> Command {
        let mut command = seamline();
        command
            .current_dir(self.0.path())
            .args(line.split_whitespace());
        command
    }

    pub fn run(&self, line: &str) -> Ran {
        run(&mut self.command(line))
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.at(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8_lossy(&self.read(name)).into_owned()
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.read(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// The label of each face, from a folder of results.
    pub fn labels(&self, results: &str) -> Vec<u32> {
        let text = self.text(&format!("{results}/labels.seg"));
        let number = |line: &str| line.parse().unwrap_or_else(|_| panic!("a number: {line}"));
        text.lines().map(number).collect()
    }

    /// The names of what lies in a folder, sorted; nothing if there is no such folder.
    pub fn listed(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.at(folder))
            .into_iter()
            .flatten()
            .flatten();
        let mut names: Vec<_> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// The settings in force of a run of `segment` with these arguments on the bracket.
    pub fn settings_in_force(&self, line: &str, environment: &[(&str, &str)]) -> Value {
        let mut command = self.command(&format!("segment bracket.obj -q --json {line}"));
        let report = run(command.envs(environment.iter().copied())).json();
        report["settings"].clone()
    }
}
