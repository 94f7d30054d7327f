//! The refined mesh by the mesh's own vertices and in its own unit.

use std::collections::{BTreeMap, BTreeSet};

use seamline_ecs::components::NONE;
use seamline_ecs::results::{RefinedMesh, VertexQuantities};
use seamline_mesh::{Format, Mesh, PolygonMesh, Topology};

use crate::boundaries::chains;
use crate::changes::{measure, mesh_edge};
use crate::export::LabelledRows;
use crate::refine::RefinedRows;

/// Edges by the pair of patches they part.
type Curves = BTreeMap<[u32; 2], Vec<[u32; 2]>>;

fn rising([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The mesh with the new vertices after its own.
pub(crate) fn refined_mesh(
    mesh: &Mesh,
    rows: &LabelledRows,
    refined: &RefinedRows,
    of_vertices: Option<&VertexQuantities>,
) -> RefinedMesh {
    let own = mesh.positions().len();
    let vertex = |v: u32| match rows.order.vertex_of_row.get(v as usize) {
        Some(&own) => own,
        None => v,
    };
    let mut positions = mesh.positions().to_vec();
    let mut vertices = of_vertices.cloned();
    for &(edge, share) in &refined.new_vertices {
        let [a, b] = rows.bending.topology.edge_vertices[edge as usize];
        let [a, b] = [a, b].map(|row| vertex(row) as usize);
        positions.push(positions[a].lerp(positions[b], share));
        let Some(vertices) = &mut vertices else {
            continue;
        };
        let between = |values: &mut Vec<f32>| {
            values.push(values[a] + (values[b] - values[a]) * share as f32);
        };
        between(&mut vertices.k_min);
        between(&mut vertices.k_max);
        let nearest = if share < 0.5 { a } else { b };
        vertices.d_min.push(vertices.d_min[nearest]);
        vertices.d_max.push(vertices.d_max[nearest]);
    }
    let patches = patches(rows, refined);
    let triangles: Vec<[u32; 3]> = refined
        .triangles
        .iter()
        .map(|(corners, ..)| corners.map(vertex))
        .collect();
    let topology = Topology::build(positions.len(), triangles.clone());
    let given = rows.given.map_or(&[][..], |given| given.edges);
    let given: BTreeSet<[u32; 2]> = given
        .iter()
        .map(|&edge| rising(mesh_edge(rows, edge)))
        .collect();
    let [mut kept, mut added] = [Curves::new(), Curves::new()];
    let mut all: Vec<[u32; 2]> = Vec::new();
    for edge in 0..topology.edge_faces.len() {
        if let Some(faces) = topology.face_pair(edge) {
            let patches = faces.map(|face| patches[face as usize]);
            if patches[0] != patches[1] {
                let ends = topology.edge_vertices[edge];
                let curves = if given.contains(&ends) {
                    &mut kept
                } else {
                    &mut added
                };
                curves.entry(rising(patches)).or_default().push(ends);
                all.push(ends);
            }
        }
    }
    let curves = |of: Curves| of.into_iter().map(|(pair, edges)| (pair, chains(&edges)));
    RefinedMesh {
        boundary: measure(&topology, &all, |v| positions[v as usize], 1.0),
        kept: curves(kept).collect(),
        added: curves(added).collect(),
        vertices_added: positions.len() - own,
        polygons: PolygonMesh::from_triangles(Format::Memory, positions, &triangles),
        patches,
        vertices: vertices.unwrap_or_default(),
    }
}

/// The patch of each triangle. Labels were numbered anew since it was cut; one that is nowhere the label of most of a
/// face has no number, and its pieces go to their face's.
fn patches(rows: &LabelledRows, refined: &RefinedRows) -> Vec<u32> {
    let mut number = vec![NONE; rows.labels.len()];
    for (&before, now) in refined.face_labels.iter().zip(rows.labels) {
        number[before.0 as usize] = now.0;
    }
    let of = |&(_, face, label): &([u32; 3], u32, seamline_ecs::components::FaceLabel)| match number
        [label.0 as usize]
    {
        NONE => rows.labels[face as usize].0,
        patch => patch,
    };
    refined.triangles.iter().map(of).collect()
}
