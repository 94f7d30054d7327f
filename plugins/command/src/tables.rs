//! The columns of a mesh as Arrow tables.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float32Array, Float64Array, RecordBatch, UInt32Array};
use arrow_schema::Schema;
use seamline_ecs::components::{FaceSample, Position};
use seamline_ecs::{CurvatureSamples, LabelledMesh, SwappableStage};
use seamline_mesh::Topology;

const OF_SAMPLES: [&str; 4] = ["samples", "neighbours", "vertices", "faces"];
const OF_MESH: [&str; 3] = ["faces", "edges", "vertices"];

/// Does the stage have all these tables?
pub fn are_known(stage: SwappableStage, names: &[String]) -> bool {
    let known: &[&str] = match stage {
        SwappableStage::Classify => &OF_SAMPLES,
        SwappableStage::Rectify => &OF_MESH,
    };
    names.iter().all(|name| known.contains(&name.as_str()))
}

/// What a classifier is sent: the tables named, or all.
pub fn of_samples(seen: &CurvatureSamples<'_>, send: &[String]) -> Vec<RecordBatch> {
    let tables = OF_SAMPLES.map(|name| {
        let columns = || match name {
            "samples" => samples(seen),
            "neighbours" => pairs(&seen.neighbours(), ["a", "b"]),
            "vertices" => vertices(seen.positions),
            _ => {
                let sample = |face: &FaceSample| face.0;
                let mut columns = corners(seen.topology);
                columns.push(("sample", whole(seen.facet_of_face.iter().map(sample))));
                columns.push(("area", real(seen.shapes.iter().map(|shape| shape.area))));
                columns
            }
        };
        is_sent(name, send).then(|| (name, columns()))
    });
    batches(tables.into_iter().flatten(), "classify", "cluster")
}

/// What a rectifier is sent: the tables named, or all.
pub fn of_mesh(seen: &LabelledMesh<'_>, send: &[String]) -> Vec<RecordBatch> {
    let tables = OF_MESH.map(|name| {
        let columns = || match name {
            "faces" => {
                let mut columns = corners(seen.topology);
                columns.push(("label", whole(seen.labels.iter().map(|label| label.0))));
                columns.push(("area", real(seen.shapes.iter().map(|shape| shape.area))));
                columns
            }
            "edges" => edges(seen),
            _ => vertices(seen.positions),
        };
        is_sent(name, send).then(|| (name, columns()))
    });
    batches(tables.into_iter().flatten(), "rectify", "label")
}

type Columns = Vec<(&'static str, ArrayRef)>;

fn is_sent(name: &str, send: &[String]) -> bool {
    send.is_empty() || send.iter().any(|sent| sent == name)
}

fn samples(seen: &CurvatureSamples<'_>) -> Columns {
    let curvature = |k: usize| real(seen.samples.iter().map(move |s| s.curvature[k]));
    let feature = |k: usize| real(seen.features.iter().map(move |f| f.0[k]));
    let direction = |k: usize| -> ArrayRef {
        let values = seen.samples.iter().map(|sample| sample.d_min[k]);
        Arc::new(Float32Array::from_iter_values(values))
    };
    vec![
        ("area", real(seen.areas().into_iter())),
        ("k_min", curvature(0)),
        ("k_max", curvature(1)),
        ("feature_0", feature(0)),
        ("feature_1", feature(1)),
        ("d_x", direction(0)),
        ("d_y", direction(1)),
        ("d_z", direction(2)),
        ("vertex", whole(seen.samples.iter().map(|s| s.vertex))),
    ]
}

fn edges(seen: &LabelledMesh<'_>) -> Columns {
    let topology = seen.topology;
    let lengths = (0..seen.scores.len()).map(|edge| seen.edge_length(edge));
    let sharp: BooleanArray = seen.sharp.iter().map(|sharp| Some(sharp.0)).collect();
    let mut columns = pairs(&topology.edge_vertices, ["a", "b"]);
    columns.extend(pairs(&topology.edge_faces, ["left", "right"]));
    columns.extend([
        ("length", real(lengths)),
        ("score", real(seen.scores.iter().map(|score| score.0))),
        ("angle", real(seen.angles.iter().map(|angle| angle.0))),
        ("sharp", Arc::new(sharp) as ArrayRef),
    ]);
    columns
}

fn vertices(positions: &[Position]) -> Columns {
    let along = |k: usize| real(positions.iter().map(move |p| p.0[k]));
    vec![("x", along(0)), ("y", along(1)), ("z", along(2))]
}

fn corners(topology: &Topology) -> Columns {
    let corner = |k: usize| whole(topology.triangles.iter().map(move |t| t[k]));
    vec![("a", corner(0)), ("b", corner(1)), ("c", corner(2))]
}

fn pairs(pairs: &[[u32; 2]], names: [&'static str; 2]) -> Columns {
    let [first, second] = names;
    vec![
        (first, whole(pairs.iter().map(|pair| pair[0]))),
        (second, whole(pairs.iter().map(|pair| pair[1]))),
    ]
}

fn real(values: impl Iterator<Item = f64>) -> ArrayRef {
    Arc::new(Float64Array::from_iter_values(values))
}

fn whole(values: impl Iterator<Item = u32>) -> ArrayRef {
    Arc::new(UInt32Array::from_iter_values(values))
}

/// Each table with its schema, which says what it is.
fn batches(
    tables: impl Iterator<Item = (&'static str, Columns)>,
    stage: &str,
    answer: &str,
) -> Vec<RecordBatch> {
    let tables: Vec<_> = tables.collect();
    let names: Vec<_> = tables.iter().map(|(name, _)| *name).collect();
    let names = names.join(",");
    let batch = |(table, columns): (&str, Columns)| {
        let about = [
            ("protocol", "1"),
            ("stage", stage),
            ("table", table),
            ("tables", &names),
            ("answer", answer),
        ];
        let about: HashMap<String, String> = about
            .into_iter()
            .map(|(key, value)| (format!("seamline.{key}"), value.to_owned()))
            .collect();
        let batch = RecordBatch::try_from_iter(columns)
            .expect("the columns of one kind of element are of one length");
        let fields = batch.schema().fields().clone();
        batch
            .with_schema(Arc::new(Schema::new_with_metadata(fields, about)))
            .expect("the fields are the same")
    };
    tables.into_iter().map(batch).collect()
}
