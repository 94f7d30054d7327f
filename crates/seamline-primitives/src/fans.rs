//! The edges about a vertex in order, and how straight one goes on as another.

use glam::DVec3;
use seamline_mesh::Topology;

/// The edges about a vertex in order, each with the degrees that lie before it: 360 are the whole, whatever the angles of
/// the triangles add up to. `None` at a border and where faces are not oriented alike.
pub(crate) fn fan(
    positions: &[DVec3],
    topology: &Topology,
    vertex: u32,
) -> Option<Vec<(u32, f64)>> {
    let edges = topology.vertex_edges.row(vertex as usize);
    let to = |v: u32| positions[v as usize] - positions[vertex as usize];
    let mut fan: Vec<(u32, f64)> = Vec::with_capacity(edges.len());
    let mut edge = *edges.first()?;
    let mut whole = 0.0;
    for _ in edges {
        // Two fans meet in the vertex.
        if fan.first().is_some_and(|first| first.0 == edge) {
            return None;
        }
        fan.push((edge, whole));
        let far = topology.far_end(edge, vertex);
        let (face, across) = topology
            .face_pair(edge as usize)?
            .into_iter()
            .find_map(|f| {
                let corners = topology.triangles[f as usize];
                let i = corners.iter().position(|&v| v == vertex)?;
                (corners[(i + 1) % 3] == far).then_some((f, corners[(i + 2) % 3]))
            })?;
        whole += to(far).angle_between(to(across));
        let mut of_face = topology.face_edges[face as usize].into_iter();
        edge = of_face.find(|&e| {
            let ends = topology.edge_vertices[e as usize];
            ends.contains(&vertex) && ends.contains(&across)
        })?;
    }
    (edge == fan[0].0 && whole > 0.0).then(|| {
        for (_, before) in &mut fan {
            *before *= 360.0 / whole;
        }
        fan
    })
}

/// Pairs of edges of a fan each of which is the straightest way on from the other, with the degrees by which one turns
/// from the first to the second.
pub(crate) fn straightest(fan: &[(u32, f64)]) -> Vec<(u32, u32, f64)> {
    let turn = |i: usize, j: usize| (fan[j].1 - fan[i].1).rem_euclid(360.0) - 180.0;
    let best = |i: usize| {
        let across = (fan[i].1 + 180.0) % 360.0;
        let after = fan.partition_point(|edge| edge.1 < across);
        let either = [after % fan.len(), (after + fan.len() - 1) % fan.len()];
        let others = either.into_iter().filter(|&j| j != i);
        others.min_by(|&a, &b| turn(i, a).abs().total_cmp(&turn(i, b).abs()))
    };
    let best: Vec<Option<usize>> = (0..fan.len()).map(best).collect();
    let pairs = best.iter().enumerate().filter_map(|(i, &j)| Some((i, j?)));
    pairs
        .filter(|&(i, j)| i < j && best[j] == Some(i))
        .map(|(i, j)| (fan[i].0, fan[j].0, turn(i, j)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vertex amid six others, at these angles about it in degrees.
    fn wheel(angles: [f64; 6]) -> (Vec<DVec3>, Topology) {
        let mut positions = vec![DVec3::ZERO];
        positions
            .extend(angles.map(|a| DVec3::new(a.to_radians().cos(), a.to_radians().sin(), 0.0)));
        let triangles = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]).collect();
        (positions, Topology::build(7, triangles))
    }

    #[test]
    fn an_edge_goes_on_with_the_one_across_and_turns_by_what_it_is_off() {
        let (positions, topology) = wheel([0.0, 50.0, 130.0, 177.0, 240.0, 300.0]);
        let fan = fan(&positions, &topology, 0).unwrap();
        let far = |edge| topology.far_end(edge, 0);
        let pairs = straightest(&fan);
        let across = pairs.iter().find(|p| far(p.0).min(far(p.1)) == 1).unwrap();
        assert_eq!(far(across.0).max(far(across.1)), 4);
        assert!((across.2.abs() - 3.0).abs() < 1e-9);
    }

    #[test]
    fn nothing_goes_on_through_a_vertex_at_the_rim() {
        let (positions, topology) = wheel([0.0, 60.0, 120.0, 180.0, 240.0, 300.0]);
        assert!(fan(&positions, &topology, 1).is_none());
    }
}
