//! How well a segmentation agrees with the truth, by area and by boundary length.

use std::collections::{BTreeMap, BTreeSet};

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
    let partners = partners(mesh, truth, found);
    let exact = partners.values().filter(|partner| partner.exact).count();
    Agreement {
        ari: adjusted_rand_index(mesh, truth, found),
        boundary_f1: boundary_f1(mesh, truth, found),
        exact: exact as f64 / partners.len() as f64,
    }
}

/// The found patch a true one has most area in common with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Partner {
    /// Its label.
    pub found: u32,
    /// Is the area in common .95 of the area of both, or more?
    pub exact: bool,
}

/// The partner of each true patch, by its label.
pub fn partners(mesh: &Mesh, truth: &[u32], found: &[u32]) -> BTreeMap<u32, Partner> {
    let mut both: BTreeMap<(u32, u32), f64> = BTreeMap::new();
    let (mut of_truth, mut of_found) = (BTreeMap::new(), BTreeMap::new());
    for (corners, (&t, &f)) in mesh.triangles.iter().zip(truth.iter().zip(found)) {
        let area = area(mesh, corners);
        *both.entry((t, f)).or_default() += area;
        *of_truth.entry(t).or_insert(0.0) += area;
        *of_found.entry(f).or_insert(0.0) += area;
    }
    let mut partners: BTreeMap<u32, (Partner, f64)> = BTreeMap::new();
    for ((t, found), common) in both {
        // No two patches can have so much in common with the same one, so that the scorer's matching of one to one
        // has nothing to decide here.
        let exact = common >= 0.95 * (of_truth[&t] + of_found[&found] - common);
        let most = partners.get(&t).map_or(-1.0, |&(_, most)| most);
        if common > most {
            partners.insert(t, (Partner { found, exact }, common));
        }
    }
    let told = partners.into_iter().map(|(t, (partner, _))| (t, partner));
    told.collect()
}

/// Share of the length of tangent boundaries that is found as boundary: those no crease betrays. `tangent` has the pairs
/// of true patches that meet without an edge, lower label first. `None` if there are none.
pub fn tangent_recall(
    mesh: &Mesh,
    truth: &[u32],
    found: &[u32],
    tangent: &BTreeSet<[u32; 2]>,
) -> Option<f64> {
    if tangent.is_empty() {
        return None;
    }
    let [mut there, mut recalled] = [0.0; 2];
    for ([left, right], length) in inner_edges(mesh) {
        let mut patches = [left, right].map(|face| truth[face as usize]);
        patches.sort_unstable();
        if tangent.contains(&patches) {
            there += length;
            let parts = found[left as usize] != found[right as usize];
            recalled += if parts { length } else { 0.0 };
        }
    }
    Some(if there > 0.0 { recalled / there } else { 1.0 })
}

/// The two faces of each edge that has two, and its length.
fn inner_edges(mesh: &Mesh) -> Vec<([u32; 2], f64)> {
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let at = |v: u32| -> DVec3 { mesh.positions()[v as usize] };
    let edges = topology.edge_vertices.iter().enumerate();
    edges
        .filter_map(|(edge, &[a, b])| Some((topology.face_pair(edge)?, at(a).distance(at(b)))))
        .collect()
}

fn area(mesh: &Mesh, corners: &[u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| mesh.positions()[v as usize]);
    (b - a).cross(c - a).length() / 2.0
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
    let [mut both, mut in_truth, mut in_found] = [0.0; 3];
    for ([left, right], length) in inner_edges(mesh) {
        let parts = |labels: &[u32]| labels[left as usize] != labels[right as usize];
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
        let partners = partners(&mesh, &truth, &joined);
        assert_eq!([1, 2].map(|t| partners[&t].found), [0, 2]);
        assert_eq!([1, 2].map(|t| partners[&t].exact), [false, true]);

        // Patches 0 to 3 go round, 0 and 2 do not touch, and all edges have one length.
        let recall = |tangent: &[[u32; 2]]| {
            tangent_recall(&mesh, &truth, &joined, &tangent.iter().copied().collect())
        };
        assert_eq!(recall(&[[0, 1], [1, 2]]), Some(0.5));
        assert_eq!(recall(&[[0, 2]]), Some(1.0));
        assert_eq!(recall(&[]), None);
    }
}
