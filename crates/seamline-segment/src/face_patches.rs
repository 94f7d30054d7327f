//! The patch of each input face, out of the labels of triangles.

use seamline_ecs::components::{FaceLabel, FaceShape, NONE};
use seamline_mesh::{Csr, Mesh};

use crate::spatial_order::SpatialOrder;

/// The patch of each input face, and how many patches there are.
#[derive(Clone, Debug)]
pub struct FacePatches {
    /// One an input face, numbered from 0 by first face.
    pub of_face: Vec<u32>,
    /// How many.
    pub count: usize,
}

/// Every input face one patch, patches numbered by first face. `shapes` and `labels` are in rows; the labels
/// of triangles follow their face.
pub fn number_patches(
    mesh: &Mesh,
    order: &SpatialOrder,
    shapes: &[FaceShape],
    labels: &mut [FaceLabel],
) -> FacePatches {
    let mut numbers = vec![NONE; labels.len()];
    let mut count = 0;
    let of_face: Vec<u32> = label_faces(mesh, order, shapes, labels)
        .into_iter()
        .map(|label| {
            let number = &mut numbers[label as usize];
            if *number == NONE {
                *number = count;
                count += 1;
            }
            *number
        })
        .collect();
    for (&row, &face) in order.row_of_triangle.iter().zip(&mesh.face_of_triangle) {
        labels[row as usize].0 = of_face[face as usize];
    }
    FacePatches {
        of_face,
        count: count as usize,
    }
}

/// The label of each input face: that of most of its area. A face without a triangle takes that of a
/// triangle it shares an edge with, else a vertex, else that of the face before it.
fn label_faces(
    mesh: &Mesh,
    order: &SpatialOrder,
    shapes: &[FaceShape],
    labels: &[FaceLabel],
) -> Vec<u32> {
    let mut of_face = vec![NONE; mesh.polygons.face_count()];
    let mut rows = order.row_of_triangle.iter().map(|&row| row as usize);
    for same_face in mesh.face_of_triangle.chunk_by(|a, b| a == b) {
        let mut areas: Vec<(u32, f64)> = Vec::with_capacity(1);
        for row in rows.by_ref().take(same_face.len()) {
            match areas.iter_mut().find(|(label, _)| *label == labels[row].0) {
                Some((_, area)) => *area += shapes[row].area,
                None => areas.push((labels[row].0, shapes[row].area)),
            }
        }
        let most = areas
            .iter()
            .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        of_face[same_face[0] as usize] = most.map_or(NONE, |(label, _)| *label);
    }
    label_empty_faces(mesh, order, labels, &mut of_face);
    of_face
}

fn label_empty_faces(mesh: &Mesh, order: &SpatialOrder, labels: &[FaceLabel], of_face: &mut [u32]) {
    if !of_face.contains(&NONE) {
        return;
    }
    let around = Csr::inverse_of(mesh.positions().len(), &mesh.triangles);
    for face in 0..of_face.len() {
        if of_face[face] != NONE {
            continue;
        }
        let corners = mesh.polygons.face(face);
        let shared = |t: &u32| {
            mesh.triangles[*t as usize]
                .iter()
                .filter(|v| corners.contains(v))
                .count()
        };
        let touching = corners
            .iter()
            .flat_map(|&v| around.row(v as usize))
            .copied();
        let nearest = touching.max_by_key(|t| (shared(t), std::cmp::Reverse(*t)));
        of_face[face] = match nearest {
            Some(t) => labels[order.row_of_triangle[t as usize] as usize].0,
            None if face > 0 => of_face[face - 1],
            None => labels[0].0,
        };
    }
}
