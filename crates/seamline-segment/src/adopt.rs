//! Adopt: what another tool has found takes the place of what classifying, growing and merging would have.

use bevy_ecs::prelude::*;
use seamline_ecs::components::{DihedralAngle, FaceLabel, FaceSample, NONE};
use seamline_ecs::{
    Column, ColumnMut, Counts, GivenAs, GivenBoundary, InputMarkings, InputMesh, MeshTopology,
    Stage, StageSystems, StepError, boundary, fallible,
};
use seamline_mesh::{Markings, Mesh, Sets, Topology};

use crate::hard_edges::{HardEdgeSettings, hard_edges};
use crate::spatial_order::SpatialOrder;

pub(crate) fn systems() -> StageSystems {
    fallible(adopt).in_set(Stage::Merge)
}

/// Where nothing is classified faces belong to no sample, until somebody measures facets.
pub(crate) fn no_samples() -> StageSystems {
    (|mut samples: ColumnMut<FaceSample>| samples.fill(FaceSample(NONE))).in_set(Stage::Curvature)
}

fn adopt(
    markings: Option<Res<InputMarkings>>,
    looked_for: Res<HardEdgeSettings>,
    mesh: Res<InputMesh>,
    order: Res<SpatialOrder>,
    topology: Res<MeshTopology>,
    angles: Column<DihedralAngle>,
    mut labels: ColumnMut<FaceLabel>,
    mut given: ResMut<GivenBoundary>,
    mut counts: ResMut<Counts>,
) -> Result<(), StepError> {
    let topology = &topology.0;
    *given = match markings.as_deref() {
        None if looked_for.strong_deg > 0.0 => {
            let strong = looked_for.strong_deg.to_radians();
            let weak = match looked_for.weak_deg {
                0.0 => strong,
                weak => weak.to_radians(),
            };
            GivenBoundary {
                edges: hard_edges(topology, &angles, weak, strong),
                origin: GivenAs::HardEdges,
                at_borders: 0,
            }
        }
        None => {
            return Err(StepError::new(
                "nothing is given to be rectified",
                "give labels or edges with the mesh, or set `hard-edges.strong_deg`",
            ));
        }
        Some(InputMarkings(markings)) => match &**markings {
            Markings::Labels(of_face) => {
                adopt_labels(&mesh.0, &order, of_face, &mut labels);
                GivenBoundary {
                    edges: boundary(topology, &labels),
                    origin: GivenAs::Labels,
                    at_borders: 0,
                }
            }
            Markings::Edges(pairs) => {
                let (edges, at_borders) = adopt_edges(topology, &order, pairs);
                GivenBoundary {
                    edges,
                    origin: GivenAs::Edges,
                    at_borders,
                }
            }
        },
    };
    if given.origin != GivenAs::Labels {
        label_between(topology, &given.edges, &mut labels);
    }
    counts.note(Stage::Merge, "given_edges", given.edges.len());
    Ok(())
}

/// The label of each face row, out of those of the faces of the file.
pub fn adopt_labels(mesh: &Mesh, order: &SpatialOrder, of_face: &[u32], labels: &mut [FaceLabel]) {
    // Backwards, so that of triangles that are there twice the first one's label holds.
    let triangles = order.row_of_triangle.iter().zip(&mesh.face_of_triangle);
    for (&row, &face) in triangles.rev() {
        labels[row as usize].0 = of_face[face as usize];
    }
    // A file may have many faces without area and so more labels than there are rows.
    let mut number = vec![NONE; of_face.len()];
    let mut next = 0;
    for label in labels {
        let known = &mut number[label.0 as usize];
        if *known == NONE {
            *known = next;
            next += 1;
        }
        label.0 = *known;
    }
}

/// The edges with two faces between the given pairs of vertices of the mesh, rising, and how many others there are: on
/// borders, and where more than two faces meet.
pub fn adopt_edges(
    topology: &Topology,
    order: &SpatialOrder,
    pairs: &[[u32; 2]],
) -> (Vec<u32>, usize) {
    let mut row_of_vertex = vec![NONE; order.vertex_of_row.len()];
    for (row, &vertex) in order.vertex_of_row.iter().enumerate() {
        row_of_vertex[vertex as usize] = row as u32;
    }
    let edge_between = |pair: &[u32; 2]| {
        let [a, b] = pair.map(|vertex| row_of_vertex[vertex as usize]);
        let around = topology.vertex_edges.row(a as usize).iter();
        around.copied().find(|&edge| topology.far_end(edge, a) == b)
    };
    let mut edges: Vec<u32> = pairs.iter().filter_map(edge_between).collect();
    edges.sort_unstable();
    edges.dedup();
    let all = edges.len();
    edges.retain(|&edge| topology.face_pair(edge as usize).is_some());
    let others = all - edges.len();
    (edges, others)
}

/// Labels faces alike that hang together without crossing one of the edges, numbered by lowest face.
fn label_between(topology: &Topology, edges: &[u32], labels: &mut [FaceLabel]) {
    let mut is_given = vec![false; topology.edge_faces.len()];
    edges
        .iter()
        .for_each(|&edge| is_given[edge as usize] = true);
    let mut sets = Sets::new(labels.len());
    for (edge, given) in is_given.iter().enumerate() {
        if !given && let Some([a, b]) = topology.face_pair(edge) {
            sets.unite(a, b);
        }
    }
    for (label, set) in labels.iter_mut().zip(sets.numbered().0) {
        label.0 = set;
    }
}
