//! Boundary curves: edges put end to end.

use std::collections::BTreeMap;

/// Puts edges (pairs of vertices) end to end into curves as long as they go: a curve ends where one edge
/// or more than two meet, and a closed curve ends at the vertex it begins with. Every edge is in one
/// curve, once. Open curves come first, each from its lower end, in order of their first vertex.
pub fn chains(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut at: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (edge, ends) in edges.iter().enumerate() {
        for &end in ends {
            at.entry(end).or_default().push(edge);
        }
    }
    let mut walked = vec![false; edges.len()];
    let mut found = Vec::new();
    for open in [true, false] {
        for (&vertex, around) in &at {
            if open && around.len() == 2 {
                continue;
            }
            for &edge in around {
                if !walked[edge] {
                    found.push(walk(edges, &at, &mut walked, vertex, edge));
                }
            }
        }
    }
    found
}

fn walk(
    edges: &[[u32; 2]],
    at: &BTreeMap<u32, Vec<usize>>,
    walked: &mut [bool],
    mut vertex: u32,
    mut edge: usize,
) -> Vec<u32> {
    let mut curve = vec![vertex];
    loop {
        walked[edge] = true;
        let [a, b] = edges[edge];
        vertex = if a == vertex { b } else { a };
        curve.push(vertex);
        match at[&vertex][..] {
            [a, b] if !walked[a] || !walked[b] => edge = if walked[a] { b } else { a },
            _ => return curve,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_curve_runs_from_its_lower_end() {
        assert_eq!(chains(&[[7, 3], [3, 9], [9, 4]]), [[4, 9, 3, 7]]);
    }

    #[test]
    fn a_closed_curve_ends_where_it_begins() {
        assert_eq!(chains(&[[2, 5], [5, 1], [1, 2]]), [[1, 5, 2, 1]]);
    }

    #[test]
    fn curves_end_where_three_edges_meet() {
        assert_eq!(chains(&[[0, 1], [1, 2], [1, 3]]), [[0, 1], [1, 2], [1, 3]]);
    }
}
