//! Everything that is told of one mesh, as JSON.
//!
//! The same input, settings and version give the same report, with one exception: the key `seconds`, which
//! holds times by the clock. Nothing outside it differs between two runs.

use std::path::Path;

use seamline_ecs::Segmentation;
use seamline_ecs::results::{Boundary, Changes, PatchReport, RefinedMesh};
use seamline_mesh::{Findings, Format, Markings, Mesh};
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::load::LoadedMarkings;

/// The form of the report: counted up when a key changes its meaning or goes, not when one is added.
pub const REPORT_SCHEMA_VERSION: u32 = 1;

/// What is known of a job besides its mesh and its patches.
#[derive(Clone, Copy, Debug)]
pub struct JobFacts<'a> {
    /// The input file, as it is to be named in the report.
    pub path: &'a Path,
    /// BLAKE3 of its bytes, in hexadecimal.
    pub hash: &'a str,
    /// The format found.
    pub format: Format,
    /// Its length in bytes.
    pub bytes_len: u64,
    /// What another tool has marked on the mesh.
    pub markings: Option<&'a LoadedMarkings>,
    /// The settings in force, every default written out.
    pub settings: &'a toml::Table,
    /// The version of the program.
    pub program_version: &'a str,
    /// How long reading the file took, by the clock.
    pub read_seconds: f64,
}

#[derive(Serialize)]
struct Report<'a> {
    schema_version: u32,
    program: Program<'a>,
    input: Input<'a>,
    settings: &'a toml::Table,
    findings: &'a Findings,
    stages: Vec<Value>,
    patches: &'a [PatchReport],
    boundaries: &'a [Boundary],
    #[serde(skip_serializing_if = "Option::is_none")]
    changes: Option<&'a Changes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refined: Option<&'a RefinedMesh>,
    seconds: Map<String, Value>,
}

#[derive(Serialize)]
struct Program<'a> {
    name: &'static str,
    version: &'a str,
}

#[derive(Serialize)]
struct Input<'a> {
    path: String,
    blake3: &'a str,
    format: &'static str,
    bytes: u64,
    faces: usize,
    triangles: usize,
    vertices: usize,
    units: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    markings: Option<Marked<'a>>,
}

#[derive(Serialize)]
struct Marked<'a> {
    path: String,
    blake3: &'a str,
    what: &'static str,
    count: usize,
}

/// The report on one mesh, as it stands in `report.json`. Keys are always in the same order. It borrows what
/// it tells: as a tree of values, a mesh of many patches would take twice the memory of cutting it.
pub fn report<'a>(
    mesh: &Mesh,
    segmentation: &'a Segmentation,
    about: &JobFacts<'a>,
) -> impl Serialize + use<'a> {
    Report {
        schema_version: REPORT_SCHEMA_VERSION,
        program: Program {
            name: "seamline",
            version: about.program_version,
        },
        input: Input {
            path: about.path.display().to_string(),
            blake3: about.hash,
            format: about.format.name(),
            bytes: about.bytes_len,
            faces: mesh.polygons.face_count(),
            triangles: mesh.triangles.len(),
            vertices: mesh.positions().len(),
            units: "as in the file",
            markings: about.markings.map(marked),
        },
        settings: about.settings,
        findings: &segmentation.findings,
        stages: stages(segmentation),
        patches: &segmentation.patches,
        boundaries: &segmentation.boundaries,
        changes: segmentation.changes.as_ref(),
        refined: segmentation.refined.as_ref(),
        seconds: seconds(segmentation, about.read_seconds),
    }
}

fn marked(given: &LoadedMarkings) -> Marked<'_> {
    let (what, count) = match &*given.markings {
        Markings::Labels(labels) => ("labels", labels.len()),
        Markings::Edges(edges) => ("edges", edges.len()),
    };
    Marked {
        path: given.path.display().to_string(),
        blake3: &given.hash,
        what,
        count,
    }
}

/// Stages without their times.
fn stages(segmentation: &Segmentation) -> Vec<Value> {
    let stages = segmentation.stages.iter();
    stages
        .map(|record| {
            json!({ "stage": record.stage, "counts": record.counts, "measures": record.measures })
        })
        .collect()
}

/// All times, in the order spent, and their sum.
fn seconds(segmentation: &Segmentation, read: f64) -> Map<String, Value> {
    let stages = segmentation
        .stages
        .iter()
        .map(|record| (record.stage.name(), record.seconds));
    let spent: Vec<_> = [("read", read)].into_iter().chain(stages).collect();
    let total = spent.iter().map(|(_, seconds)| seconds).sum();
    let all = spent.into_iter().chain([("total", total)]);
    all.map(|(name, seconds)| (name.to_owned(), json!(seconds)))
        .collect()
}
