//! How much the surface itself turns at an edge, as against the steps of its tessellation.

use std::f64::consts::PI;

use glam::DVec3;

use crate::ground::Ground;
use crate::heights::{self, quadric};

/// How far a side reaches from its edge, in steps over edges.
const STEPS: usize = 3;
/// Most vertices of a side.
const MOST_VERTICES: usize = 24;
/// Fewest vertices a quadratic height field is fitted to; below, the triangle's own slope serves.
const FEWEST_VERTICES: usize = 7;
/// Least cosine (53 degrees) between the normals of a side.
const SIDE_COS: f64 = 0.6;
/// How far behind the edge a vertex of a side may lie, in heights of the triangle at the edge.
const BEHIND: f64 = 0.15;
/// A crease is at most so many times as sharp as the dihedral angle.
const MOST_DIHEDRALS: f64 = 1.5;

/// Dihedral angle, in degrees, up to which an edge is inside a plane.
const FLAT_DEG: f64 = 1e-3;

/// Finds the turn of the surface at edges: on either side a quadratic height field is fitted to the vertices
/// near the edge, and the turn is the angle between the two fields' slopes there. Inside a smooth surface
/// it is near zero however coarse the steps; at a crease it is the crease.
pub(crate) struct CreaseAngles<'a> {
    pub ground: Ground<'a>,
    /// The part of each face: a side does not leave it.
    pub of_face: &'a [u32],
}

impl CreaseAngles<'_> {
    /// Turn at an edge between two faces of one part, in degrees, not negative.
    pub fn at(&self, edge: u32, faces: [u32; 2]) -> f64 {
        let normals = faces.map(|f| self.ground.triangles.normals[f as usize]);
        let dihedral = normals[0].angle_between(normals[1]) * 180.0 / PI;
        if dihedral.is_nan() || dihedral <= FLAT_DEG {
            return 0.0;
        }
        let [a, b] = self.ground.ends(edge);
        let z = (normals[0] + normals[1]).normalize_or_zero();
        let x = (b - a).normalize_or_zero();
        let frame = Frame {
            origin: (a + b) / 2.0,
            x,
            y: z.cross(x),
            z,
        };
        let [Some(left), Some(right)] = faces.map(|face| self.slope(face, &frame)) else {
            return dihedral;
        };
        let turn = (left.atan() - right.atan()).abs() * 180.0 / PI;
        turn.min(MOST_DIHEDRALS * dihedral)
    }

    /// Slope across the edge of the height field on the side of `face`.
    fn slope(&self, face: u32, frame: &Frame) -> Option<f64> {
        let centroid = frame.local(self.ground.triangles.centroids[face as usize]);
        let side = centroid.y.signum();
        let height = 3.0 * centroid.y.abs();
        let vertices = self.side(face, |x| frame.local(x).y * side >= -BEHIND * height);
        if vertices.len() < FEWEST_VERTICES {
            let n = self.ground.triangles.normals[face as usize];
            let up = n.dot(frame.z);
            return (up > 1e-6).then(|| -n.dot(frame.y) / up);
        }
        let local: Vec<DVec3> = vertices
            .iter()
            .map(|&v| frame.local(self.ground.positions[v as usize]))
            .collect();
        let radius = local
            .iter()
            .map(|x| x.truncate().length())
            .fold(0.0, f64::max);
        let near = |x: DVec3| 1.0 / (0.05 + x.truncate().length_squared());
        let within = local.iter().map(|&x| x / radius);
        heights::fit(quadric, within, near).map(|q| q[2])
    }

    /// Vertices of the faces of a side, nearest first by steps.
    fn side(&self, face: u32, in_front: impl Fn(DVec3) -> bool) -> Vec<u32> {
        let part = self.of_face[face as usize];
        let normal = self.ground.triangles.normals[face as usize];
        let mut faces = vec![face];
        let mut vertices = self.ground.topology.triangles[face as usize].to_vec();
        let mut from = 0;
        for _ in 0..STEPS {
            let to = faces.len();
            for i in from..to {
                for edge in self.ground.topology.face_edges[faces[i] as usize] {
                    let Some(across) = self.ground.topology.neighbour(faces[i], edge) else {
                        continue;
                    };
                    let corners = self.ground.topology.triangles[across as usize];
                    let belongs = self.of_face[across as usize] == part
                        && self.ground.triangles.normals[across as usize].dot(normal) >= SIDE_COS
                        && !faces.contains(&across)
                        && corners
                            .iter()
                            .all(|&v| in_front(self.ground.positions[v as usize]));
                    if !belongs {
                        continue;
                    }
                    faces.push(across);
                    for corner in corners {
                        if !vertices.contains(&corner) {
                            vertices.push(corner);
                        }
                    }
                    if vertices.len() >= MOST_VERTICES {
                        return vertices;
                    }
                }
            }
            from = to;
        }
        vertices
    }
}

struct Frame {
    origin: DVec3,
    x: DVec3,
    y: DVec3,
    z: DVec3,
}

impl Frame {
    fn local(&self, x: DVec3) -> DVec3 {
        let x = x - self.origin;
        DVec3::new(x.dot(self.x), x.dot(self.y), x.dot(self.z))
    }
}
