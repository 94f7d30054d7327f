//! Contours while they are being closed: which edges are on one, and where one ends.

use glam::DVec3;
use seamline_ecs::components::{ContourState, Position};
use seamline_ecs::{EndFate, Evidence, OpenEnd};
use seamline_mesh::{EdgeKind, Topology};

/// What contours run over, and what a step costs there.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    /// Edges and neighbours.
    pub topology: &'a Topology,
    /// One a vertex.
    pub positions: &'a [Position],
    /// Asked for as steps are weighed.
    pub evidence: &'a dyn Evidence,
    /// Weight of the turn against the score: `omega_theta` of the paper.
    pub turn_weight: f64,
    /// The longest piece that is added to close one open end.
    pub max_gap: f64,
}

impl Ground<'_> {
    /// What going on from `arriving` by `edge` costs, at the vertex between the two: `P = S + turn_weight * turn`
    /// of the paper, in degrees.
    pub(crate) fn step(&self, arriving: u32, at: u32, edge: u32) -> f64 {
        self.evidence.score(edge) + self.turn_weight * self.turn_deg(arriving, at, edge)
    }

    /// The turn from one edge into another at the vertex between them; straight on is 0.
    pub(crate) fn turn_deg(&self, arriving: u32, at: u32, leaving: u32) -> f64 {
        let from = self.topology.far_end(arriving, at);
        let to = self.topology.far_end(leaving, at);
        let heading = self.at(at) - self.at(from);
        let going = self.at(to) - self.at(at);
        heading
            .cross(going)
            .length()
            .atan2(heading.dot(going))
            .to_degrees()
    }

    pub(crate) fn length(&self, edge: u32) -> f64 {
        let [a, b] = self.topology.edge_vertices[edge as usize];
        self.at(a).distance(self.at(b))
    }

    pub(crate) fn edges_at(&self, vertex: u32) -> &[u32] {
        self.topology.vertex_edges.row(vertex as usize)
    }

    fn at(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize].0
    }
}

/// The edges on contours: those that are not off, the borders of the mesh and its non-manifold edges.
pub(crate) struct Contours<'a> {
    pub ground: Ground<'a>,
    states: &'a mut [ContourState],
    /// Contour edges at each vertex.
    degree: Vec<u32>,
}

impl<'a> Contours<'a> {
    pub(crate) fn of(ground: Ground<'a>, states: &'a mut [ContourState]) -> Self {
        let degree = vec![0; ground.topology.vertex_edges.row_count()];
        let mut contours = Self {
            ground,
            states,
            degree,
        };
        for edge in 0..contours.states.len() as u32 {
            if contours.has(edge) {
                for v in ground.topology.edge_vertices[edge as usize] {
                    contours.degree[v as usize] += 1;
                }
            }
        }
        contours
    }

    /// Is an edge on a contour?
    pub(crate) fn has(&self, edge: u32) -> bool {
        let kind = self.ground.topology.edge_kind[edge as usize];
        self.states[edge as usize] != ContourState::Off
            || matches!(kind, EdgeKind::Border | EdgeKind::NonManifold)
    }

    /// Does a contour go through a vertex, or end there?
    pub(crate) fn passes(&self, vertex: u32) -> bool {
        self.degree[vertex as usize] > 0
    }

    /// The one contour edge of an open end. Mesh borders and non-manifold edges end where they end.
    pub(crate) fn arriving(&self, vertex: u32) -> Option<u32> {
        if self.degree[vertex as usize] != 1 {
            return None;
        }
        let mut around = self.ground.edges_at(vertex).iter().copied();
        around.find(|&edge| self.states[edge as usize] != ContourState::Off)
    }

    pub(crate) fn is_open(&self, vertex: u32) -> bool {
        self.arriving(vertex).is_some()
    }

    /// All open ends, by vertex, with nothing done for them yet.
    pub(crate) fn open_ends(&self) -> Vec<OpenEnd> {
        let vertices = 0..self.degree.len() as u32;
        let open = vertices.filter(|&v| self.is_open(v));
        open.map(|vertex| OpenEnd {
            vertex,
            fate: EndFate::Left,
            edges: 0,
            length: 0.0,
        })
        .collect()
    }

    /// Adds an edge. True if it ends at a contour.
    pub(crate) fn add(&mut self, edge: u32, from: u32) -> bool {
        let far = self.ground.topology.far_end(edge, from);
        let meets = self.passes(far);
        self.states[edge as usize] = ContourState::Tracked;
        self.degree[from as usize] += 1;
        self.degree[far as usize] += 1;
        meets
    }
}

/// Something of least weight first; of equals, that of the lower number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lightest<T> {
    pub weight: f64,
    pub what: T,
}

impl<T: Ord> Ord for Lightest<T> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let order = self.weight.total_cmp(&other.weight);
        order.then_with(|| self.what.cmp(&other.what)).reverse()
    }
}

impl<T: Ord> PartialOrd for Lightest<T> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl<T: Ord> PartialEq for Lightest<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<T: Ord> Eq for Lightest<T> {}
