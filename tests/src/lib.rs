//! What the end-to-end tests have in common: the built binary, the library's pipeline, and the bench of CAD
//! meshes where it is present.

pub mod daemon;
pub mod models;
pub mod samples;
pub mod score;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;
use std::sync::{Arc, OnceLock};

use escargot::{CargoBuild, CargoRun};
use seamline_ecs::settings::set_dotted;
use seamline_ecs::{Pipeline, Segmentation, Worker};
use seamline_mesh::{Mesh, PolygonMesh, weld};
use seamline_segment::builtin_steps;

/// The program, ready to be given arguments. Built once a test binary, in the profile of the tests. It does
/// not see settings of the environment the tests run in.
///
/// # Panics
///
/// If it does not build.
pub fn seamline() -> Command {
    static PROGRAM: OnceLock<CargoRun> = OnceLock::new();
    let program = PROGRAM.get_or_init(|| {
        let build = CargoBuild::new()
            .manifest_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml"))
            .package("seamline")
            .bin("seamline")
            .current_release();
        build.run().expect("the program builds")
    });
    let mut command = program.command();
    let ours = |name: &std::ffi::OsString| name.to_string_lossy().starts_with("SEAMLINE_");
    for (name, _) in std::env::vars_os().filter(|(name, _)| ours(name)) {
        command.env_remove(name);
    }
    command
}

/// How a run of the program ended, and what it said.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Exit status; `None` if a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Ran {
    /// The same run, if it ended with `code`.
    ///
    /// # Panics
    ///
    /// If it ended otherwise, with all it said.
    #[track_caller]
    pub fn ended(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{self:#?}");
        self
    }

    /// What it printed, as one piece of JSON.
    ///
    /// # Panics
    ///
    /// If it did not end well, or printed something else.
    #[track_caller]
    pub fn json(self) -> serde_json::Value {
        serde_json::from_str(&self.ended(0).out).expect("JSON on standard output")
    }
}

/// Runs a command to its end.
///
/// # Panics
///
/// If it cannot be started.
pub fn run(command: &mut Command) -> Ran {
    let output = command.output().expect("the command starts");
    Ran {
        code: output.status.code(),
        out: String::from_utf8_lossy(&output.stdout).into_owned(),
        err: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// Do two labellings cut the faces alike, whatever the names?
pub fn same_partition(a: &[u32], b: &[u32]) -> bool {
    let pairs: BTreeSet<_> = a.iter().zip(b).collect();
    let distinct = |labels: &[u32]| labels.iter().collect::<BTreeSet<_>>().len();
    a.len() == b.len() && pairs.len() == distinct(a) && pairs.len() == distinct(b)
}

/// A file or folder of the bench, which lies beside the project's folder. `None`, and a word on standard
/// error, where it is absent.
pub fn bench(path: &str) -> Option<PathBuf> {
    let found = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../shared/bench")
        .join(path);
    if found.exists() {
        return Some(found);
    }
    eprintln!("SKIPPED: ../shared/bench/{path} is not there");
    None
}

/// The pipeline under `settings`, each `KEY=VALUE`.
///
/// # Panics
///
/// If a setting is wrong.
pub fn pipeline(settings: &[&str]) -> Arc<Pipeline> {
    let mut given = toml::Table::new();
    for setting in settings {
        let (key, value) = setting.split_once('=').expect("KEY=VALUE");
        set_dotted(&mut given, key, value).expect("a dotted key");
    }
    let registry = seamline_plugins::registry();
    Arc::new(Pipeline::assemble(&builtin_steps(), &registry, &given).expect("settings are right"))
}

/// Polygons welded and cut into patches under `settings`.
///
/// # Panics
///
/// If a setting is wrong or a step fails.
pub fn segment(polygons: PolygonMesh, settings: &[&str]) -> Segmentation {
    segment_mesh(weld(polygons, 0.0), settings)
}

/// As [`segment`], of a mesh already welded.
///
/// # Panics
///
/// As [`segment`].
pub fn segment_mesh(mesh: Mesh, settings: &[&str]) -> Segmentation {
    Worker::new(pipeline(settings))
        .segment(Arc::new(mesh))
        .expect("every step does its work")
}

/// What a stage counted under a name.
///
/// # Panics
///
/// If it counted no such thing.
pub fn count(segmentation: &Segmentation, stage: &str, name: &str) -> u64 {
    let record = segmentation
        .stages
        .iter()
        .find(|record| record.stage.name() == stage);
    *record
        .and_then(|record| record.counts.get(name))
        .expect("the stage counted it")
}
