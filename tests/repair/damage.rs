//! Damage: edges taken away, edges added, boundaries roughened. The same at every run.

use fastrand::Rng;
use seamline_mesh::{Markings, Sets};

use crate::models::Model;

/// True boundary edges that turn by more than this are hard: what a detector by angle would find.
const HARD_DEG: f64 = 25.0;

/// Edges in a run that is taken away as a whole.
const RUN: usize = 8;

/// Chance of a face beside a boundary edge to go over to the other side, each round.
const FLIP: f64 = 0.3;

#[derive(Clone, Copy, Debug)]
pub enum Damage {
    /// Hard edges, of which some percent are taken away one by one.
    Scattered(usize),
    /// The same, in runs.
    Runs(usize),
    /// Hard edges, and so many percent of their number of others.
    False(usize),
    /// True labels, their boundaries roughened so many rings deep.
    Rough(usize),
}

/// What is given to be rectified.
pub struct Damaged {
    pub markings: Markings,
    /// As labels: what is given, or what the edges given part.
    pub labels: Vec<u32>,
    /// F1 of the edges given, whether they enclose anything or not.
    pub edges_f1: f64,
}

impl Damage {
    pub const ALL: [Self; 13] = [
        Self::Scattered(0),
        Self::Scattered(10),
        Self::Scattered(30),
        Self::Scattered(50),
        Self::Runs(10),
        Self::Runs(30),
        Self::Runs(50),
        Self::False(5),
        Self::False(20),
        Self::Rough(0),
        Self::Rough(1),
        Self::Rough(2),
        Self::Rough(4),
    ];

    pub fn name(self) -> String {
        match self {
            Self::Scattered(0) => "hard edges as they are".to_owned(),
            Self::Scattered(percent) => format!("{percent} % of them taken away at random"),
            Self::Runs(percent) => format!("{percent} % taken away in runs of {RUN}"),
            Self::False(percent) => format!("{percent} % false ones added"),
            Self::Rough(0) => "true labels".to_owned(),
            Self::Rough(rings) => format!("roughened, {rings} rings"),
        }
    }

    /// As part of a path.
    pub fn word(self) -> String {
        format!("{self:?}").replace(['(', ')'], "").to_lowercase()
    }

    /// `None` where a model has no hard edges.
    pub fn of(self, model: &Model) -> Option<Damaged> {
        let mut rng = Rng::with_seed(1);
        if let Self::Rough(rings) = self {
            let mut labels = model.truth.clone();
            for _ in 0..rings {
                roughen(model, &mut labels, &mut rng);
            }
            let edges = boundary(model, &labels);
            return Some(Damaged {
                edges_f1: edges_f1(model, &edges),
                markings: Markings::Labels(labels.clone()),
                labels,
            });
        }
        let mut edges = boundary(model, &model.truth);
        edges.retain(|&edge| model.turns[edge] > HARD_DEG);
        if edges.is_empty() {
            return None;
        }
        let gone = |percent: usize| edges.len() * percent / 100;
        match self {
            Self::Scattered(percent) => {
                let keep = edges.len() - gone(percent);
                rng.shuffle(&mut edges);
                edges.truncate(keep);
            }
            Self::Runs(percent) => {
                let count = gone(percent);
                remove_runs(model, &mut edges, count, &mut rng);
            }
            Self::False(percent) => {
                let truth = boundary(model, &model.truth);
                let mut others: Vec<usize> = (0..model.turns.len())
                    .filter(|&edge| model.topology.face_pair(edge).is_some())
                    .filter(|edge| truth.binary_search(edge).is_err())
                    .collect();
                rng.shuffle(&mut others);
                edges.extend(others.into_iter().take(edges.len() * percent / 100));
            }
            Self::Rough(_) => {}
        }
        let pair = |&edge: &usize| model.topology.edge_vertices[edge];
        Some(Damaged {
            edges_f1: edges_f1(model, &edges),
            labels: parted(model, &edges),
            markings: Markings::Edges(edges.iter().map(pair).collect()),
        })
    }
}

fn boundary(model: &Model, labels: &[u32]) -> Vec<usize> {
    let parts = |&edge: &usize| {
        let faces = model.topology.face_pair(edge);
        faces.is_some_and(|[a, b]| labels[a as usize] != labels[b as usize])
    };
    (0..model.turns.len()).filter(parts).collect()
}

fn roughen(model: &Model, labels: &mut [u32], rng: &mut Rng) {
    let before = labels.to_vec();
    for edge in boundary(model, &before) {
        let Some([mut a, mut b]) = model.topology.face_pair(edge) else {
            continue;
        };
        if rng.f64() < FLIP {
            if rng.bool() {
                (a, b) = (b, a);
            }
            labels[a as usize] = before[b as usize];
        }
    }
}

/// Takes runs of connected edges away until `count` are gone.
fn remove_runs(model: &Model, edges: &mut Vec<usize>, count: usize, rng: &mut Rng) {
    let keep = edges.len() - count;
    let mut is_there = vec![false; model.turns.len()];
    edges.iter().for_each(|&edge| is_there[edge] = true);
    let mut left = edges.len();
    while left > keep {
        let mut at = edges[rng.usize(..edges.len())];
        for _ in 0..RUN {
            if left == keep || !is_there[at] {
                break;
            }
            is_there[at] = false;
            left -= 1;
            let ends = model.topology.edge_vertices[at];
            let around = ends
                .iter()
                .flat_map(|&v| model.topology.vertex_edges.row(v as usize));
            match around
                .map(|&edge| edge as usize)
                .find(|&edge| is_there[edge])
            {
                Some(next) => at = next,
                None => break,
            }
        }
    }
    edges.retain(|&edge| is_there[edge]);
}

/// The label of each face where only `edges` part them.
fn parted(model: &Model, edges: &[usize]) -> Vec<u32> {
    let mut parts = vec![false; model.turns.len()];
    edges.iter().for_each(|&edge| parts[edge] = true);
    let mut sets = Sets::new(model.truth.len());
    for (edge, parts) in parts.iter().enumerate() {
        if !parts && let Some([a, b]) = model.topology.face_pair(edge) {
            sets.unite(a, b);
        }
    }
    sets.numbered().0
}

/// Precision and recall of edges by length, as one number.
fn edges_f1(model: &Model, edges: &[usize]) -> f64 {
    let length = |edges: &[usize]| -> f64 {
        let of = |&edge: &usize| {
            let [a, b] =
                model.topology.edge_vertices[edge].map(|v| model.mesh.positions()[v as usize]);
            a.distance(b)
        };
        edges.iter().map(of).sum()
    };
    let truth = boundary(model, &model.truth);
    let both: Vec<usize> = edges
        .iter()
        .copied()
        .filter(|edge| truth.binary_search(edge).is_ok())
        .collect();
    let [both, found, wanted] = [length(&both), length(edges), length(&truth)];
    if found + wanted > 0.0 {
        2.0 * both / (found + wanted)
    } else {
        1.0
    }
}
