//! Edges and neighbours of a triangle mesh.

use rayon::prelude::*;

/// Stands where an edge has no second face.
pub const NO_FACE: u32 = u32::MAX;

/// Rows of numbers of different lengths, one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Csr {
    starts: Vec<u32>,
    values: Vec<u32>,
}

impl Csr {
    /// Row `r` lists, in rising order, the items `i` for which `rows_of(i)` names `r`.
    pub fn inverse_of<const N: usize>(row_count: usize, rows_of: &[[u32; N]]) -> Self {
        let mut starts = vec![0u32; row_count + 1];
        for &row in rows_of.as_flattened() {
            starts[row as usize + 1] += 1;
        }
        for row in 0..row_count {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut values = vec![0u32; rows_of.len() * N];
        for (item, rows) in rows_of.iter().enumerate() {
            for &row in rows {
                values[next[row as usize] as usize] = item as u32;
                next[row as usize] += 1;
            }
        }
        Self { starts, values }
    }

    /// One row.
    #[inline]
    pub fn row(&self, row: usize) -> &[u32] {
        &self.values[self.starts[row] as usize..self.starts[row + 1] as usize]
    }

    /// How many rows.
    pub fn row_count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }
}

/// How many faces meet at an edge, and whether they agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeKind {
    /// Two faces that run along the edge in opposite directions.
    Regular,
    /// Two faces that run along the edge in the same direction: one of them is turned inside out.
    Flipped,
    /// One face.
    Border,
    /// Three faces or more.
    NonManifold,
}

/// Edges, and who is next to whom.
///
/// Edges are numbered by their lower, then their higher vertex, so that the numbering does not depend on
/// the order of the triangles. Splitting faces ([`Topology::split_faces`]) appends vertices, faces and
/// edges at the tail and leaves all other numbers as they are.
#[derive(Clone, Debug, Default)]
pub struct Topology {
    /// Three different vertices a face, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The two ends of each edge, lower number first.
    pub edge_vertices: Vec<[u32; 2]>,
    /// The faces at each edge, lowest numbers first: the first two of a non-manifold edge, and
    /// [`NO_FACE`] in second place at a border.
    pub edge_faces: Vec<[u32; 2]>,
    /// What kind of edge it is.
    pub edge_kind: Vec<EdgeKind>,
    /// The edges of each face: the `i`-th runs from corner `i` to corner `i + 1`.
    pub face_edges: Vec<[u32; 3]>,
    /// Edges round each vertex.
    pub vertex_edges: Csr,
    /// Faces round each vertex.
    pub vertex_faces: Csr,
}

/// A half-edge in the bucket of its lower vertex.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct HalfEdge {
    high: u32,
    /// `3 * face + corner`.
    slot: u32,
}

impl Topology {
    /// Finds the edges of `triangles`, each of three different vertices below `vertex_count`.
    ///
    /// Cost: linear, with a small sort round each vertex.
    pub fn build(vertex_count: usize, triangles: Vec<[u32; 3]>) -> Self {
        let (starts, half_edges) = half_edges_by_lower_vertex(vertex_count, &triangles);

        let mut topology = Self {
            face_edges: vec![[0; 3]; triangles.len()],
            ..Self::default()
        };
        for low in 0..vertex_count {
            let bucket = &half_edges[starts[low] as usize..starts[low + 1] as usize];
            for same_edge in bucket.chunk_by(|a, b| a.high == b.high) {
                let edge = topology.edge_vertices.len() as u32;
                let face = |half: &HalfEdge| half.slot / 3;
                let runs_upward = |half: &HalfEdge| {
                    triangles[face(half) as usize][(half.slot % 3) as usize] == low as u32
                };
                let kind = match same_edge {
                    [_] => EdgeKind::Border,
                    [a, b] if runs_upward(a) != runs_upward(b) => EdgeKind::Regular,
                    [_, _] => EdgeKind::Flipped,
                    _ => EdgeKind::NonManifold,
                };
                topology.edge_vertices.push([low as u32, same_edge[0].high]);
                topology
                    .edge_faces
                    .push([face(&same_edge[0]), same_edge.get(1).map_or(NO_FACE, face)]);
                topology.edge_kind.push(kind);
                for half in same_edge {
                    topology.face_edges[face(half) as usize][(half.slot % 3) as usize] = edge;
                }
            }
        }
        topology.triangles = triangles;
        topology.index_vertices(vertex_count);
        topology
    }

    /// How many vertices, faces and edges.
    pub fn counts(&self) -> [usize; 3] {
        [
            self.vertex_edges.row_count(),
            self.triangles.len(),
            self.edge_vertices.len(),
        ]
    }

    /// The face across an edge of `face`, if the edge has just two faces.
    #[inline]
    pub fn neighbour(&self, face: u32, edge: u32) -> Option<u32> {
        if matches!(
            self.edge_kind[edge as usize],
            EdgeKind::Border | EdgeKind::NonManifold
        ) {
            return None;
        }
        let [a, b] = self.edge_faces[edge as usize];
        Some(if a == face { b } else { a })
    }

    /// The two faces of an edge that has just two.
    #[inline]
    pub fn face_pair(&self, edge: usize) -> Option<[u32; 2]> {
        match self.edge_kind[edge] {
            EdgeKind::Regular | EdgeKind::Flipped => Some(self.edge_faces[edge]),
            EdgeKind::Border | EdgeKind::NonManifold => None,
        }
    }

    /// The corner of `face` that is not on its edge `edge`.
    #[inline]
    pub fn opposite_vertex(&self, face: u32, edge: u32) -> u32 {
        let corner = self.face_edges[face as usize]
            .iter()
            .position(|&e| e == edge)
            .unwrap_or(0);
        self.triangles[face as usize][(corner + 2) % 3]
    }

