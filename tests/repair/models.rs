//! The models with their truth.

use std::fs;
use std::path::{Path, PathBuf};
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
    let of_variant = |path: &PathBuf| {
        let model = load(path);
        let variant = VARIANTS.iter().position(|v| model.name.ends_with(v))?;
        Some(Model { variant, ..model })
    };
    Some(paths.iter().filter_map(of_variant).collect())
}

/// A model with its truth, as the first variant.
pub fn load(path: &Path) -> Model {
    let name = path.file_stem().unwrap_or_default();
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
    Model {
        name: name.to_string_lossy().into_owned(),
        variant: 0,
        turns: (0..topology.edge_faces.len()).map(turn).collect(),
        truth,
        mesh: Arc::new(mesh),
        topology,
    }
}
