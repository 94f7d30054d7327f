//! Gaps bridged by the cheapest way over the whole mesh, instead of step by step.

use std::collections::BinaryHeap;

use foldhash::HashMap;
use seamline_ecs::components::ContourState;
use seamline_ecs::{EndFate, OpenEnd};

use crate::contours::{Contours, Ground, Lightest};

/// What running into the side of a contour counts as: a turn into it. Without it an open end closes upon its own contour
/// rather than going on to the one in front of it.
const T_JUNCTION_DEG: f64 = 90.0;

/// A way from an open end to a contour.
struct Bridge {
    /// The place of the end among all.
    end: usize,
    cost: f64,
    edges: Vec<u32>,
}

/// Closes every open end by the cheapest way to another open end or to any other vertex of a contour, the
/// cheapest of all first. A way costs the weights of its steps ([`Ground::turn_weight`]) together, the turn into the
/// contour it meets at another open end included. An end from which no way within [`Ground::max_gap`] leads anywhere
/// is left. Gives what became of each end, by vertex.
///
/// Cost: for each open end, n log n of the edges nearer than its contour.
pub fn bridge(ground: Ground<'_>, states: &mut [ContourState]) -> Vec<OpenEnd> {
    let mut contours = Contours::of(ground, states);
    let mut ends = contours.open_ends();
    let mut bridges: Vec<Bridge> = ends
        .iter()
        .enumerate()
        .filter_map(|(at, end)| cheapest(&contours, at, end.vertex))
        .collect();
    bridges.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.end.cmp(&b.end)));
    for bridge in bridges {
        let end = &mut ends[bridge.end];
        if !contours.is_open(end.vertex) {
            continue;
        }
        let mut at = end.vertex;
        for edge in bridge.edges {
            end.edges += 1;
            end.length += ground.length(edge);
            // Contours that have grown meanwhile may lie in the way: there it ends.
            if contours.add(edge, at) {
                break;
            }
            at = ground.topology.far_end(edge, at);
        }
        end.fate = EndFate::Closed;
    }
    for end in &mut ends {
        if end.fate == EndFate::Left && !contours.is_open(end.vertex) {
            end.fate = EndFate::Met;
        }
    }
    ends
}

/// Dijkstra over steps, a step being an edge and the end it leads to: what the next one costs depends on where the last
/// came from.
fn cheapest(contours: &Contours<'_>, end: usize, from: u32) -> Option<Bridge> {
    let ground = &contours.ground;
    let arriving = contours.arriving(from)?;
    let mut before: HashMap<(u32, u32), (u32, u32)> = HashMap::default();
    let mut heap = BinaryHeap::new();
    let mut length_of: HashMap<(u32, u32), f64> = HashMap::default();
    let start = (arriving, from);
    length_of.insert(start, 0.0);
    let push = |heap: &mut BinaryHeap<_>, step: (u32, u32), cost: f64| {
        let (edge, at) = step;
        for &next in ground.edges_at(at) {
            if next != edge && !contours.has(next) {
                let far = ground.topology.far_end(next, at);
                let mut weight = cost + ground.step(edge, at, next);
                if let Some(other) = contours.arriving(far) {
                    weight += ground.turn_weight * ground.turn_deg(next, far, other);
                } else if contours.passes(far) {
                    weight += ground.turn_weight * T_JUNCTION_DEG;
                }
                heap.push(Lightest {
                    weight,
                    what: ((next, far), step),
                });
            }
        }
    };
    push(&mut heap, start, 0.0);
    while let Some(Lightest { weight, what }) = heap.pop() {
        let (step, previous) = what;
        if length_of.contains_key(&step) || step.1 == from {
            continue;
        }
        let length = length_of[&previous] + ground.length(step.0);
        if length > ground.max_gap {
            continue;
        }
        length_of.insert(step, length);
        before.insert(step, previous);
        if contours.passes(step.1) {
            let mut edges = Vec::new();
            let mut at = step;
            while at != start {
                edges.push(at.0);
                at = before[&at];
            }
            edges.reverse();
            return Some(Bridge {
                end,
                cost: weight,
                edges,
            });
        }
        push(&mut heap, step, weight);
    }
    None
}
