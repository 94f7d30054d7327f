//! Labels of a sheet of 4 x 4 unit squares held against the surfaces it is said to lie on.

use glam::{DVec3, dvec3};
use seamline_contour_tracking::{Outvoted, outvote};
use seamline_ecs::components::{DihedralAngle, FaceLabel, FaceShape, NONE, Position, SharpEdge};
use seamline_ecs::{GivenAs, LabelledMesh, MeshScale, boundary};
use seamline_mesh::{Format, PolygonMesh, Topology, weld};

const SIDE: u32 = 4;

/// A value for each triangle, by the column of its square.
fn by_column(of: impl Fn(u32) -> u32) -> Vec<u32> {
    (0..SIDE * SIDE)
        .flat_map(|square| [of(square % SIDE); 2])
        .collect()
}

/// Labels and surfaces held against each other; the whole boundary is rough.
fn outvoted(labels: &[u32], surfaces: &[u32]) -> (Outvoted, Topology) {
    let at = |x: u32, y: u32| y * (SIDE + 1) + x;
    let mut triangles = Vec::new();
    for (y, x) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (y, x))) {
        triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
        triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
    }
    let corners = (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| (x, y)));
    let places: Vec<_> = corners
        .map(|(x, y)| dvec3(f64::from(x), f64::from(y), 0.0))
        .collect();
    let positions: Vec<Position> = places.iter().map(|&place| Position(place)).collect();
    let topology = Topology::build(places.len(), triangles.clone());
    let mesh = weld(
        PolygonMesh::from_triangles(Format::Memory, places, &triangles),
        0.0,
    );
    let edges = topology.edge_faces.len();
    let labels: Vec<FaceLabel> = labels.iter().map(|&label| FaceLabel(label)).collect();
    let rough = boundary(&topology, &labels);
    let found = outvote(
        &LabelledMesh {
            topology: &topology,
            positions: &positions,
            shapes: &vec![
                FaceShape {
                    area: 0.5,
                    ..FaceShape::default()
                };
                labels.len()
            ],
            angles: &vec![DihedralAngle(0.0); edges],
            sharp: &vec![SharpEdge(false); edges],
            scores: &[],
            labels: &labels,
            given_edges: &[],
            given_as: GivenAs::Labels,
            mesh: &mesh,
            scale: MeshScale {
                centre: DVec3::ZERO,
                length: 1.0,
            },
        },
        surfaces,
        &rough,
    );
    (found, topology)
}

fn labels(found: &Outvoted) -> Vec<u32> {
    found.labels.iter().map(|label| label.0).collect()
}

#[test]
fn faces_that_went_over_come_back_and_the_edges_between_surfaces_are_proved() {
    let halves = by_column(|x| x / 2);
    let mut rough = halves.clone();
    for (face, label) in [(2, 1), (12, 0), (13, 0), (27, 1)] {
        rough[face] = label;
    }
    let (found, topology) = outvoted(&rough, &halves);
    assert_eq!(labels(&found), halves);
    assert_eq!(found.proved.len(), SIDE as usize);
    assert_eq!(found.proved, boundary(&topology, &found.labels));
}

#[test]
fn a_surface_that_two_labels_share_by_somebodys_will_is_left() {
    let thirds = by_column(|x| u32::from(x > 0));
    let (found, _) = outvoted(&thirds, &[0; 2 * (SIDE * SIDE) as usize]);
    assert_eq!(labels(&found), thirds);
    assert!(found.proved.is_empty());
    assert!(found.settled_by.iter().all(|&surface| surface == NONE));
}

/// Classes of faces, as a network gives them: each is on all surfaces, and has most of itself on none.
#[test]
fn a_surface_shared_by_labels_that_are_at_home_nowhere_is_left() {
    let of_rows: Vec<u32> = (0..SIDE * SIDE)
        .flat_map(|square| [u32::from(square / SIDE > 1); 2])
        .collect();
    let (found, _) = outvoted(&of_rows, &by_column(|x| x));
    assert_eq!(labels(&found), of_rows);
    assert!(found.proved.is_empty());
}

#[test]
fn a_label_that_is_on_many_surfaces_keeps_all_of_them() {
    let halves = by_column(|x| x / 2);
    let (found, _) = outvoted(&halves, &by_column(|x| x));
    assert_eq!(labels(&found), halves);
}

#[test]
fn where_no_surface_is_known_labels_are_left() {
    let halves = by_column(|x| x / 2);
    let mut rough = halves.clone();
    rough[2] = 1;
    for surfaces in [&[][..], &[NONE; 2 * (SIDE * SIDE) as usize]] {
        assert_eq!(labels(&outvoted(&rough, surfaces).0), rough);
    }
}
