//! What the daemon leaves on disk.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// The files of a result.
const FILES: [&str; 4] = ["labels.seg", "patches.ply", "boundaries.obj", "report.json"];

/// Where results and failures are.
#[derive(Clone, Debug)]
pub struct Results {
    /// The folder of results.
    pub out: PathBuf,
    /// The folder of what failed.
    pub quarantine: PathBuf,
}

impl Results {
    /// The folder of results of one input.
    pub fn folder(&self, name: &str) -> PathBuf {
        self.out.join(format!("{name}.seamline"))
    }

    /// How many labels the result of one input has; 0 if there is none.
    pub fn labels(&self, name: &str) -> usize {
        let labels = fs::read_to_string(self.folder(name).join("labels.seg"));
        labels.map_or(0, |text| text.lines().count())
    }

    /// The report of one input, if there is a result.
    pub fn report(&self, name: &str) -> Option<Value> {
        read_json(&self.folder(name).join("report.json"))
    }

    /// Why a file is in quarantine, if it is: the reason is there before the file is.
    pub fn reason(&self, name: &str) -> Option<Value> {
        let reason = read_json(&self.quarantine.join(format!("{name}.error.json")))?;
        self.quarantine.join(name).exists().then_some(reason)
    }

    /// The bytes of one result, the report without what differs from run to run.
    ///
    /// # Panics
    ///
    /// If one of the four files is missing or the report is none.
    #[track_caller]
    pub fn bytes(&self, name: &str) -> [Vec<u8>; 4] {
        let folder = self.folder(name);
        FILES.map(|file| {
            let path = folder.join(file);
            let bytes = fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            match file {
                "report.json" => without_seconds(&bytes),
                _ => bytes,
            }
        })
    }

    /// Every result by the name of its input, as [`Results::bytes`] gives it.
    pub fn all(&self) -> BTreeMap<String, [Vec<u8>; 4]> {
        let names = self.names();
        names
            .into_iter()
            .map(|name| {
                let bytes = self.bytes(&name);
                (name, bytes)
            })
            .collect()
    }

    /// The inputs that have a result, by path.
    pub fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        walk(&self.out, &mut |path| {
            let relative = path.strip_prefix(&self.out).unwrap().to_string_lossy();
            names.extend(relative.strip_suffix(".seamline").map(str::to_owned));
        });
        names.sort();
        names
    }

    /// The files in quarantine, by path, without the reasons beside them.
    pub fn quarantined(&self) -> Vec<String> {
        let mut names = Vec::new();
        walk(&self.quarantine, &mut |path| {
            let relative = path.strip_prefix(&self.quarantine).unwrap();
            let name = relative.to_string_lossy().into_owned();
            if path.is_file() && !name.ends_with(".error.json") {
                names.push(name);
            }
        });
        names.sort();
        names
    }
}

/// A report without its times by the clock and without the folder its input was in.
///
/// # Panics
///
/// If it is no report.
pub fn without_seconds(report: &[u8]) -> Vec<u8> {
    let mut report: Value = serde_json::from_slice(report).unwrap();
    let of_run = report.as_object_mut().unwrap().remove("seconds");
    assert!(of_run.is_some(), "a report tells its seconds");
    let path = report["input"].as_object_mut().unwrap().remove("path");
    assert!(path.is_some(), "a report tells its input");
    serde_json::to_vec(&report).unwrap()
}

/// The paths of everything unfinished below a folder.
pub fn leftovers(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    walk(folder, &mut |path| {
        let name = path.file_name().unwrap().to_string_lossy();
        if name.starts_with(".seamline-") && name.ends_with(".tmp") {
            found.push(path.display().to_string());
        }
    });
    found
}

fn walk(folder: &Path, visit: &mut impl FnMut(&Path)) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        visit(&entry.path());
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            walk(&entry.path(), visit);
        }
    }
}

fn read_json(path: &Path) -> Option<Value> {
    serde_json::from_slice(&fs::read(path).ok()?).ok()
}
