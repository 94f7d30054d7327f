//! Flat pieces: the facets a tessellation is made of, each one or more triangles in one plane, and how they
//! meet.

use std::f64::consts::PI;

use glam::DVec3;
use seamline_mesh::Topology;

use crate::certain::is_certain_plane;
use crate::ground::Ground;
use crate::rows::Rows;

/// No piece, or no region.
pub(crate) const NONE: u32 = u32::MAX;

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
    /// Pieces with an edge where the mesh ends or branches.
    pub open: Vec<bool>,
}

/// What a triangle is in space.
pub(crate) struct Triangles {
    pub normals: Vec<DVec3>,
    pub centroids: Vec<DVec3>,
    pub areas: Vec<f64>,
    /// Area doubled over the longest edge.
    pub heights: Vec<f64>,
}

impl Triangles {
    pub fn of(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let count = triangles.len();
        let mut all = Self {
            normals: Vec::with_capacity(count),
            centroids: Vec::with_capacity(count),
            areas: Vec::with_capacity(count),
            heights: Vec::with_capacity(count),
        };
        for corners in triangles {
            let [a, b, c] = corners.map(|v| positions[v as usize]);
            let cross = (b - a).cross(c - a);
            let doubled = cross.length();
            let longest = [b - a, c - b, a - c]
                .map(DVec3::length_squared)
                .into_iter()
                .fold(0.0, f64::max)
                .sqrt();
            all.normals.push(cross.normalize_or_zero());
            all.centroids.push((a + b + c) / 3.0);
            all.areas.push(doubled / 2.0);
            let height = if longest > 0.0 {
                doubled / longest
            } else {
                0.0
            };
            all.heights.push(height);
        }
        all
    }
}

impl Pieces {
    /// Finds the pieces: from the largest triangle down, each takes in the triangles connected to it whose
    /// corners lie within `tolerance` of its plane and whose normals agree, as far as a sliver's can. Faces with
    /// a number in `settled` are together with those of the same number, and with no others.
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
        let mut faces = Vec::with_capacity(of_face.len());
        let mut vertices = Vec::with_capacity(of_face.len() * 3);
        for (face, &piece) in of_face.iter().enumerate() {
            let area = triangles.areas[face];
            normals[piece as usize] += triangles.normals[face] * area;
            centroids[piece as usize] += triangles.centroids[face] * area;
            areas[piece as usize] += area;
            let lean = &mut leans[piece as usize];
            *lean = lean.min(ground.lean(face as u32));
            faces.push((piece, face as u32));
            vertices.extend(topology.triangles[face].map(|v| (piece, v)));
        }
        vertices.sort_unstable();
        vertices.dedup();
        for piece in 0..count {
            normals[piece] = normals[piece].normalize_or_zero();
            if areas[piece] > 0.0 {
                centroids[piece] /= areas[piece];
            }
        }
        let faces = Rows::of_pairs(count, &faces);
        for piece in 0..count {
            if areas[piece] == 0.0 {
                centroids[piece] = triangles.centroids[faces.row(piece as u32)[0] as usize];
            }
        }
        let turned: Vec<_> = vertices.iter().map(|&(p, v)| (v, p)).collect();
        let mut pieces = Self {
            normals,
            centroids,
            areas,
            faces,
            of_vertex: Rows::of_pairs(positions.len(), &turned),
            vertices: Rows::of_pairs(count, &vertices),
            of_face,
            open: vec![false; count],
            leans,
            ..Self::default()
        };
        pieces.link(positions, topology);
        // Pieces settled as planes before have their numbers at the head.
        pieces.certain = (0..count as u32)
            .map(|piece| {
                let vertices = pieces.vertices.row(piece);
                vertices.len() >= fewest && is_certain_plane(positions, vertices, tolerance)
            })
            .collect();
        pieces
    }

    pub fn count(&self) -> usize {
        self.areas.len()
    }

    fn link(&mut self, positions: &[DVec3], topology: &Topology) {
        let mut pairs: Vec<([u32; 2], u32)> = Vec::new();
        for (edge, faces) in topology.edge_faces.iter().enumerate() {
            let Some([a, b]) = topology.face_pair(edge) else {
                for &face in faces.iter().filter(|&&f| f != seamline_mesh::NO_FACE) {
                    self.open[self.of_face[face as usize] as usize] = true;
                }
                continue;
            };
            let [a, b] = [a, b].map(|face| self.of_face[face as usize]);
            if a != b {
                pairs.push(([a.min(b), a.max(b)], edge as u32));
            }
        }
        pairs.sort_unstable();
        let mut around = Vec::new();
        let mut edges = Vec::new();
        for common in pairs.chunk_by(|x, y| x.0 == y.0) {
            let pieces = common[0].0;
            let link = self.links.len() as u32;
            let length = common
                .iter()
                .map(|&(_, edge)| {
                    let [a, b] =
                        topology.edge_vertices[edge as usize].map(|v| positions[v as usize]);
                    a.distance(b)
                })
                .sum();
            let [a, b] = pieces.map(|p| self.normals[p as usize]);
            let [lean_a, lean_b] = pieces.map(|p| self.leans[p as usize]);
            self.links.push(Link {
                pieces,
                length,
                wall: a.angle_between(b) > WALL + lean_a + lean_b,
            });
            around.extend(pieces.map(|p| (p, link)));
            edges.extend(common.iter().map(|&(_, edge)| (link, edge)));
        }
        self.around = Rows::of_pairs(self.count(), &around);
        self.link_edges = Rows::of_pairs(self.links.len(), &edges);
    }

    /// The links of a piece that are no walls.
    pub fn smooth_links(&self, piece: u32) -> impl Iterator<Item = &Link> {
        let links = self.around.row(piece).iter();
        links
            .map(|&link| &self.links[link as usize])
            .filter(|link| !link.wall)
    }
}

