//! Vertices at the same place become one; faces become triangles.

mod near;
mod same;

use glam::DVec3;

use crate::{Mesh, PolygonMesh, Triangulator};

/// Welds vertices and triangulates faces.
///
/// `tolerance` is a length in the file's unit. At 0 only vertices with identical coordinates are one
/// (`-0.0` is `0.0`). Above it, vertices up to `tolerance` apart are one, and so are those connected by a
/// chain of such pairs, whatever their order; the lowest-numbered of them says where they are. A tolerance
/// below the precision of the coordinates, negative or not a number counts as 0.
///
/// Positions come in order of first appearance; those no face uses are kept. Triangles with two equal
/// vertices are dropped, their faces stay.
///
/// Cost: linear on average.
pub fn weld(polygons: PolygonMesh, tolerance: f64) -> Mesh {
    let PolygonMesh {
        format,
        positions,
        starts,
        mut corners,
    } = polygons;
    let (mut positions, mut vertex_of_input) =
        number(&same::earlier_at_same_place(&positions), &positions);
    if let Some(firsts) = near::first_nearby(&positions, tolerance) {
        let (fewer, merged) = number(&firsts, &positions);
        positions = fewer;
        vertex_of_input
            .iter_mut()
            .for_each(|vertex| *vertex = merged[*vertex as usize]);
    }
    corners
        .iter_mut()
        .for_each(|corner| *corner = vertex_of_input[*corner as usize]);

    let polygons = PolygonMesh {
        format,
        positions,
        starts,
        corners,
    };
    let (triangles, face_of_triangle) = triangulate(&polygons);
    Mesh {
        polygons,
        triangles,
        face_of_triangle,
        vertex_of_input,
    }
}

/// The tolerance that is `share` of the diagonal of the bounding box of all vertices: a length in the
/// file's unit. 0 without vertices.
pub fn tolerance_from_share(polygons: &PolygonMesh, share: f64) -> f64 {
    bounds(&polygons.positions).map_or(0.0, |[low, high]| share * low.distance(high))
}

fn bounds(positions: &[DVec3]) -> Option<[DVec3; 2]> {
    let first = *positions.first()?;
    Some(
        positions
            .iter()
            .fold([first; 2], |[low, high], &p| [p.min(low), p.max(high)]),
    )
}

/// Numbers the vertices that name themselves, in order; gives their positions, and for every vertex the number
/// of the one it leads to. `earlier[i] <= i`.
fn number(earlier: &[u32], positions: &[DVec3]) -> (Vec<DVec3>, Vec<u32>) {
    let mut distinct = Vec::new();
    let mut numbers: Vec<u32> = Vec::with_capacity(earlier.len());
    for (vertex, &first) in earlier.iter().enumerate() {
        if first as usize == vertex {
            numbers.push(distinct.len() as u32);
            // Adding zero turns -0.0 into 0.0.
            distinct.push(positions[vertex] + DVec3::ZERO);
        } else {
            numbers.push(numbers[first as usize]);
        }
    }
    (distinct, numbers)
}

