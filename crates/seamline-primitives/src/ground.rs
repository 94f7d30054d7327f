//! What a search stands on.

use std::f64::consts::PI;

use glam::DVec3;
use seamline_mesh::Topology;

use crate::hypothesis::View;
use crate::pieces::Pieces;
use crate::triangles::Triangles;

/// Standard deviations of a vertex for which the normal of a triangle is turned with it.
const LEANS: f64 = 3.0;

/// A mesh of diagonal one, and how exactly its vertices lie where they were designed.
#[derive(Clone, Copy)]
pub(crate) struct Ground<'a> {
    /// Root mean square distance up to which vertices lie on a surface exactly.
    pub precision: f64,
    /// Standard deviation of each coordinate of the vertices; 0 where they are as exact as they are stored.
    pub noise: f64,
    pub positions: &'a [DVec3],
    pub triangles: &'a Triangles,
    pub topology: &'a Topology,
}

impl<'a> Ground<'a> {
    /// The same, cut into pieces.
    pub fn seen(self, pieces: &'a Pieces) -> View<'a> {
        View {
            ground: self,
            pieces,
        }
    }

    /// How far noise may turn the normal of a face, radians; 0 where there is none, any way about for a face
    /// without height where there is.
    pub fn lean(self, face: u32) -> f64 {
        let height = self.triangles.heights[face as usize].max(f64::MIN_POSITIVE);
        (LEANS * self.noise / height).min(PI)
    }

    /// Where the two ends of an edge are.
    pub fn ends(self, edge: u32) -> [DVec3; 2] {
        self.topology.edge_vertices[edge as usize].map(|v| self.positions[v as usize])
    }

    pub fn edge_length(self, edge: u32) -> f64 {
        let [p, q] = self.ends(edge);
        p.distance(q)
    }
}
