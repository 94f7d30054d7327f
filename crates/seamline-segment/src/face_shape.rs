//! Prepare: normals and areas of faces.

use bevy_ecs::prelude::*;
use glam::DVec3;
use rayon::prelude::*;
use seamline_ecs::components::{FaceShape, Position};
use seamline_ecs::{Column, ColumnMut, MeshTopology, Stage, StageSystems};
use seamline_mesh::{NO_FACE, Topology};

/// Faces whose area is at most this (in the scaled mesh, whose size is about 1) have no normal of their
/// own.
pub(crate) const ZERO_AREA: f64 = 1e-14;

/// A needle may lie behind another needle; so many in a row are looked through.
const REPAIR_ROUNDS: usize = 8;

pub(crate) fn systems() -> StageSystems {
    shape_faces.in_set(Stage::Prepare)
}

fn shape_faces(
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    mut shapes: ColumnMut<FaceShape>,
) {
    face_shapes(&topology.0, &positions, &mut shapes);
}

/// Unit normal and area of every face.
///
/// A face of no area takes the normal of the neighbour across its longest edge, if that has one: a needle
/// must not make a crease of 90 degrees. A face whose neighbours have none either keeps a zero normal.
pub fn face_shapes(topology: &Topology, positions: &[Position], shapes: &mut [FaceShape]) {
    shapes
        .par_iter_mut()
        .zip(&topology.triangles)
        .with_min_len(4096)
        .for_each(|(shape, corners)| {
            let [a, b, c] = corners.map(|v| positions[v as usize].0);
            let doubled = (b - a).cross(c - a);
            let area = doubled.length() / 2.0;
            let normal = if area > ZERO_AREA {
                doubled / (2.0 * area)
            } else {
                DVec3::ZERO
            };
            *shape = FaceShape { normal, area };
        });
    let mut bare: Vec<u32> = (0..shapes.len() as u32)
        .filter(|&face| shapes[face as usize].normal == DVec3::ZERO)
        .collect();
    for _ in 0..REPAIR_ROUNDS {
        let found: Vec<(u32, DVec3)> = bare
            .iter()
            .filter_map(|&face| {
                let across = across_longest_edge(topology, positions, face)?;
                let normal = shapes[across as usize].normal;
                (normal != DVec3::ZERO).then_some((face, normal))
            })
            .collect();
        if found.is_empty() {
            break;
        }
        for (face, normal) in found {
            shapes[face as usize].normal = normal;
        }
        bare.retain(|&face| shapes[face as usize].normal == DVec3::ZERO);
    }
}

fn across_longest_edge(topology: &Topology, positions: &[Position], face: u32) -> Option<u32> {
    let length = |edge: u32| {
        let [a, b] = topology.edge_vertices[edge as usize];
        positions[a as usize]
            .0
            .distance_squared(positions[b as usize].0)
    };
    let edges = topology.face_edges[face as usize];
    let longest = edges
        .into_iter()
        .max_by(|&a, &b| length(a).total_cmp(&length(b)))?;
    topology
        .neighbour(face, longest)
        .filter(|&across| across != NO_FACE)
}
