//! What remains of it when vertices do not lie where they were designed.

use std::f64::consts::TAU;
use std::sync::Arc;

use fastrand::Rng;
use glam::DVec3;
use seamline_ecs::{Segmentation, Worker};
use seamline_mesh::{Mesh, Topology, weld};
use seamline_tests::models::{Model, VARIANTS};
use seamline_tests::pipeline;
use seamline_tests::score::{Agreement, agreement};

use crate::text::{means, of};

/// Standard deviation of each coordinate, as shares of the mean edge length.
const NOISE: [f64; 5] = [0.0, 0.001, 0.003, 0.01, 0.03];

/// Coarse meshes have edges as long as the part, and a share of them is no small noise.
const MEASURED: [&str; 2] = ["fine", "uniform"];

pub fn print(models: &[Model]) {
    println!(
        "\n### Noise\n\n\
        | profile, noise / mean edge | meshes | ARI | F1 | exact | cut by surfaces |\n|---|---|---|---|---|---|"
    );
    for profile in ["cad", "lavoue2005"] {
        let mut worker = Worker::new(pipeline(&[&format!("pipeline.profile={profile}")]));
        for noise in NOISE {
            for variant in MEASURED {
                let models: Vec<_> = models
                    .iter()
                    .filter(|model| VARIANTS[model.variant] == variant)
                    .collect();
                let found: Vec<_> = models
                    .iter()
                    .map(|model| under(noise, model, &mut worker))
                    .collect();
                if found.is_empty() {
                    continue;
                }
                let agreements: Vec<_> = found.iter().map(|found| found.0).collect();
                let by_surfaces = found.iter().filter(|found| found.1).count();
                println!(
                    "| `{profile}`, {} % | {variant} ({}) | {} | {} |",
                    noise * 100.0,
                    models.len(),
                    means(&agreements),
                    of(by_surfaces, models.len())
                );
            }
        }
    }
}

/// A model with noise: its agreement with the truth, and whether surfaces led.
fn under(noise: f64, model: &Model, worker: &mut Worker) -> (Agreement, bool) {
    let mesh = Arc::new(moved(&model.mesh, noise, seed(&model.name)));
    let cut = worker
        .segment(Arc::clone(&mesh))
        .expect("every step does its work");
    (
        agreement(&mesh, &model.truth, &cut.face_patches),
        surfaces_led(&cut),
    )
}

/// A classifier always counts something, if it is asked.
fn surfaces_led(cut: &Segmentation) -> bool {
    let classify = cut.stages.iter().find(|r| r.stage.name() == "classify");
    classify.expect("all stages are told").counts.is_empty()
}

/// The same for a model at every noise and on every machine, so that rows differ by the noise's size alone.
fn seed(name: &str) -> u64 {
    name.bytes().fold(0, |seed: u64, byte| {
        seed.wrapping_mul(31).wrapping_add(u64::from(byte))
    })
}

/// Every vertex moved, and put down in single precision as a file would have it.
fn moved(mesh: &Mesh, noise: f64, seed: u64) -> Mesh {
    let mut rng = Rng::with_seed(seed);
    let deviation = noise * mean_edge(mesh);
    let mut polygons = mesh.polygons.clone();
    for position in &mut polygons.positions {
        let by = DVec3::from_array(std::array::from_fn(|_| gaussian(&mut rng)));
        *position = (*position + by * deviation).as_vec3().as_dvec3();
    }
    weld(polygons, 0.0)
}

fn mean_edge(mesh: &Mesh) -> f64 {
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let edges = &topology.edge_vertices;
    let length = |[a, b]: [u32; 2]| {
        let [a, b] = [a, b].map(|v| mesh.positions()[v as usize]);
        a.distance(b)
    };
    edges.iter().map(|&edge| length(edge)).sum::<f64>() / edges.len() as f64
}

/// By Box and Muller, mean 0 and deviation 1.
fn gaussian(rng: &mut Rng) -> f64 {
    (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (TAU * rng.f64()).cos()
}
