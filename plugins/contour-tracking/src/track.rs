//! Contour tracking (paper 5.3.2).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;
use seamline_ecs::components::{BoundaryScore, ContourState, Position};
use seamline_mesh::{EdgeKind, Topology};

/// What tracking did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tracked {
    /// Open ends there were.
    pub open_ends: usize,
    /// Edges added to close them.
    pub steps: usize,
}

/// An edge that may continue a contour from its open end, lightest first; of equals, the lower edge.
struct PotentialEdge {
    weight: f64,
    edge: u32,
    end: u32,
}

impl Ord for PotentialEdge {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = self.weight.total_cmp(&other.weight);
        order
            .then(self.edge.cmp(&other.edge))
            .then(self.end.cmp(&other.end))
            .reverse()
    }
}

impl PartialOrd for PotentialEdge {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for PotentialEdge {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for PotentialEdge {}

/// Continues every contour from its open ends until it meets a contour, adding the edge of least weight
/// `P = S + turn_weight * turn` first, with the turn in degrees, straight on being 0.
///
/// Contours are the edges not off, the borders of the mesh and its non-manifold edges. An open end is a
/// vertex with one contour edge. Each step uses up a vertex or closes an end, so there are at most as many
/// steps as vertices.
pub fn track(
    topology: &Topology,
    positions: &[Position],
    scores: &[BoundaryScore],
    turn_weight: f64,
    states: &mut [ContourState],
) -> Tracked {
    let mut contours = Contours::of(topology, positions, scores, turn_weight, states);
    let open: Vec<u32> = (0..topology.vertex_edges.row_count() as u32)
        .filter(|&v| contours.is_open(v))
        .collect();
    for &end in &open {
        contours.push_edges_at(end);
    }
    let mut steps = 0;
    while let Some(PotentialEdge { edge, end, .. }) = contours.heap.pop() {
        if contours.is_open(end) {
            contours.add(edge, end);
            steps += 1;
        }
    }
    Tracked {
        open_ends: open.len(),
        steps,
    }
}

struct Contours<'a> {
    topology: &'a Topology,
    positions: &'a [Position],
    scores: &'a [BoundaryScore],
    turn_weight: f64,
    states: &'a mut [ContourState],
    /// Contour edges at each vertex.
    degree: Vec<u32>,
    heap: BinaryHeap<PotentialEdge>,
}

impl<'a> Contours<'a> {
    fn of(
        topology: &'a Topology,
        positions: &'a [Position],
        scores: &'a [BoundaryScore],
        turn_weight: f64,
        states: &'a mut [ContourState],
    ) -> Self {
        let degree = vec![0; topology.vertex_edges.row_count()];
        let heap = BinaryHeap::new();
        let mut contours = Self {
            topology,
            positions,
            scores,
            turn_weight,
            states,
            degree,
            heap,
        };
        for edge in 0..contours.states.len() as u32 {
            if contours.on_contour(edge) {
                for v in topology.edge_vertices[edge as usize] {
                    contours.degree[v as usize] += 1;
                }
            }
        }
        contours
    }

    fn on_contour(&self, edge: u32) -> bool {
        let kind = self.topology.edge_kind[edge as usize];
        self.states[edge as usize] != ContourState::Off
            || matches!(kind, EdgeKind::Border | EdgeKind::NonManifold)
    }

    /// The one contour edge of an open end. Mesh borders and non-manifold edges end where they end.
    fn arriving(&self, vertex: u32) -> Option<u32> {
        if self.degree[vertex as usize] != 1 {
            return None;
        }
        let around = self.topology.vertex_edges.row(vertex as usize).iter();
        around
            .copied()
            .find(|&edge| self.states[edge as usize] != ContourState::Off)
    }

    fn is_open(&self, vertex: u32) -> bool {
        self.arriving(vertex).is_some()
    }

    fn push_edges_at(&mut self, end: u32) {
        let Some(arriving) = self.arriving(end) else {
            return;
        };
        let from = self.topology.far_end(arriving, end);
        let heading = self.at(end) - self.at(from);
        for &edge in self.topology.vertex_edges.row(end as usize) {
            if self.on_contour(edge) {
                continue;
            }
            let leaving = self.at(self.topology.far_end(edge, end)) - self.at(end);
            let turn = heading
                .cross(leaving)
                .length()
                .atan2(heading.dot(leaving))
                .to_degrees();
            let weight = self.scores[edge as usize].0 + self.turn_weight * turn;
            self.heap.push(PotentialEdge { weight, edge, end });
        }
    }

    fn add(&mut self, edge: u32, end: u32) {
        let far = self.topology.far_end(edge, end);
        let meets_contour = self.degree[far as usize] > 0;
        self.states[edge as usize] = ContourState::Tracked;
        self.degree[end as usize] += 1;
        self.degree[far as usize] += 1;
        if !meets_contour {
            self.push_edges_at(far);
        }
    }

    fn at(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize].0
    }
}
