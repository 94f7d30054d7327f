//! Correct boundary edges (paper 5.3.1).

use seamline_ecs::components::{ContourState, FaceLabel, SharpEdge};
use seamline_ecs::{LabelledMesh, boundary};
use seamline_mesh::{Sets, Topology};

use crate::ContourTrackingSettings;
use crate::contours::Ground;
use crate::strokes::strokes;

/// A given edge that turns by more than this is no slip of the hand. Half of what a cylinder of twelve sides turns by.
const TURNS_DEG: f64 = 15.0;

/// Writes the state of every edge: correct, kept or off the contours. Only edges between two labels are
/// looked at.
pub fn mark(
    ground: &Ground<'_>,
    sharp: &[SharpEdge],
    labels: &[FaceLabel],
    settings: &ContourTrackingSettings,
    states: &mut [ContourState],
) {
    let boundary = boundary(ground.topology, labels);
    states.fill(ContourState::Off);
    for &edge in &boundary {
        let by_sharpness = settings.sharp_is_correct && sharp[edge as usize].0;
        if by_sharpness || ground.evidence.score(edge) < settings.correct_below_deg {
            states[edge as usize] = ContourState::Correct;
        }
    }
    if settings.keep_unmarked {
        keep_unmarked(ground.topology, &boundary, states);
    }
}

/// Writes the state of every edge where edges were given: correct or off the contours. Where `doubt` is set, a run
/// between two junctions is not taken, and its edges are given back, if no edge of it is correct by its score or turns by
/// more than 15 degrees, nor closes something as part of a [stroke](strokes) of two edges or more.
pub fn mark_given(
    mesh: &LabelledMesh<'_>,
    ground: &Ground<'_>,
    doubt: bool,
    settings: &ContourTrackingSettings,
    states: &mut [ContourState],
) -> Vec<u32> {
    states.fill(ContourState::Off);
    let given = mesh.given_edges;
    let strokes = strokes(ground, given);
    let has_form = |edge: u32, stroke_edges: u32| {
        let faces = mesh.topology.face_pair(edge as usize);
        // Faces are labelled by what the edges given part, so an edge between two labels is part of a closed contour.
        let closes = faces.is_some_and(|[a, b]| mesh.labels[a as usize] != mesh.labels[b as usize]);
        let edge = edge as usize;
        (closes && stroke_edges > 1)
            || mesh.sharp[edge].0
            || mesh.angles[edge].0.abs() > TURNS_DEG.to_radians()
    };
    let (run_of, run_count) = runs(mesh.topology, given);
    let mut believed = vec![!doubt; run_count];
    for ((&edge, &run), &stroke_edges) in given.iter().zip(&run_of).zip(&strokes) {
        believed[run as usize] |= has_form(edge, stroke_edges);
    }
    for (&edge, &run) in given.iter().zip(&run_of) {
        let believed = &mut believed[run as usize];
        *believed = *believed || ground.evidence.score(edge) < settings.correct_below_deg;
    }
    let mut doubted = Vec::new();
    for (&edge, &run) in given.iter().zip(&run_of) {
        if believed[run as usize] {
            states[edge as usize] = ContourState::Correct;
        } else {
            doubted.push(edge);
        }
    }
    doubted
}

/// Keeps every run of boundary edges between two junctions in which no edge is correct.
fn keep_unmarked(topology: &Topology, boundary: &[u32], states: &mut [ContourState]) {
    let (run_of, run_count) = runs(topology, boundary);
    let mut marked = vec![false; run_count];
    for (&edge, &run) in boundary.iter().zip(&run_of) {
        marked[run as usize] |= states[edge as usize] == ContourState::Correct;
    }
    for (&edge, &run) in boundary.iter().zip(&run_of) {
        if !marked[run as usize] {
            states[edge as usize] = ContourState::Kept;
        }
    }
}

/// The run of each edge, and how many there are: edges that meet where no third one does are of one run.
pub fn runs(topology: &Topology, boundary: &[u32]) -> (Vec<u32>, usize) {
    let vertex_count = topology.vertex_edges.row_count();
    let mut degree = vec![0u32; vertex_count];
    let mut one_of = vec![u32::MAX; vertex_count];
    for &edge in boundary {
        for v in topology.edge_vertices[edge as usize] {
            degree[v as usize] += 1;
        }
    }
    let mut runs = Sets::new(boundary.len());
    for (i, &edge) in boundary.iter().enumerate() {
        for v in topology.edge_vertices[edge as usize].map(|v| v as usize) {
            if degree[v] != 2 {
                continue;
            }
            if one_of[v] == u32::MAX {
                one_of[v] = i as u32;
            } else {
                runs.unite(one_of[v], i as u32);
            }
        }
    }
    runs.numbered()
}
