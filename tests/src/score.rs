//! How well a segmentation agrees with the truth, by area and by boundary length.

use std::collections::BTreeMap;

use glam::DVec3;
use seamline_mesh::{Mesh, Topology};

/// Agreement of a labelling with the truth; 1 is perfect.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Adjusted Rand index on areas; 0 is chance.
    pub ari: f64,
    /// F1 of boundary edges, by length; an edge counts only if it is the very same edge.
    pub boundary_f1: f64,
}

/// Compares a labelling with the truth, one label a triangle each.
pub fn agreement(mesh: &Mesh, truth: &[u32], found: &[u32]) -> Agreement {
    Agreement {
        ari: adjusted_rand_index(mesh, truth, found),
        boundary_f1: boundary_f1(mesh, truth, found),
    }
}

fn adjusted_rand_index(mesh: &Mesh, truth: &[u32], found: &[u32]) -> f64 {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| mesh.positions()[v as usize]);
        (b - a).cross(c - a).length()
    };
    let whole: f64 = mesh.triangles.iter().map(area).sum();
    let mut both: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let (mut of_truth, mut of_found) = (BTreeMap::new(), BTreeMap::new());
    for (corners, (&t, &f)) in mesh.triangles.iter().zip(truth.iter().zip(found)) {
        let share = area(corners) / whole;
        *both.entry((t, f)).or_default() += share;
        *of_truth.entry(t).or_insert(0.0) += share;
        *of_found.entry(f).or_insert(0.0) += share;
    }
    if of_truth.len() == 1 && of_found.len() == 1 {
        return 1.0;
    }
    let together: f64 = both.values().map(|w| w * w).sum();
    let squares = |shares: &BTreeMap<u32, f64>| shares.values().map(|w| w * w).sum::<f64>();
    let (a, b) = (squares(&of_truth), squares(&of_found));
    (together - a * b) / ((a + b) / 2.0 - a * b)
}

fn boundary_f1(mesh: &Mesh, truth: &[u32], found: &[u32]) -> f64 {
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let at = |v: u32| -> DVec3 { mesh.positions()[v as usize] };
    let [mut both, mut in_truth, mut in_found] = [0.0; 3];
    for (edge, [a, b]) in topology.edge_vertices.iter().enumerate() {
        let Some([left, right]) = topology.face_pair(edge) else {
            continue;
        };
        let parts = |labels: &[u32]| labels[left as usize] != labels[right as usize];
        let length = at(*a).distance(at(*b));
        in_truth += if parts(truth) { length } else { 0.0 };
        in_found += if parts(found) { length } else { 0.0 };
        both += if parts(truth) && parts(found) {
            length
        } else {
            0.0
        };
    }
    let precision = if in_found > 0.0 { both / in_found } else { 1.0 };
    let recall = if in_truth > 0.0 { both / in_truth } else { 1.0 };
    if precision + recall > 0.0 {
        2.0 * precision * recall / (precision + recall)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use seamline_mesh::{shapes, weld};

    #[test]
    fn the_truth_agrees_with_itself_and_one_patch_for_all_is_chance() {
        let cube = shapes::cuboid(DVec3::ONE);
        let mesh = weld(cube.polygons(), 0.0);
        let truth: Vec<u32> = mesh
            .face_of_triangle
            .iter()
            .map(|&face| cube.patches[face as usize])
            .collect();
        let same = agreement(&mesh, &truth, &truth);
        assert!((same.ari - 1.0).abs() < 1e-12 && same.boundary_f1 == 1.0);
        let one = agreement(&mesh, &truth, &vec![0; truth.len()]);
        assert!(one.ari.abs() < 1e-12 && one.boundary_f1 == 0.0);
    }
}
