//! What several tests need: a pipeline that cuts nothing but obeys, and a system of one's own.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Duration;

use bevy_ecs::prelude::*;
use seamline_ecs::results::{Boundary, PatchReport, PatchSummary, VertexQuantities};
use seamline_ecs::{
    BuiltinSteps, InputMesh, Pipeline, Registry, Segmentation, Stage, StepError, fallible,
};
use seamline_mesh::{Mesh, Topology, examine};

/// A mesh of this many faces is refused by a step.
pub const REFUSED: usize = 3;
/// A mesh of this many faces makes a step panic.
pub const PANICS: usize = 4;
/// A mesh of this many faces takes its time.
pub const SLOW: usize = 5;
/// A mesh of this many faces takes longer than anybody waits.
pub const HANGS: usize = 12;

/// The pipeline: one patch for every mesh, but for those of the sizes above.
pub fn pipeline() -> Arc<Pipeline> {
    let steps = BuiltinSteps {
        tables: Vec::new(),
        with_chosen_classifier: &[],
        install: |_| {
            Ok(Arc::new(|_: &mut World, schedule: &mut Schedule| {
                schedule.add_systems(fallible(obey).in_set(Stage::Grow));
                schedule.add_systems(one_patch.in_set(Stage::Export));
            }))
        },
        idle: |_| &[],
    };
    let pipeline = Pipeline::assemble(&steps, &Registry::default(), &toml::Table::new());
    Arc::new(pipeline.unwrap())
}

fn obey(mesh: Res<InputMesh>) -> Result<(), StepError> {
    match mesh.0.polygons.face_count() {
        REFUSED => {
            return Err(StepError::new(
                "three faces are refused",
                "take another number of faces",
            ));
        }
        PANICS => panic!("four faces\nare too many"),
        HANGS => std::thread::sleep(Duration::from_secs(60)),
        SLOW => std::thread::sleep(Duration::from_millis(400)),
        _ => {}
    }
    Ok(())
}

fn one_patch(mesh: Res<InputMesh>, mut commands: Commands) {
    commands.insert_resource(in_one_patch(&mesh.0));
}

/// A whole mesh as one patch.
pub fn in_one_patch(mesh: &Mesh) -> Segmentation {
    let [faces, vertices] = [mesh.polygons.face_count(), mesh.positions().len()];
    let summary = PatchSummary {
        faces: faces as u32,
        ..PatchSummary::default()
    };
    Segmentation {
        face_patches: vec![0; faces],
        patches: vec![PatchReport {
            id: 0,
            summary,
            surface: None,
            neighbours: Vec::new(),
        }],
        boundaries: vec![Boundary {
            patches: [0, 1],
            length: 1.0,
            sharp_share: 0.5,
            polylines: vec![vec![0, 1]],
            added: Vec::new(),
        }],
        vertices: VertexQuantities {
            k_min: vec![0.0; vertices],
            k_max: vec![0.0; vertices],
            d_min: vec![[0.0; 3]; vertices],
            d_max: vec![[0.0; 3]; vertices],
        },
        changes: None,
        refined: None,
        findings: examine(mesh, &Topology::build(vertices, mesh.triangles.clone())),
        stages: Vec::new(),
    }
}

/// An OBJ file of this many triangles in a row.
pub fn strip(faces: usize) -> String {
    let vertices = (0..faces + 2).map(|v| format!("v {} {} 0\n", v / 2, v % 2));
    let triangles = (1..=faces).map(|f| format!("f {f} {} {}\n", f + 1, f + 2));
    vertices.chain(triangles).collect()
}

const INSIDE: &str = "SEAMLINE_TEST_INSIDE";

/// Runs the test of this name again, alone, as root of a user and mount namespace of its own (`unshare`),
/// where it may mount what it likes and set limits that are nobody else's. There it gives the test's folder,
/// which `prepare` has filled; here it gives nothing, once the other has passed. Where the system has no
/// such namespaces to give, that is said and the test is skipped.
pub fn in_own_namespace(test: &str, prepare: impl FnOnce(&Path)) -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os(INSIDE) {
        return Some(folder.into());
    }
    let unshare = || {
        let mut command = Command::new("unshare");
        command.args(["--user", "--map-root-user", "--mount"]);
        command
    };
    if !unshare()
        .arg("true")
        .output()
        .is_ok_and(|tried| tried.status.success())
    {
        eprintln!("SKIPPED: {test}: `unshare --user --map-root-user --mount` does not work here");
        return None;
    }
    let home = tempfile::tempdir().unwrap();
    prepare(home.path());
    let again = unshare()
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture"])
        .env(INSIDE, home.path())
        .output()
        .unwrap();
    let [said, errors] = [&again.stdout, &again.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(again.status.success(), "{said}\n{errors}");
    for line in errors.lines().filter(|line| line.starts_with("SKIPPED")) {
        eprintln!("{line}");
    }
    assert!(
        said.contains("1 passed"),
        "no test is called {test}:\n{said}"
    );
    None
}
