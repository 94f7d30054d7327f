//! The models with their truth.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use seamline_mesh::{Mesh, Topology, read, weld};
use seamline_tests::bench;

/// The tessellations there are.
pub const VARIANTS: [&str; 3] = ["coarse", "fine", "uniform"];

pub struct Model {
    pub name: String,
    pub variant: usize,
    pub mesh: Arc<Mesh>,
    pub topology: Topology,
    /// Turn of each edge in degrees, 0 where it has not just two faces.
    pub turns: Vec<f64>,
    pub truth: Vec<u32>,
}

/// All models of the bench; `None`, and a word on standard error, where it is absent.
pub fn models() -> Option<Vec<Model>> {
    let folder = bench("models")?;
    let mut paths: Vec<_> = fs::read_dir(folder)
        .expect("the folder can be listed")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|end| end == "stl"))
        .collect();
    paths.sort();
    Some(paths.iter().filter_map(|path| load(path)).collect())
}

fn load(path: &Path) -> Option<Model> {
    let name = path.file_stem()?.to_str()?.to_owned();
    let variant = VARIANTS.iter().position(|v| name.ends_with(v))?;
    let mesh = weld(read(path).expect("the model reads"), 0.0);
    let labels = fs::read_to_string(path.with_extension("seg")).expect("its truth");
    let truth = labels
        .lines()
        .map(|line| line.parse().expect("a label"))
        .collect();
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let normal = |face: u32| {
        let [a, b, c] = mesh.triangles[face as usize].map(|v| mesh.positions()[v as usize]);
        (b - a).cross(c - a)
    };
    let turn = |edge: usize| {
        topology.face_pair(edge).map_or(0.0, |[a, b]| {
            normal(a).angle_between(normal(b)).to_degrees()
        })
    };
    Some(Model {
        name,
        variant,
        turns: (0..topology.edge_faces.len()).map(turn).collect(),
        truth,
        mesh: Arc::new(mesh),
        topology,
    })
}