fn triangulate(polygons: &PolygonMesh) -> (Vec<[u32; 3]>, Vec<u32>) {
    let mut triangulator = Triangulator::default();
    let mut triangles = Vec::with_capacity(polygons.face_count());
    let mut face_of_triangle = Vec::with_capacity(polygons.face_count());
    for face in 0..polygons.face_count() {
        match *polygons.face(face) {
            [a, b, c] if a != b && b != c && c != a => triangles.push([a, b, c]),
            ref corners => triangulator.triangulate(&polygons.positions, corners, &mut triangles),
        }
        face_of_triangle.resize(triangles.len(), face as u32);
    }
    (triangles, face_of_triangle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Format;
    use proptest::prelude::*;

    fn soup(positions: Vec<DVec3>) -> PolygonMesh {
        let triangles: Vec<[u32; 3]> = (0..positions.len() as u32 / 3)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect();
        PolygonMesh::from_triangles(Format::Memory, positions, &triangles)
    }

    #[test]
    fn positions_come_in_order_of_first_appearance_and_minus_zero_is_zero() {
        let mesh = weld(
            soup(vec![
                DVec3::X,
                DVec3::new(-0.0, 0.0, -0.0),
                DVec3::Y,
                DVec3::ZERO,
                DVec3::X,
                DVec3::Z,
            ]),
            0.0,
        );
        assert_eq!(
            mesh.positions(),
            [DVec3::X, DVec3::ZERO, DVec3::Y, DVec3::Z]
        );
        assert!(
            mesh.positions()[1]
                .to_array()
                .iter()
                .all(|c| c.is_sign_positive())
        );
        assert_eq!(mesh.vertex_of_input, [0, 1, 2, 1, 0, 3]);
        assert_eq!(mesh.triangles, [[0, 1, 2], [1, 0, 3]]);
    }

    #[test]
    fn a_face_without_triangle_is_still_a_face() {
        let mesh = weld(
            soup(vec![
                DVec3::X,
                DVec3::X,
                DVec3::Y,
                DVec3::X,
                DVec3::Y,
                DVec3::Z,
            ]),
            0.0,
        );
        assert_eq!(mesh.polygons.face_count(), 2);
        assert_eq!(mesh.face_of_triangle, [1]);
        assert_eq!(mesh.polygons.face(0), [0, 0, 1]);
    }

    #[test]
    fn unused_vertices_stay() {
        let mut polygons = soup(vec![DVec3::X, DVec3::Y, DVec3::Z]);
        polygons.positions.push(DVec3::ONE);
        assert_eq!(weld(polygons, 0.0).positions().len(), 4);
    }

    #[test]
    fn a_chain_within_tolerance_is_one_vertex_at_its_lowest_number() {
        let chain: Vec<DVec3> = [0.3, 0.0, 0.2, 0.1, 5.0, 0.4]
            .iter()
            .map(|&x| DVec3::new(x, 0.0, 0.0))
            .collect();
        let mesh = weld(soup(chain), 0.1001);
        assert_eq!(
            mesh.positions(),
            [DVec3::new(0.3, 0.0, 0.0), DVec3::new(5.0, 0.0, 0.0)]
        );
        assert_eq!(mesh.vertex_of_input, [0, 0, 0, 0, 1, 0]);
    }

    #[test]
    fn a_tolerance_that_means_nothing_counts_as_zero() {
        for tolerance in [-1.0, f64::NAN, 1e-300] {
            let mesh = weld(
                soup(vec![DVec3::X, DVec3::X * (1.0 + 1e-15), DVec3::Y]),
                tolerance,
            );
            assert_eq!(mesh.positions().len(), 3);
        }
    }

    #[test]
    fn a_tolerance_that_swallows_the_mesh_takes_no_longer() {
        let many: Vec<DVec3> = (0..300_000)
            .map(|i| DVec3::new(f64::from(i).sin(), f64::from(i).cos(), 0.0))
            .collect();
        for tolerance in [0.01, 1.0, 1e9, f64::INFINITY] {
            assert_eq!(weld(soup(many.clone()), tolerance).positions().len(), 1);
        }
    }

    proptest! {
        #[test]
        fn every_input_vertex_keeps_its_place(coordinates in prop::collection::vec(-2i8..3, 9..400)) {
            let positions: Vec<DVec3> = coordinates.chunks_exact(3)
                .map(|c| DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2]))).collect();
            let mesh = weld(soup(positions.clone()), 0.0);
            for (input, &vertex) in mesh.vertex_of_input.iter().enumerate() {
                prop_assert_eq!(mesh.positions()[vertex as usize], positions[input]);
            }
            let mut distinct: Vec<_> = mesh.positions().iter().map(|p| p.to_array().map(|c| c as i64)).collect();
            distinct.sort();
            distinct.dedup();
            prop_assert_eq!(distinct.len(), mesh.positions().len());
        }

        #[test]
        fn welding_nearby_agrees_with_trying_all_pairs(
            coordinates in prop::collection::vec(0.0f64..4.0, 9..240), tolerance in 0.05f64..1.0,
        ) {
            let positions: Vec<DVec3> = coordinates.as_chunks().0.iter().map(|&c| DVec3::from_array(c)).collect();
            let mut group: Vec<usize> = (0..positions.len()).collect();
            for i in 0..positions.len() {
                for j in 0..i {
                    if positions[i].distance(positions[j]) <= tolerance {
                        let (from, to) = (group[i].max(group[j]), group[i].min(group[j]));
                        group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
                    }
                }
            }
            let mesh = weld(soup(positions.clone()), tolerance);
            for (input, &vertex) in mesh.vertex_of_input.iter().enumerate() {
                prop_assert_eq!(mesh.positions()[vertex as usize], positions[group[input]]);
            }
        }
    }
}
