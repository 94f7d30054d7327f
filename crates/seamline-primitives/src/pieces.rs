//! Flat pieces: the facets a tessellation is made of, each one or more triangles in one plane, and how they
//! meet.

use std::f64::consts::PI;

use glam::DVec3;
use seamline_mesh::Topology;

use crate::certain::is_certain_plane;
use crate::flat::grow_flat;
use crate::ground::Ground;
use crate::links::{Link, Meeting};
use crate::rows::Rows;
use crate::tried::mixed;

/// No piece, or no region.
pub(crate) const NONE: u32 = u32::MAX;

/// The flat pieces of a mesh.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pieces {
    /// The piece of each face.
    pub of_face: Vec<u32>,
    /// Unit normals.
    pub normals: Vec<DVec3>,
    /// Centroids of the areas.
    pub centroids: Vec<DVec3>,
    /// Areas.
    pub areas: Vec<f64>,
    /// Tells each piece from others, also of other cuts: made of its faces.
    pub keys: Vec<u64>,
    /// Faces of each piece.
    pub faces: Rows,
    /// Distinct vertices of each piece.
    pub vertices: Rows,
    /// Pieces round each vertex.
    pub of_vertex: Rows,
    /// Pairs that touch.
    pub links: Vec<Link>,
    /// The links of each piece.
    pub around: Rows,
    /// The edges of each link.
    pub link_edges: Rows,
    /// Pieces that are planes whatever lies beside them.
    pub certain: Vec<bool>,
    /// How far noise may turn the normal, radians.
    pub leans: Vec<f64>,
}

impl Pieces {
    /// Finds the pieces, flat up to `tolerance`, of what is not `settled` (see [`grow_flat`]). Those of `fewest` vertices
    /// or more may be planes whatever lies beside them.
    pub fn find(ground: Ground, tolerance: f64, settled: &[u32], fewest: usize) -> Self {
        let Ground {
            positions,
            triangles,
            topology,
            ..
        } = ground;
        let of_face = grow_flat(ground, tolerance, settled);
        let count = of_face.iter().max().map_or(0, |&last| last as usize + 1);
        let mut normals = vec![DVec3::ZERO; count];
        let mut centroids = vec![DVec3::ZERO; count];
        let mut areas = vec![0.0; count];
        let mut leans = vec![PI; count];
        let mut keys = vec![0; count];
        let mut faces = Vec::with_capacity(of_face.len());
        for (face, &piece) in of_face.iter().enumerate() {
            let area = triangles.areas[face];
            normals[piece as usize] += triangles.normals[face] * area;
            centroids[piece as usize] += triangles.centroids[face] * area;
            areas[piece as usize] += area;
            let lean = &mut leans[piece as usize];
            *lean = lean.min(ground.lean(face as u32));
            keys[piece as usize] = mixed(keys[piece as usize], face as u64 + 1);
            faces.push((piece, face as u32));
        }
        for piece in 0..count {
            normals[piece] = normals[piece].normalize_or_zero();
            if areas[piece] > 0.0 {
                centroids[piece] /= areas[piece];
            }
        }
        let faces = Rows::of_pairs(count, &faces);
        let meeting = Meeting {
            ground,
            of_face: &of_face,
            faces: &faces,
            normals: &normals,
            leans: &leans,
        };
        let vertices = || {
            let vertices = vertices_of_pieces(&faces, count, topology);
            // Pieces settled as planes before have their numbers at the head.
            let is_certain = |piece| {
                let own = vertices.row(piece);
                own.len() >= fewest && is_certain_plane(positions, own, tolerance)
            };
            let certain = (0..count as u32).map(is_certain).collect();
            (vertices.turned(positions.len()), vertices, certain)
        };
        let ((of_vertex, vertices, certain), links) = rayon::join(vertices, || meeting.links());
        for piece in 0..count {
            if areas[piece] == 0.0 {
                centroids[piece] = triangles.centroids[faces.row(piece as u32)[0] as usize];
            }
        }
        Self {
            normals,
            centroids,
            areas,
            faces,
            of_vertex,
            vertices,
            of_face,
            leans,
            keys,
            links: links.all,
            around: links.around,
            link_edges: links.edges,
            certain,
        }
    }

    pub fn count(&self) -> usize {
        self.areas.len()
    }

    /// The links of a piece that are no walls.
    pub fn smooth_links(&self, piece: u32) -> impl Iterator<Item = &Link> {
        let links = self.around.row(piece).iter();
        links
            .map(|&link| &self.links[link as usize])
            .filter(|link| !link.wall)
    }
}

/// Distinct vertices of pieces, in order.
fn vertices_of_pieces(faces: &Rows, count: usize, topology: &Topology) -> Rows {
    let mut vertices = Rows::default();
    let mut own = Vec::new();
    for piece in 0..count as u32 {
        own.clear();
        let faces = faces.row(piece);
        own.extend(
            faces
                .iter()
                .flat_map(|&face| topology.triangles[face as usize]),
        );
        own.sort_unstable();
        if faces.len() > 1 {
            own.dedup();
        }
        vertices.push(own.iter().copied());
    }
    vertices
}
