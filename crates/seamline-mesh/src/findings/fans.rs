//! What the triangles round a vertex make, and the curves along the border.

use rayon::prelude::*;

use crate::sets::Sets;
use crate::{EdgeKind, Topology};

/// What was found round the vertices.
pub(super) struct Fans {
    pub(super) non_manifold_vertices: usize,
    pub(super) border_loops: usize,
}

/// Looks round every vertex.
///
/// The triangles at a vertex form fans: two are in the same fan if they share an edge at the vertex. A border
/// curve that reaches a vertex goes on along the other border edge of the same fan, so that two curves
/// that only touch are two.
pub(super) fn examine(topology: &Topology) -> Fans {
    let vertices = topology.vertex_faces.row_count();
    let round: Vec<(bool, Vec<[u32; 2]>)> = (0..vertices)
        .into_par_iter()
        .with_min_len(4096)
        .map_init(Vec::new, |corners, vertex| {
            look_round(topology, vertex as u32, corners)
        })
        .filter(|(several, border)| *several || !border.is_empty())
        .collect();

    let mut loops = Sets::new(topology.edge_kind.len());
    for &[a, b] in round.iter().flat_map(|(_, border)| border) {
        loops.unite(a, b);
    }
    let border_edges =
        (0..topology.edge_kind.len()).filter(|&e| topology.edge_kind[e] == EdgeKind::Border);
    Fans {
        non_manifold_vertices: round.iter().filter(|(several, _)| *several).count(),
        border_loops: border_edges
            .filter(|&edge| loops.first(edge as u32) == edge as u32)
            .count(),
    }
}

/// Whether there are several fans at `vertex`, and pairs of border edges of the same fan. `corners` is
/// memory to work in.
fn look_round(
    topology: &Topology,
    vertex: u32,
    corners: &mut Vec<(u32, u32)>,
) -> (bool, Vec<[u32; 2]>) {
    let faces = topology.vertex_faces.row(vertex as usize);
    corners.clear();
    for (place, &face) in faces.iter().enumerate() {
        for edge in topology.face_edges[face as usize] {
            if topology.edge_vertices[edge as usize].contains(&vertex) {
                corners.push((edge, place as u32));
            }
        }
    }
    corners.sort_unstable();
    let mut fans = Sets::new(faces.len());
    for same_edge in corners.chunk_by(|a, b| a.0 == b.0) {
        same_edge
            .iter()
            .for_each(|&(_, place)| fans.unite(same_edge[0].1, place));
    }

    let mut border: Vec<(u32, u32)> = corners
        .iter()
        .filter(|(edge, _)| topology.edge_kind[*edge as usize] == EdgeKind::Border)
        .map(|&(edge, place)| (fans.first(place), edge))
        .collect();
    border.sort_unstable();
    let pairs = border
        .windows(2)
        .filter(|w| w[0].0 == w[1].0)
        .map(|w| [w[0].1, w[1].1])
        .collect();
    (fans.count() > 1, pairs)
}

#[cfg(test)]
mod tests {
    use crate::findings::tests::findings;

    const PLANE: [[f64; 3]; 9] = [
        [0., 0., 0.],
        [1., 0., 0.],
        [2., 0., 0.],
        [0., 1., 0.],
        [1., 1., 0.],
        [2., 1., 0.],
        [0., 2., 0.],
        [1., 2., 0.],
        [2., 2., 0.],
    ];

    #[test]
    fn an_annulus_has_two_border_loops() {
        let ring: [&[u32]; 4] = [&[0, 1, 4, 3], &[1, 2, 5, 4], &[4, 5, 8, 7], &[3, 4, 7, 6]];
        assert_eq!(findings(&PLANE, &ring).border_loops, 1);
        let outer = [[-1., -1., 0.], [3., -1., 0.], [3., 3., 0.], [-1., 3., 0.]];
        let inner = [[0., 0., 0.], [2., 0., 0.], [2., 2., 0.], [0., 2., 0.]];
        let faces: [&[u32]; 4] = [&[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
        let found = findings(&[outer, inner].concat(), &faces);
        assert_eq!(
            (
                found.border_loops,
                found.border_edges,
                found.euler_characteristic
            ),
            (2, 8, 0)
        );
    }

    #[test]
    fn two_squares_that_touch_in_a_corner_have_two_loops_and_one_bad_vertex() {
        let found = findings(&PLANE, &[&[0, 1, 4, 3], &[4, 5, 8, 7]]);
        assert_eq!(
            (found.border_loops, found.non_manifold_vertices, found.parts),
            (2, 1, 2)
        );
    }

    #[test]
    fn a_fin_makes_a_bad_edge_but_no_bad_vertex() {
        let fin: [&[u32]; 3] = [&[0, 1, 4], &[1, 0, 2], &[0, 1, 8]];
        let found = findings(&PLANE, &fin);
        assert_eq!(
            (
                found.non_manifold_edges,
                found.non_manifold_vertices,
                found.parts
            ),
            (1, 0, 1)
        );
    }
}
