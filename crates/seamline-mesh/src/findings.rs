//! What a mesh is, and what is wrong with it.

mod fans;
mod words;

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use crate::sets::Sets;
use crate::{EdgeKind, Mesh, Topology};

/// What a mesh is, and what is wrong with it. Lengths are in the file's unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// Faces in the file.
    pub input_faces: usize,
    /// Faces in the file that are no triangles.
    pub larger_polygons: usize,
    /// Vertices in the file; for STL, three a face.
    pub input_vertices: usize,
    /// Vertices after welding.
    pub distinct_vertices: usize,
    /// Distinct vertices no triangle uses.
    pub isolated_vertices: usize,
    /// Triangles after triangulation.
    pub triangles: usize,
    /// Edges of the triangles.
    pub edges: usize,
    /// Edges with one triangle.
    pub border_edges: usize,
    /// Closed curves the border edges make.
    pub border_loops: usize,
    /// Edges with three triangles or more.
    pub non_manifold_edges: usize,
    /// Vertices whose triangles fall into several fans that share nothing but the vertex.
    pub non_manifold_vertices: usize,
    /// Edges whose two triangles are turned opposite ways.
    pub flipped_edges: usize,
    /// Faces with the same vertices as an earlier face.
    pub duplicate_faces: usize,
    /// Triangles of no area: at most 1e-14 of the square on the longest side of the bounding box.
    pub zero_area_triangles: usize,
    /// Faces that repeat a vertex so that no triangle is left of them.
    pub faces_without_triangle: usize,
    /// Parts connected through edges.
    pub parts: usize,
    /// Used vertices - edges + triangles: 2 for a sphere, 0 for a torus, added up over parts.
    pub euler_characteristic: i64,
    /// Every edge has just two triangles.
    pub closed: bool,
    /// No edge is flipped.
    pub oriented: bool,
    /// Least and greatest coordinates of the vertices that triangles use.
    pub bounding_box: [DVec3; 2],
    /// Length of the diagonal of the bounding box.
    pub diagonal: f64,
    /// Sum of the areas of the triangles.
    pub area: f64,
    /// The volume inside, negative if the mesh is turned inside out. None unless closed and oriented.
    pub volume: Option<f64>,
}

/// Looks a mesh over. `topology` is that of `mesh.triangles`.
///
/// Works alike at any size: areas and volumes are taken relative to the bounding box. A mesh without
/// triangles has zeros and is neither closed nor, for want of anything to the contrary, flipped.
pub fn examine(mesh: &Mesh, topology: &Topology) -> Findings {
    let polygons = &mesh.polygons;
    let count = |kind: EdgeKind| topology.edge_kind.iter().filter(|&&k| k == kind).count();
    let [border_edges, non_manifold_edges, flipped_edges] =
        [EdgeKind::Border, EdgeKind::NonManifold, EdgeKind::Flipped].map(count);
    let isolated = (0..mesh.positions().len())
        .filter(|&v| topology.vertex_faces.row(v).is_empty())
        .count();
    let used = mesh.positions().len() - isolated;
    let fans = fans::examine(topology);
    let [low, high] = mesh.bounding_box();
    let sizes = Sizes::of(mesh, [low, high]);
    let closed = !mesh.triangles.is_empty() && border_edges == 0 && non_manifold_edges == 0;
    let oriented = flipped_edges == 0;

    Findings {
        input_faces: polygons.face_count(),
        larger_polygons: polygons
            .starts
            .windows(2)
            .filter(|w| w[1] - w[0] != 3)
            .count(),
        input_vertices: mesh.vertex_of_input.len(),
        distinct_vertices: mesh.positions().len(),
        isolated_vertices: isolated,
        triangles: mesh.triangles.len(),
        edges: topology.edge_kind.len(),
        border_edges,
        border_loops: fans.border_loops,
        non_manifold_edges,
        non_manifold_vertices: fans.non_manifold_vertices,
        flipped_edges,
        duplicate_faces: duplicate_faces(mesh),
        zero_area_triangles: sizes.zero_area,
        faces_without_triangle: polygons.face_count()
            - mesh.face_of_triangle.chunk_by(|a, b| a == b).count(),
        parts: parts(topology),
        euler_characteristic: used as i64 - topology.edge_kind.len() as i64
            + mesh.triangles.len() as i64,
        closed,
        oriented,
        bounding_box: [low, high],
        diagonal: low.distance(high),
        area: sizes.area,
        volume: (closed && oriented).then_some(sizes.volume),
    }
}

/// How large everything is.
struct Sizes {
    area: f64,
    /// Of the tetrahedra between each triangle and the middle of the box.
    volume: f64,
    zero_area: usize,
}

impl Sizes {
    fn of(mesh: &Mesh, [low, high]: [DVec3; 2]) -> Self {
        let side = (high - low).max_element();
        if side == 0.0 {
            return Self {
                area: 0.0,
                volume: 0.0,
                zero_area: mesh.triangles.len(),
            };
        }
        let middle = low + 0.5 * (high - low);
        let mut sizes = Self {
            area: 0.0,
            volume: 0.0,
            zero_area: 0,
        };
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|v| (mesh.positions()[v as usize] - middle) / side);
            let area = 0.5 * (b - a).cross(c - a).length();
            sizes.area += area;
            sizes.volume += a.dot(b.cross(c)) / 6.0;
            sizes.zero_area += usize::from(area <= 1e-14);
        }
        sizes.area *= side * side;
        sizes.volume *= side * side * side;
        sizes
    }
}

