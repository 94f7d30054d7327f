//! Strokes: edges that a hand would draw in one go.

use seamline_mesh::Sets;

use crate::contours::Ground;

/// A stroke goes straight on through a junction if it turns by less than this there. From a flat of a smooth cube into
/// the first of two chords of its corner it is 22.5; false edges make up to .004 of F1 with anything from 23 to 45.
const STRAIGHT_DEG: f64 = 30.0;

/// How many edges the stroke of each edge has. Two edges are of one stroke where they meet alone, or where each is the
/// one that goes on straightest from the other and the turn is small. A boundary that is one edge long goes on beyond its
/// junctions; an edge thrown across a flat ends where it meets the rim.
pub fn strokes(ground: &Ground<'_>, edges: &[u32]) -> Vec<u32> {
    let mut at: Vec<(u32, u32)> = Vec::with_capacity(2 * edges.len());
    for (index, &edge) in edges.iter().enumerate() {
        let ends = ground.topology.edge_vertices[edge as usize];
        at.extend(ends.map(|vertex| (vertex, index as u32)));
    }
    at.sort_unstable();
    let mut sets = Sets::new(edges.len());
    for here in at.chunk_by(|a, b| a.0 == b.0) {
        let vertex = here[0].0;
        if let &[(_, a), (_, b)] = here {
            sets.unite(a, b);
            continue;
        }
        let turn = |a: u32, b: u32| ground.turn_deg(edges[a as usize], vertex, edges[b as usize]);
        let onward = |from: u32| {
            let others = here.iter().map(|&(_, to)| to).filter(|&to| to != from);
            others.min_by(|&a, &b| turn(from, a).total_cmp(&turn(from, b)))
        };
        for &(_, a) in here {
            if let Some(b) = onward(a)
                && a < b
                && onward(b) == Some(a)
                && turn(a, b) < STRAIGHT_DEG
            {
                sets.unite(a, b);
            }
        }
    }
    let (stroke_of, count) = sets.numbered();
    let mut sizes = vec![0; count];
    stroke_of
        .iter()
        .for_each(|&stroke| sizes[stroke as usize] += 1);
    stroke_of
        .iter()
        .map(|&stroke| sizes[stroke as usize])
        .collect()
}