fn grow_flat(ground: Ground, tolerance: f64, settled: &[u32]) -> Vec<u32> {
    let triangles = ground.triangles;
    let mut numbers: Vec<u32> = settled.iter().copied().filter(|&n| n != NONE).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let mut of_face: Vec<u32> = settled
        .iter()
        .map(|n| numbers.binary_search(n).map_or(NONE, |row| row as u32))
        .collect();
    let mut order: Vec<u32> = (0..of_face.len() as u32)
        .filter(|&f| of_face[f as usize] == NONE)
        .collect();
    let by_area = |&f: &u32| triangles.areas[f as usize];
    order.sort_by(|a, b| by_area(b).total_cmp(&by_area(a)));
    let mut count = numbers.len() as u32;
    for seed in order {
        if of_face[seed as usize] != NONE {
            continue;
        }
        let mut plane = (
            triangles.normals[seed as usize],
            triangles.centroids[seed as usize],
        );
        let mut members = vec![seed];
        of_face[seed as usize] = count;
        loop {
            let fitted = members.len();
            spread_flat(ground, tolerance, plane, count, &mut members, &mut of_face);
            // A plane known from few triangles errs far away from them.
            if members.len() < 2 * fitted {
                break;
            }
            plane = mean_plane(triangles, &members);
        }
        count += 1;
    }
    of_face
}

/// Lets a flat piece take in the triangles in its plane, given by normal and point.
fn spread_flat(
    ground: Ground,
    tolerance: f64,
    (normal, point): (DVec3, DVec3),
    piece: u32,
    members: &mut Vec<u32>,
    of_face: &mut [u32],
) {
    let Ground {
        positions,
        triangles,
        topology,
        ..
    } = ground;
    let in_plane = |face: u32| {
        let lean = ground.lean(face);
        let face = face as usize;
        let away = (triangles.normals[face] - normal).length();
        let sure = triangles.heights[face].max(f64::MIN_POSITIVE);
        let agrees = away <= 0.004 + 4.0 * tolerance / sure
            && (triangles.normals[face].dot(normal) >= (PI / 3.0 + lean).min(PI).cos()
                || triangles.areas[face] == 0.0);
        agrees
            && topology.triangles[face]
                .iter()
                .all(|&v| (positions[v as usize] - point).dot(normal).abs() <= tolerance)
    };
    let mut at = 0;
    while at < members.len() {
        let face = members[at];
        at += 1;
        for edge in topology.face_edges[face as usize] {
            if let Some(across) = topology.neighbour(face, edge)
                && of_face[across as usize] == NONE
                && in_plane(across)
            {
                of_face[across as usize] = piece;
                members.push(across);
            }
        }
    }
}

fn mean_plane(triangles: &Triangles, faces: &[u32]) -> (DVec3, DVec3) {
    let [mut normal, mut point] = [DVec3::ZERO; 2];
    let mut area = 0.0;
    for &face in faces {
        let own = triangles.areas[face as usize];
        normal += triangles.normals[face as usize] * own;
        point += triangles.centroids[face as usize] * own;
        area += own;
    }
    (normal.normalize_or_zero(), point / area)
}
