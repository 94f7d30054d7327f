//! What rectifying has changed: edges, lengths and turns of boundaries before and after.

use std::collections::BTreeMap;

use glam::DVec3;
use seamline_ecs::components::ContourState;
use seamline_ecs::results::{BoundaryMeasure, Changes, EdgeChanges, OpenEndReport};
use seamline_ecs::{EndFate, boundary};
use seamline_mesh::Topology;

use crate::boundaries::chains;
use crate::export::{Given, LabelledRows};

/// A turn above this many degrees counts as sharp: one of a zigzag, or a corner.
const SHARP_TURN_DEG: f64 = 45.0;

/// The boundaries that were given held against those between the labels.
pub(crate) fn changes(rows: &LabelledRows, given: Given) -> Changes {
    let Given {
        edges: before,
        contours,
        open_ends: ends,
        at_borders,
        ..
    } = given;
    let after = boundary(rows.bending.topology, rows.labels);
    let in_state = |state: ContourState| -> Vec<u32> {
        let is_so = |edge: &u32| contours[*edge as usize] == state;
        before.iter().copied().filter(is_so).collect()
    };
    let creases = in_state(ContourState::Crease);
    let not_among = |edges: &[u32], among: &[u32]| -> Vec<u32> {
        let absent = |edge: &u32| among.binary_search(edge).is_err();
        edges.iter().copied().filter(absent).collect()
    };
    let added = not_among(&after, before);
    let gone = not_among(&not_among(before, &after), &creases);
    let curves = |edges: &[u32]| {
        let ends: Vec<[u32; 2]> = edges.iter().map(|&edge| mesh_edge(rows, edge)).collect();
        chains(&ends)
    };
    let measured = |edges: &[u32]| {
        let topology = rows.bending.topology;
        let ends: Vec<[u32; 2]> = edges
            .iter()
            .map(|&edge| topology.edge_vertices[edge as usize])
            .collect();
        let at = |row: u32| rows.bending.positions[row as usize].0;
        measure(topology, &ends, at, rows.length)
    };
    let count = |fate| ends.iter().filter(|end| end.fate == fate).count();
    let mut open_ends: Vec<OpenEndReport> = ends
        .iter()
        .map(|end| OpenEndReport {
            vertex: rows.order.vertex_of_row[end.vertex as usize],
            fate: end.fate,
            edges: end.edges,
            length: end.length * rows.length,
        })
        .collect();
    open_ends.sort_by_key(|end| end.vertex);
    Changes {
        open_ends_closed: count(EndFate::Closed) + count(EndFate::Met),
        open_ends_left: count(EndFate::Left),
        open_ends,
        edges: EdgeChanges {
            given: before.len(),
            kept: after.len() - added.len(),
            added: added.len(),
            removed: gone.len(),
            doubted: in_state(ContourState::Doubted).len(),
            creases: creases.len(),
            at_borders,
        },
        before: measured(before),
        after: measured(&after),
        removed_curves: curves(&gone),
        crease_curves: curves(&creases),
    }
}

/// The ends of an edge as vertices of the mesh.
pub(crate) fn mesh_edge(rows: &LabelledRows, edge: u32) -> [u32; 2] {
    rows.bending.topology.edge_vertices[edge as usize]
        .map(|row| rows.order.vertex_of_row[row as usize])
}

/// Length of some edges together, given by their ends, and how they turn where two of them meet and no more.
pub(crate) fn measure(
    topology: &Topology,
    edges: &[[u32; 2]],
    at: impl Fn(u32) -> DVec3,
    unit_length: f64,
) -> BoundaryMeasure {
    let is_closed_by_mesh = |vertex: u32| {
        let mut around = topology.vertex_edges.row(vertex as usize).iter();
        around.any(|&edge| topology.face_pair(edge as usize).is_none())
    };
    let mut leaving: BTreeMap<u32, Vec<DVec3>> = BTreeMap::new();
    let mut length = 0.0;
    for &[from, to] in edges {
        let along = at(to) - at(from);
        length += along.length();
        leaving.entry(from).or_default().push(along);
        leaving.entry(to).or_default().push(-along);
    }
    let turns: Vec<f64> = leaving
        .values()
        .filter_map(|leaving| match leaving[..] {
            [a, b] => Some((-a).angle_between(b).to_degrees()),
            _ => None,
        })
        .collect();
    let sharp = turns.iter().filter(|turn| **turn > SHARP_TURN_DEG).count();
    let many = turns.len().max(1) as f64;
    BoundaryMeasure {
        edges: edges.len(),
        length: length * unit_length,
        mean_turn_deg: turns.iter().sum::<f64>() / many,
        sharp_turn_share: sharp as f64 / many,
        open_ends: leaving
            .iter()
            .filter(|(vertex, leaving)| leaving.len() == 1 && !is_closed_by_mesh(**vertex))
            .count(),
    }
}