/// Parts connected through edges, non-manifold ones too.
fn parts(topology: &Topology) -> usize {
    let mut sets = Sets::new(topology.face_edges.len());
    for (face, edges) in topology.face_edges.iter().enumerate() {
        for &edge in edges {
            sets.unite(face as u32, topology.edge_faces[edge as usize][0]);
        }
    }
    sets.count()
}

/// Faces with the same set of vertices as an earlier face; those without a triangle do not count.
fn duplicate_faces(mesh: &Mesh) -> usize {
    let polygons = &mesh.polygons;
    let with_triangle = || {
        mesh.face_of_triangle
            .chunk_by(|a, b| a == b)
            .map(|run| run[0] as usize)
    };
    let mut threes: Vec<[u32; 3]> = Vec::with_capacity(mesh.triangles.len());
    let mut others: Vec<Vec<u32>> = Vec::new();
    for face in with_triangle() {
        if let Ok(three) = <[u32; 3]>::try_from(polygons.face(face)) {
            threes.push(three);
        } else {
            let mut vertices = polygons.face(face).to_vec();
            vertices.sort_unstable();
            vertices.dedup();
            others.push(vertices);
        }
    }
    threes
        .par_iter_mut()
        .for_each(|three| three.sort_unstable());
    // A larger polygon that repeats a vertex may come down to three.
    others.retain(|vertices| match <[u32; 3]>::try_from(&vertices[..]) {
        Ok(three) => {
            threes.push(three);
            false
        }
        Err(_) => true,
    });
    threes.par_sort_unstable();
    others.par_sort_unstable();
    let repeats = |runs: usize, all: usize| all - runs;
    repeats(threes.chunk_by(|a, b| a == b).count(), threes.len())
        + repeats(others.chunk_by(|a, b| a == b).count(), others.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, PolygonMesh, weld};

    pub(super) fn findings(positions: &[[f64; 3]], faces: &[&[u32]]) -> Findings {
        let ends = faces.iter().scan(0, |end, face| {
            *end += face.len() as u32;
            Some(*end)
        });
        let polygons = PolygonMesh {
            format: Format::Memory,
            positions: positions.iter().map(|&p| p.into()).collect(),
            starts: [0].into_iter().chain(ends).collect(),
            corners: faces.concat(),
        };
        let mesh = weld(polygons, 0.0);
        let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
        examine(&mesh, &topology)
    }

    const BOX: [&[u32]; 6] = [
        &[0, 2, 3, 1],
        &[4, 5, 7, 6],
        &[0, 1, 5, 4],
        &[2, 6, 7, 3],
        &[0, 4, 6, 2],
        &[1, 3, 7, 5],
    ];

    fn corners_of_box(at: f64, side: f64) -> Vec<[f64; 3]> {
        (0..8)
            .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| at + side * f64::from(bit)))
            .collect()
    }

    #[test]
    fn a_box_is_closed_and_has_its_volume_at_any_size() {
        for side in [1.0, 1e-12, 1e12] {
            let found = findings(&corners_of_box(side, side), &BOX);
            assert_eq!(
                (
                    found.input_faces,
                    found.larger_polygons,
                    found.triangles,
                    found.edges
                ),
                (6, 6, 12, 18)
            );
            assert_eq!(
                (
                    found.euler_characteristic,
                    found.parts,
                    found.zero_area_triangles
                ),
                (2, 1, 0)
            );
            assert!(found.closed && found.oriented);
            assert!((found.volume.unwrap() / side.powi(3) - 1.0).abs() < 1e-9);
            assert!((found.area / side.powi(2) - 6.0).abs() < 1e-9);
            assert!((found.diagonal / side - 3f64.sqrt()).abs() < 1e-9);
        }
    }

    #[test]
    fn a_box_turned_inside_out_has_negative_volume_and_a_half_turned_one_none() {
        let reversed: Vec<Vec<u32>> = BOX
            .iter()
            .map(|f| f.iter().rev().copied().collect())
            .collect();
        let faces: Vec<&[u32]> = reversed.iter().map(Vec::as_slice).collect();
        assert!(findings(&corners_of_box(0.0, 2.0), &faces).volume.unwrap() < -7.9);
        let mut half = BOX;
        half[0] = &[1, 3, 2, 0];
        let found = findings(&corners_of_box(0.0, 2.0), &half);
        assert_eq!(
            (
                found.flipped_edges,
                found.oriented,
                found.closed,
                found.volume
            ),
            (4, false, true, None)
        );
    }

    #[test]
    fn duplicates_are_told_by_their_vertices_and_empty_faces_are_none() {
        let faces: [&[u32]; 6] = [
            &[0, 1, 2],
            &[2, 1, 0],
            &[0, 1, 3, 2],
            &[3, 1, 0, 2],
            &[1, 1, 1],
            &[0, 0, 1, 2],
        ];
        let found = findings(
            &[
                [0., 0., 0.],
                [1., 0., 0.],
                [0., 1., 0.],
                [1., 1., 0.],
                [9., 9., 9.],
            ],
            &faces,
        );
        assert_eq!(
            (
                found.duplicate_faces,
                found.faces_without_triangle,
                found.isolated_vertices
            ),
            (3, 1, 1)
        );
    }

    #[test]
    fn a_needle_has_no_area_and_keeps_its_triangle() {
        let found = findings(
            &[[0., 0., 0.], [1., 0., 0.], [0.5, 0., 0.], [0., 1., 0.]],
            &[&[0, 1, 3], &[0, 2, 1]],
        );
        assert_eq!(
            (found.triangles, found.zero_area_triangles, found.parts),
            (2, 1, 1)
        );
    }
}
