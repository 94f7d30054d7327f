//! How flat pieces meet.

use std::f64::consts::PI;

use glam::DVec3;

use crate::ground::Ground;
use crate::rows::Rows;

/// Dihedral angle above which no surface continues. Inside true patches next to nothing is above 40 degrees
/// in any export measured; the least common crease of parts, 45 degrees, is.
const WALL: f64 = 40.0 / 180.0 * PI;

/// Two pieces that share edges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// The two, lower number first.
    pub pieces: [u32; 2],
    /// Length of the common edges.
    pub length: f64,
    /// Is the angle between the two too large for any surface to continue?
    pub wall: bool,
}

impl Link {
    pub fn across(&self, piece: u32) -> u32 {
        self.pieces[usize::from(self.pieces[0] == piece)]
    }
}

/// What links are made of.
pub(crate) struct Meeting<'a> {
    pub ground: Ground<'a>,
    /// The piece of each face, and the faces of each piece.
    pub of_face: &'a [u32],
    pub faces: &'a Rows,
    /// Unit normals of pieces, and how far noise may turn them, radians.
    pub normals: &'a [DVec3],
    pub leans: &'a [f64],
}

/// How the pieces of a mesh meet.
#[derive(Default)]
pub(crate) struct Links {
    /// Pairs that touch, in order.
    pub all: Vec<Link>,
    /// The links of each piece.
    pub around: Rows,
    /// The edges of each link.
    pub edges: Rows,
}

impl Meeting<'_> {
    pub fn links(&self) -> Links {
        let topology = self.ground.topology;
        let count = self.normals.len();
        let mut links = Links::default();
        let mut around = Vec::new();
        // The edges of a piece beside pieces of higher numbers.
        let mut beside: Vec<(u32, u32)> = Vec::new();
        for piece in 0..count as u32 {
            beside.clear();
            for &face in self.faces.row(piece) {
                for edge in topology.face_edges[face as usize] {
                    let across = topology.neighbour(face, edge);
                    let other = across.map(|face| self.of_face[face as usize]);
                    beside.extend(other.filter(|&p| p > piece).map(|p| (p, edge)));
                }
            }
            beside.sort_unstable();
            for common in beside.chunk_by(|x, y| x.0 == y.0) {
                let pieces = [piece, common[0].0];
                let edges = common.iter().map(|&(_, edge)| edge);
                around.extend(pieces.map(|p| (p, links.all.len() as u32)));
                links.all.push(Link {
                    pieces,
                    length: edges.clone().map(|e| self.ground.edge_length(e)).sum(),
                    wall: self.is_wall(pieces),
                });
                links.edges.push(edges);
            }
        }
        links.around = Rows::of_pairs(count, &around);
        links
    }

    /// Is the angle between two pieces too large for any surface to continue?
    fn is_wall(&self, pieces: [u32; 2]) -> bool {
        let [a, b] = pieces.map(|p| self.normals[p as usize]);
        let [lean_a, lean_b] = pieces.map(|p| self.leans[p as usize]);
        // A face without area has no normal.
        let both = a != DVec3::ZERO && b != DVec3::ZERO;
        both && a.dot(b) < (WALL + lean_a + lean_b).min(PI).cos()
    }
}
