//! Vertices moved at random, the same on every run.

use glam::DVec3;
use seamline_mesh::shapes::Shape;
use seamline_mesh::{Topology, weld};
use seamline_primitives::{Found, find};

/// What is found in a shape whose vertices are moved along each axis by up to half of `width`.
pub fn found_shaken(shape: &Shape, width: f64) -> Found {
    let mut random = 7u64;
    let mut unit = || {
        random = random
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (random >> 33) as f64 / f64::from(1u32 << 31) - 0.5
    };
    let mut mesh = weld(shape.polygons(), 0.0);
    for x in &mut mesh.polygons.positions {
        *x += DVec3::new(unit(), unit(), unit()) * width;
    }
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    find(mesh.positions(), &topology, 0.0)
}
