//! Faces that are turned inside out, turned back.
//!
//! Normals and dihedral angles follow the order of corners: a turned face has a crease on each side that is no crease of
//! the part, and would be a patch of its own.

use seamline_ecs::components::Position;
use seamline_mesh::{EdgeKind, Topology};

/// The faces to be turned so that all that hangs together over edges with two faces agrees, rising. In each such piece
/// the smaller part by number, of equals that by area, is turned, so that what is outside stays so. A piece that cannot
/// agree, such as a Moebius strip, is left as it is.
///
/// Cost: linear.
pub fn turned_faces(topology: &Topology, positions: &[Position]) -> Vec<u32> {
    if !topology.edge_kind.contains(&EdgeKind::Flipped) {
        return Vec::new();
    }
    let mut side: Vec<Option<bool>> = vec![None; topology.triangles.len()];
    let mut turned = Vec::new();
    for first in 0..topology.triangles.len() as u32 {
        if side[first as usize].is_some() {
            continue;
        }
        side[first as usize] = Some(false);
        let mut piece = vec![first];
        let mut agrees = true;
        let mut next = 0;
        while let Some(&face) = piece.get(next) {
            next += 1;
            for edge in topology.face_edges[face as usize] {
                let Some(across) = topology.neighbour(face, edge) else {
                    continue;
                };
                let flipped = topology.edge_kind[edge as usize] == EdgeKind::Flipped;
                let wanted = side[face as usize].map(|side| side != flipped);
                match side[across as usize] {
                    None => {
                        side[across as usize] = wanted;
                        piece.push(across);
                    }
                    known => agrees &= known == wanted,
                }
            }
        }
        if agrees {
            let (one, other): (Vec<u32>, Vec<u32>) = piece
                .into_iter()
                .partition(|&face| side[face as usize] == Some(true));
            let by_size = one.len().cmp(&other.len()).then_with(|| {
                let [one, other] = [&one, &other].map(|faces| area(topology, positions, faces));
                one.total_cmp(&other)
            });
            turned.extend(if by_size.is_le() { one } else { other });
        }
    }
    turned.sort_unstable();
    turned
}

fn area(topology: &Topology, positions: &[Position], faces: &[u32]) -> f64 {
    let doubled = |&face: &u32| {
        let [a, b, c] = topology.triangles[face as usize].map(|v| positions[v as usize].0);
        (b - a).cross(c - a).length()
    };
    faces.iter().map(doubled).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    /// A square pyramid without its base, its apex last, each side run through in the order given.
    fn turned(sides: [[u32; 3]; 4]) -> Vec<u32> {
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let mut positions: Vec<Position> = corners
            .iter()
            .map(|&(x, y)| Position(dvec3(x, y, 0.0)))
            .collect();
        positions.push(Position(dvec3(0.0, 0.0, 1.0)));
        turned_faces(&Topology::build(5, sides.to_vec()), &positions)
    }

    #[test]
    fn the_fewer_faces_are_turned_and_none_where_all_agree() {
        let right = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        assert!(turned(right).is_empty());
        let mut one = right;
        one[2] = [3, 2, 4];
        assert_eq!(turned(one), [2]);
        let mut three = right;
        for face in [0, 1, 3] {
            three[face].swap(0, 1);
        }
        assert_eq!(turned(three), [2]);
        assert!(turned(right.map(|[a, b, c]| [b, a, c])).is_empty());
    }

    #[test]
    fn a_moebius_strip_stays_as_it_is() {
        // Five triangles round, the last joined to the first the wrong way about.
        let strip = [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]];
        let positions = vec![Position(dvec3(0.0, 0.0, 0.0)); 5];
        let topology = Topology::build(5, strip.to_vec());
        assert!(topology.edge_kind.contains(&EdgeKind::Flipped));
        assert!(turned_faces(&topology, &positions).is_empty());
    }
}
