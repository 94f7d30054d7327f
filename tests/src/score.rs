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
    /// Share of the true patches that are found with an area in common of .95 of the area of both, or more.
    pub exact: f64,
}

/// Compares a labelling with the truth, one label a triangle each.
pub fn agreement(mesh: &Mesh, truth: &[u32], found: &[u32]) -> Agreement {
    Agreement {
        ari: adjusted_rand_index(mesh, truth, found),
        boundary_f1: boundary_f1(mesh, truth, found),
        exact: exact(mesh, truth, found),
    }
}

fn area(mesh: &Mesh, corners: &[u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| mesh.positions()[v as usize]);
    (b - a).cross(c - a).length() / 2.0
}

fn exact(mesh: &Mesh, truth: &[u32], found: &[u32]) -> f64 {
    let mut both: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let (mut of_truth, mut of_found) = (BTreeMap::new(), BTreeMap::new());
    for (corners, (&t, &f)) in mesh.triangles.iter().zip(truth.iter().zip(found)) {
        let area = area(mesh, corners);
        *both.entry((t, f)).or_default() += area;
        *of_truth.entry(t).or_insert(0.0) += area;
        *of_found.entry(f).or_insert(0.0) += area;
    }
    // No two patches can have so much in common with the same one.
    let is_exact = |&(&(t, f), &common): &(&(u32, u32), &f64)| {
        common >= 0.95 * (of_truth[&t] + of_found[&f] - common)
    };
    both.iter().filter(is_exact).count() as f64 / of_truth.len() as f64
}

fn adjusted_rand_index(mesh: &Mesh, truth: &[u32], found: &[u32]) -> f64 {
    let whole: f64 = mesh
        .triangles
        .iter()
        .map(|corners| area(mesh, corners))
        .sum();
    let mut both: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let (mut of_truth, mut of_found) = (BTreeMap::new(), BTreeMap::new());
    for (corners, (&t, &f)) in mesh.triangles.iter().zip(truth.iter().zip(found)) {
        let share = area(mesh, corners) / whole;
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
        assert!((same.ari - 1.0).abs() < 1e-12 && same.boundary_f1 == 1.0 && same.exact == 1.0);
        let one = agreement(&mesh, &truth, &vec![0; truth.len()]);
        assert!(one.ari.abs() < 1e-12 && one.boundary_f1 == 0.0 && one.exact == 0.0);

        let mut joined = truth.clone();
        joined
            .iter_mut()
            .filter(|label| **label == 1)
            .for_each(|label| *label = 0);
        let four_of_six = agreement(&mesh, &truth, &joined);
        assert!((four_of_six.exact - 4.0 / 6.0).abs() < 1e-12);
    }
}
