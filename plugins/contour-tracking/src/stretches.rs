//! Stretches of boundary that no edge proves, and whether they run straight.

use seamline_ecs::components::ContourState;
use seamline_mesh::Sets;

use crate::contours::Ground;

/// Boundary edges that are not correct, each with whether its stretch is straight. A stretch is what hangs together of
/// them without a third boundary edge at a vertex; it is straight if it nowhere turns by more than `most_deg`,
/// neither in itself nor into the correct edges it comes from.
pub fn stretches(
    ground: &Ground<'_>,
    boundary: &[u32],
    most_deg: f64,
    states: &[ContourState],
) -> Vec<(u32, bool)> {
    let unproved: Vec<u32> = boundary
        .iter()
        .copied()
        .filter(|&edge| states[edge as usize] != ContourState::Correct)
        .collect();
    let mut sets = Sets::new(unproved.len());
    let mut turns = vec![false; unproved.len()];
    let place = |edge: u32| unproved.binary_search(&edge).ok();
    for (vertex, [a, b]) in pairs(ground, boundary) {
        let turns_here = || ground.turn_deg(a, vertex, b) > most_deg;
        match (place(a), place(b)) {
            (Some(a), Some(b)) => {
                sets.unite(a as u32, b as u32);
                turns[a] |= turns_here();
            }
            (Some(one), None) | (None, Some(one)) => turns[one] |= turns_here(),
            (None, None) => {}
        }
    }
    let (stretch_of, count) = sets.numbered();
    let mut is_straight = vec![true; count];
    for (&stretch, &turns) in stretch_of.iter().zip(&turns) {
        is_straight[stretch as usize] &= !turns;
    }
    let straight = stretch_of.iter().map(|&s| is_straight[s as usize]);
    unproved.into_iter().zip(straight).collect()
}

/// The vertices at which just two of the edges meet, with the two.
fn pairs(ground: &Ground<'_>, edges: &[u32]) -> Vec<(u32, [u32; 2])> {
    let ends = |&edge: &u32| ground.topology.edge_vertices[edge as usize].map(|v| (v, edge));
    let mut at: Vec<(u32, u32)> = edges.iter().flat_map(ends).collect();
    at.sort_unstable();
    at.chunk_by(|a, b| a.0 == b.0)
        .filter_map(|here| match here {
            [a, b] => Some((a.0, [a.1, b.1])),
            _ => None,
        })
        .collect()
}
