//! The welded, triangulated mesh every later step works on.

use glam::DVec3;

use crate::PolygonMesh;

/// Distinct positions, triangles between them, and the way back to the faces of the file.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// The faces as the file has them, on welded vertices. `polygons.positions` are the vertices of
    /// `triangles` too: distinct, in order of first appearance in the file.
    pub polygons: PolygonMesh,
    /// Three different vertices each. A face that repeats a vertex may have none.
    pub triangles: Vec<[u32; 3]>,
    /// The input face of each triangle; not decreasing.
    pub face_of_triangle: Vec<u32>,
    /// The welded vertex of each vertex of the file (for STL: of each corner).
    pub vertex_of_input: Vec<u32>,
}

impl Mesh {
    /// One a vertex, distinct.
    pub fn positions(&self) -> &[DVec3] {
        &self.polygons.positions
    }

    /// Least and greatest coordinates of the vertices that triangles use. Both zero without triangles.
    pub fn bounding_box(&self) -> [DVec3; 2] {
        let mut used = self
            .triangles
            .as_flattened()
            .iter()
            .map(|&v| self.positions()[v as usize]);
        let Some(first) = used.next() else {
            return [DVec3::ZERO; 2];
        };
        used.fold([first; 2], |[low, high], p| [low.min(p), high.max(p)])
    }
}
