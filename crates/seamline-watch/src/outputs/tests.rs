use std::fs;

use seamline_ecs::Stage;
use seamline_ecs::results::StageRecord;
use serde_json::Value;

use super::*;
use crate::load::{LoadedMesh, load};
use crate::test_support::{in_one_patch, strip};

struct Home {
    folder: tempfile::TempDir,
    loaded: LoadedMesh,
    settings: toml::Table,
}

impl Home {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("part.obj");
        fs::write(&path, strip(2)).unwrap();
        let loaded = load(&path, 0.0).unwrap();
        Self {
            folder,
            loaded,
            settings: "[merge]\nthreshold = 0.5\n".parse().unwrap(),
        }
    }

    fn segmentation(&self, seconds: f64) -> Segmentation {
        let counts = [("sharp_edges", 4), ("clusters", 2)].into();
        let record = StageRecord {
            stage: Stage::Sharp,
            seconds,
            counts,
            measures: [("threshold", 0.65)].into(),
        };
        Segmentation {
            stages: vec![record],
            ..in_one_patch(&self.loaded.mesh)
        }
    }

    fn facts(&self, read_seconds: f64) -> JobFacts<'_> {
        JobFacts {
            markings: None,
            path: Path::new("inbox/part.obj"),
            hash: &self.loaded.hash,
            format: self.loaded.format,
            bytes_len: self.loaded.bytes_len,
            settings: &self.settings,
            program_version: "1.2.3",
            read_seconds,
        }
    }

    fn write(&self, seconds: f64, what: WriteSet) -> PathBuf {
        let out = self.folder.path().join("out");
        let (segmentation, facts) = (self.segmentation(seconds), self.facts(seconds));
        write_results(
            &out,
            OsStr::new("part.obj"),
            &self.loaded.mesh,
            &segmentation,
            &facts,
            what,
        )
        .unwrap()
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_result_is_a_folder_of_four_files() {
    let home = Home::new();
    let place = home.write(0.1, WriteSet::ALL);
    assert_eq!(place, home.folder.path().join("out/part.obj.seamline"));
    assert_eq!(
        names(&place),
        ["boundaries.obj", "labels.seg", "patches.ply", "report.json"]
    );
    assert_eq!(
        fs::read_to_string(place.join("labels.seg")).unwrap(),
        "0\n0\n"
    );
    assert!(
        fs::read_to_string(place.join("boundaries.obj"))
            .unwrap()
            .contains("g patch_0_patch_1")
    );
    assert_eq!(names(place.parent().unwrap()), ["part.obj.seamline"]);
}

#[test]
fn only_the_files_asked_for_are_written() {
    let home = Home::new();
    home.write(0.1, WriteSet::ALL);
    let place = home.write(0.1, "report, labels".parse().unwrap());
    assert_eq!(names(&place), ["labels.seg", "report.json"]);
}

#[test]
fn two_runs_differ_in_nothing_but_the_seconds_of_the_report() {
    let home = Home::new();
    let of_run = |seconds| {
        let place = home.write(seconds, WriteSet::ALL);
        let mut files: Vec<_> = names(&place)
            .iter()
            .map(|name| fs::read(place.join(name)).unwrap())
            .collect();
        let mut report: Value = serde_json::from_slice(&files.pop().unwrap()).unwrap();
        report.as_object_mut().unwrap().remove("seconds").unwrap();
        (files, report.to_string())
    };
    assert_eq!(of_run(0.1), of_run(7.5));
}

#[test]
fn the_report_tells_input_settings_stages_and_patches() {
    let home = Home::new();
    let segmentation = home.segmentation(2.0);
    let report = report(&home.loaded.mesh, &segmentation, &home.facts(0.5));
    let report = serde_json::to_value(report).unwrap();
    let keys: Vec<_> = report
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    let wanted = [
        "schema_version",
        "program",
        "input",
        "settings",
        "findings",
        "stages",
        "patches",
    ];
    assert_eq!(keys[..7], wanted);
    assert_eq!(report["schema_version"], 1);
    assert_eq!(report["program"]["version"], "1.2.3");
    assert_eq!(report["input"]["path"], "inbox/part.obj");
    assert_eq!(report["input"]["format"], "obj");
    assert_eq!(report["input"]["faces"], 2);
    assert_eq!(report["input"]["units"], "as in the file");
    assert_eq!(report["settings"]["merge"]["threshold"], 0.5);
    assert_eq!(report["findings"]["triangles"], 2);
    assert_eq!(report["stages"][0]["stage"], "sharp");
    assert_eq!(report["stages"][0]["counts"]["sharp_edges"], 4);
    assert_eq!(report["stages"][0]["measures"]["threshold"], 0.65);
    assert_eq!(report["patches"][0]["faces"], 2);
    assert_eq!(report["boundaries"][0]["sharp_share"], 0.5);
    assert_eq!(report["seconds"]["sharp"], 2.0);
    assert_eq!(report["seconds"]["total"], 2.5);
}

#[test]
fn a_result_that_cannot_be_written_leaves_the_old_one_and_no_trace() {
    let home = Home::new();
    let place = home.write(0.1, WriteSet::ALL);
    let mut broken = home.segmentation(0.1);
    broken.vertices.k_min.pop();
    let out = home.folder.path().join("out");
    let error = write_results(
        &out,
        OsStr::new("part.obj"),
        &home.loaded.mesh,
        &broken,
        &home.facts(0.1),
        WriteSet::ALL,
    )
    .unwrap_err();
    assert!(error.to_string().contains("patches.ply"), "{error}");
    assert_eq!(names(&out), ["part.obj.seamline"]);
    assert_eq!(names(&place).len(), 4);
}

#[test]
fn an_unknown_word_for_a_file_names_the_nearest() {
    let error = "labels,reprot".parse::<WriteSet>().unwrap_err();
    assert_eq!(error.hint, "did you mean `report`?");
    assert!("".parse::<WriteSet>().is_err());
}
