//! Creases inside a free form: the borders of its faces, where the triangles and the turn of the surface tell of them.

use std::collections::{BTreeMap, HashMap, HashSet};

use glam::DVec3;
use rayon::prelude::*;
use seamline_mesh::Topology;

use crate::chains::Chains;
use crate::crease_angles::CreaseAngles;
use crate::parts::Form;
use crate::pieces::Triangles;

/// A part of fewer inner edges is left whole.
const FEWEST_EDGES: usize = 20;
/// A ring round a tube turns by so many times what other borders turn by at least: the steps of a tessellation run
/// round tubes in rings, too. With 1 bottles, bulbs and vases come out in bands (ARI .005 less over 229 meshes), with 3
/// spouts and knobs lose borders (.001 less over 161).
const RING_TURNS: f64 = 2.0;

/// Splits free forms along their creases. Pieces of what is cut get numbers after the present ones.
pub(crate) fn split(
    positions: &[DVec3],
    topology: &Topology,
    triangles: &Triangles,
    forms: &[Form],
    noise: f64,
    of_face: &mut [u32],
) {
    let mut inner: BTreeMap<u32, Vec<(u32, [u32; 2])>> = BTreeMap::new();
    for edge in 0..topology.edge_faces.len() {
        if let Some(faces) = topology.face_pair(edge) {
            let [a, b] = faces.map(|f| of_face[f as usize]);
            if a == b && forms[a as usize] == Form::Free {
                inner.entry(a).or_default().push((edge as u32, faces));
            }
        }
    }
    let mut next = forms.len() as u32;
    let seen: &[u32] = of_face;
    let cuts: Vec<Vec<(u32, u32)>> = inner
        .into_par_iter()
        .map(|(_, edges)| cut(positions, topology, triangles, seen, noise, &edges))
        .collect();
    for pieces in cuts {
        let most = pieces.iter().map(|&(_, piece)| piece).max();
        if let Some(most @ 1..) = most {
            for (face, piece) in pieces {
                of_face[face as usize] = next + piece;
            }
            next += most + 1;
        }
    }
}

/// Cuts one free form, of which the inner edges are given: the piece of each face, numbered from 0; none if nothing
/// cuts it.
fn cut(
    positions: &[DVec3],
    topology: &Topology,
    triangles: &Triangles,
    of_face: &[u32],
    noise: f64,
    edges: &[(u32, [u32; 2])],
) -> Vec<(u32, u32)> {
    if edges.len() < FEWEST_EDGES {
        return Vec::new();
    }
    let curves = Chains::of(positions, topology, edges).curves();
    if curves.is_empty() && noise == 0.0 {
        return Vec::new();
    }
    let angles = CreaseAngles {
        positions,
        topology,
        triangles,
        of_face,
    };
    let turns: HashMap<u32, f64> = edges
        .par_iter()
        .map(|&(edge, faces)| (edge, angles.at(edge, faces)))
        .collect();
    let mut sorted: Vec<f64> = turns.values().copied().collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let part = Part {
        positions,
        topology,
        triangles,
        edges,
        turns: &turns,
        median: sorted[sorted.len() / 2],
    };
    let mut creased = HashSet::new();
    let mut though_smooth = HashSet::new();
    for curve in curves {
        if curve.closed && part.mean_turn(&curve.edges) < RING_TURNS * part.least_turn() {
            continue;
        }
        if curve.though_smooth {
            though_smooth.extend(curve.edges.iter().copied());
        }
        creased.extend(curve.edges);
    }
    if noise > 0.0 {
        creased.extend(part.creased_by_turn());
    }
    if creased.is_empty() {
        return Vec::new();
    }
    part.flood(&creased, &though_smooth)
}

/// One free form.
pub(crate) struct Part<'a> {
    pub positions: &'a [DVec3],
    pub topology: &'a Topology,
    pub triangles: &'a Triangles,
    /// Its inner edges, with their faces.
    pub edges: &'a [(u32, [u32; 2])],
    /// Turn of each inner edge in degrees.
    pub turns: &'a HashMap<u32, f64>,
    /// Median turn in degrees.
    pub median: f64,
}

impl Part<'_> {
    /// Mean turn along edges in degrees, by length.
    fn mean_turn(&self, edges: &[u32]) -> f64 {
        let (mut whole, mut turned) = (0.0, 0.0);
        for &edge in edges {
            let [p, q] =
                self.topology.edge_vertices[edge as usize].map(|v| self.positions[v as usize]);
            whole += p.distance(q);
            turned += p.distance(q) * self.turns[&edge];
        }
        turned / f64::max(whole, f64::MIN_POSITIVE)
    }
}
