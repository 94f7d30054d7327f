//! Cuts on a sheet of unit squares, each two triangles.

use proptest::prelude::*;
use seamline_ecs::components::FaceLabel;
use seamline_graph_cut::recut;
use seamline_mesh::Topology;

const SIDE: u32 = 12;

/// A sheet whose edges cost `cheap` on the line `x` and 100 elsewhere.
struct Sheet {
    topology: Topology,
    costs: Vec<u64>,
}

impl Sheet {
    fn with_cheap_line(x: u32, cheap: u64) -> Self {
        let at = |x: u32, y: u32| y * (SIDE + 1) + x;
        let mut triangles = Vec::new();
        for (x, y) in squares() {
            triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
        }
        let topology = Topology::build(((SIDE + 1) * (SIDE + 1)) as usize, triangles);
        let on_line = |ends: &[u32; 2]| ends.iter().all(|v| v % (SIDE + 1) == x);
        let cost = |ends| if on_line(ends) { cheap } else { 100 };
        let costs = topology.edge_vertices.iter().map(cost).collect();
        Self { topology, costs }
    }

    fn recut(&self, rings: u32, labels: &mut [FaceLabel]) -> usize {
        recut(&self.topology, &self.costs, rings, labels).patches
    }
}

fn squares() -> impl Iterator<Item = (u32, u32)> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)))
}

/// Two patches, the right one beginning where `starts` says for each row.
fn split(starts: impl Fn(u32) -> u32) -> Vec<FaceLabel> {
    squares()
        .flat_map(|(x, y)| [FaceLabel(u32::from(x >= starts(y))); 2])
        .collect()
}

#[test]
fn a_jagged_boundary_moves_to_the_cheap_line_beside_it() {
    let sheet = Sheet::with_cheap_line(6, 1);
    let mut labels = split(|y| 5 + y % 3);
    assert_eq!(sheet.recut(4, &mut labels), 2);
    assert_eq!(labels, split(|_| 6));
}

#[test]
fn a_boundary_that_is_best_where_it_is_stays() {
    let sheet = Sheet::with_cheap_line(6, 1);
    let mut labels = split(|_| 6);
    assert_eq!(sheet.recut(4, &mut labels), 2);
    assert_eq!(labels, split(|_| 6));
}

#[test]
fn beyond_the_band_nothing_moves() {
    let sheet = Sheet::with_cheap_line(10, 1);
    let mut labels = split(|_| 3);
    sheet.recut(2, &mut labels);
    assert_eq!(labels, split(|_| 3), "of equal cuts the one that is there");
}

#[test]
fn a_patch_of_one_strip_stays_as_it_is() {
    let sheet = Sheet::with_cheap_line(9, 1);
    let strip = |x: u32| u32::from(x >= 6) + u32::from(x >= 7);
    let labels: Vec<_> = squares()
        .flat_map(|(x, _)| [FaceLabel(strip(x)); 2])
        .collect();
    let mut recut = labels.clone();
    sheet.recut(1, &mut recut);
    let of_strip = |labels: &[FaceLabel]| -> Vec<usize> {
        (0..labels.len())
            .filter(|&f| labels[f] == labels[12])
            .collect()
    };
    assert!(
        of_strip(&labels)
            .iter()
            .all(|f| of_strip(&recut).contains(f))
    );
}

#[test]
fn one_patch_and_no_faces_have_nothing_to_cut() {
    let sheet = Sheet::with_cheap_line(6, 1);
    let mut whole = vec![FaceLabel(7); 2 * (SIDE * SIDE) as usize];
    assert_eq!(sheet.recut(3, &mut whole), 1);
    assert!(whole.iter().all(|label| label.0 == 0));
    assert_eq!(
        recut(&Topology::build(0, vec![]), &[], 3, &mut []).patches,
        0
    );
}

proptest! {
    #[test]
    fn the_boundaries_of_two_patches_never_cost_more_than_before(
        starts in prop::collection::vec(1u32..SIDE, SIDE as usize),
        rings in 0u32..6,
    ) {
        let sheet = Sheet::with_cheap_line(6, 1);
        let mut labels = split(|y| starts[y as usize]);
        let cost = |labels: &[FaceLabel]| -> u64 {
            (0..sheet.costs.len())
                .filter_map(|edge| Some((edge, sheet.topology.face_pair(edge)?)))
                .filter(|(_, [a, b])| labels[*a as usize] != labels[*b as usize])
                .map(|(edge, _)| sheet.costs[edge])
                .sum()
        };
        let before = cost(&labels);
        sheet.recut(rings, &mut labels);
        prop_assert!(cost(&labels) <= before);
    }
}