    /// The end of `edge` that is not `vertex`.
    #[inline]
    pub fn far_end(&self, edge: u32, vertex: u32) -> u32 {
        let [a, b] = self.edge_vertices[edge as usize];
        if a == vertex { b } else { a }
    }

    /// Splits each of `faces` in three about a new vertex. The new vertex of `faces[i]` has the number
    /// `vertices + i`; the face keeps its number and its first edge, the two other children and the three
    /// spokes come at the tail.
    pub fn split_faces(&mut self, faces: &[u32]) {
        let vertex_count = self.vertex_edges.row_count();
        for (i, &face) in faces.iter().enumerate() {
            let [a, b, c] = self.triangles[face as usize];
            let [_, bc, ca] = self.face_edges[face as usize];
            let centre = (vertex_count + i) as u32;
            let second = self.triangles.len() as u32;
            let third = second + 1;
            let spoke = self.edge_vertices.len() as u32;

            self.triangles[face as usize] = [a, b, centre];
            self.triangles.extend([[b, c, centre], [c, a, centre]]);
            self.edge_vertices
                .extend([[a, centre], [b, centre], [c, centre]]);
            self.edge_faces
                .extend([[face, third], [face, second], [second, third]]);
            self.edge_kind.extend([EdgeKind::Regular; 3]);
            self.face_edges[face as usize] = [self.face_edges[face as usize][0], spoke + 1, spoke];
            self.face_edges
                .extend([[bc, spoke + 2, spoke + 1], [ca, spoke, spoke + 2]]);
            for (edge, child) in [(bc, second), (ca, third)] {
                for at in &mut self.edge_faces[edge as usize] {
                    if *at == face {
                        *at = child;
                    }
                }
            }
        }
        self.index_vertices(vertex_count + faces.len());
    }

    fn index_vertices(&mut self, vertex_count: usize) {
        let (edges, faces) = rayon::join(
            || Csr::inverse_of(vertex_count, &self.edge_vertices),
            || Csr::inverse_of(vertex_count, &self.triangles),
        );
        self.vertex_edges = edges;
        self.vertex_faces = faces;
    }
}

/// Half-edges in buckets by lower vertex, each bucket sorted by higher vertex, then by face.
fn half_edges_by_lower_vertex(
    vertex_count: usize,
    triangles: &[[u32; 3]],
) -> (Vec<u32>, Vec<HalfEdge>) {
    let ends = |t: &[u32; 3], corner: usize| {
        let (a, b) = (t[corner], t[(corner + 1) % 3]);
        (a.min(b), a.max(b))
    };
    let mut starts = vec![0u32; vertex_count + 1];
    for triangle in triangles {
        for corner in 0..3 {
            starts[ends(triangle, corner).0 as usize + 1] += 1;
        }
    }
    for v in 0..vertex_count {
        starts[v + 1] += starts[v];
    }
    let mut next = starts.clone();
    let mut half_edges = vec![HalfEdge::default(); triangles.len() * 3];
    for (face, triangle) in triangles.iter().enumerate() {
        for corner in 0..3 {
            let (low, high) = ends(triangle, corner);
            half_edges[next[low as usize] as usize] = HalfEdge {
                high,
                slot: (face * 3 + corner) as u32,
            };
            next[low as usize] += 1;
        }
    }

    let mut buckets = Vec::with_capacity(vertex_count);
    let mut rest = half_edges.as_mut_slice();
    for v in 0..vertex_count {
        let (bucket, after) = rest.split_at_mut((starts[v + 1] - starts[v]) as usize);
        buckets.push(bucket);
        rest = after;
    }
    buckets
        .par_iter_mut()
        .with_min_len(4096)
        .for_each(|bucket| bucket.sort_unstable());
    (starts, half_edges)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Topology {
        Topology::build(4, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    }

    #[test]
    fn a_tetrahedron_has_six_regular_edges() {
        let t = tetrahedron();
        assert_eq!(t.counts(), [4, 4, 6]);
        assert!(t.edge_kind.iter().all(|&k| k == EdgeKind::Regular));
        assert_eq!(
            t.edge_vertices,
            [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]
        );
    }

    #[test]
    fn a_lone_triangle_is_all_border() {
        let t = Topology::build(3, vec![[0, 1, 2]]);
        assert_eq!(t.edge_kind, [EdgeKind::Border; 3]);
        assert_eq!(t.neighbour(0, 0), None);
    }

    #[test]
    fn a_turned_neighbour_and_a_fin_are_told_apart() {
        let turned = Topology::build(4, vec![[0, 1, 2], [0, 1, 3]]);
        assert_eq!(turned.edge_kind[0], EdgeKind::Flipped);
        let fin = Topology::build(5, vec![[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert_eq!(fin.edge_kind[0], EdgeKind::NonManifold);
    }

    #[test]
    fn splitting_a_face_agrees_with_building_afresh() {
        let mut split = tetrahedron();
        split.split_faces(&[1, 3]);
        let fresh = Topology::build(6, split.triangles.clone());
        assert_eq!(split.counts(), fresh.counts());
        for face in 0..split.triangles.len() as u32 {
            for corner in 0..3 {
                let ours = split.face_edges[face as usize][corner];
                let theirs = fresh.face_edges[face as usize][corner];
                let mut ends = split.edge_vertices[ours as usize];
                ends.sort();
                assert_eq!(ends, fresh.edge_vertices[theirs as usize]);
                assert_eq!(split.neighbour(face, ours), fresh.neighbour(face, theirs));
            }
        }
    }
}
