//! Contour tracking (paper 5.3.2).

use std::collections::BinaryHeap;

use seamline_ecs::components::ContourState;
use seamline_ecs::{EndFate, OpenEnd};

use crate::contours::{Contours, Ground, Lightest};

/// Continues every contour from its open ends until it meets a contour, adding the edge of least weight first
/// ([`Ground::turn_weight`]). Gives what became of each end, by vertex.
///
/// Contours are the edges not off, the borders of the mesh and its non-manifold edges. An open end is a
/// vertex with one contour edge. Each step uses up a vertex or closes an end, so there are at most as many
/// steps as vertices. A walk that would get longer than [`Ground::max_gap`] is given up, and what it has added stays
/// for who may run into it.
pub fn track(ground: Ground<'_>, states: &mut [ContourState]) -> Vec<OpenEnd> {
    let mut contours = Contours::of(ground, states);
    let mut ends = contours.open_ends();
    let mut tips: Vec<u32> = ends.iter().map(|end| end.vertex).collect();
    let mut heap = BinaryHeap::new();
    for (walk, end) in ends.iter().enumerate() {
        push_edges_at(&contours, end.vertex, walk, &mut heap);
    }
    while let Some(Lightest { what, .. }) = heap.pop() {
        let (edge, end, walk) = what;
        if !contours.is_open(end) {
            continue;
        }
        let walked = &mut ends[walk];
        let length = ground.length(edge);
        if walked.length + length > ground.max_gap {
            continue;
        }
        walked.edges += 1;
        walked.length += length;
        let far = ground.topology.far_end(edge, end);
        tips[walk] = far;
        if contours.add(edge, end) {
            walked.fate = EndFate::Closed;
        } else {
            push_edges_at(&contours, far, walk, &mut heap);
        }
    }
    for (end, tip) in ends.iter_mut().zip(tips) {
        if end.fate == EndFate::Left && !contours.is_open(tip) {
            end.fate = EndFate::Met;
        }
    }
    ends
}

type Step = (u32, u32, usize);

fn push_edges_at(
    contours: &Contours<'_>,
    end: u32,
    walk: usize,
    heap: &mut BinaryHeap<Lightest<Step>>,
) {
    let Some(arriving) = contours.arriving(end) else {
        return;
    };
    for &edge in contours.ground.edges_at(end) {
        if !contours.has(edge) {
            let weight = contours.ground.step(arriving, end, edge);
            let what = (edge, end, walk);
            heap.push(Lightest { weight, what });
        }
    }
}
