//! Creases inside a free form: the borders of its faces, where the triangles and the turn of the surface tell of them.

use std::collections::BTreeMap;

use foldhash::{HashMap, HashSet};
use rayon::prelude::*;

use crate::chains::{Chains, Counts};
use crate::crease_angles::CreaseAngles;
use crate::few::a_few;
use crate::ground::Ground;
use crate::parts::Form;

/// A part of fewer inner edges is left whole.
const FEWEST_EDGES: usize = 20;
/// A ring round a tube turns by so many times what other borders turn by at least: the steps of a tessellation run
/// round tubes in rings, too. With 1 a bell comes out in bands (ARI .001 less over 132 meshes), with 2 the grooves of a
/// pulley are lost (.0003 less over 132).
const RING_TURNS: f64 = 1.5;
/// Most edges whose turn the median is taken of.
const MOST_FOR_MEDIAN: usize = 1000;

/// Splits free forms along their creases. Pieces of what is cut get numbers after the present ones.
pub(crate) fn split(ground: Ground, forms: &[Form], of_face: &mut [u32]) {
    let topology = ground.topology;
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
        .map(|(_, edges)| cut(ground, seen, &edges))
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
fn cut(ground: Ground, of_face: &[u32], edges: &[(u32, [u32; 2])]) -> Vec<(u32, u32)> {
    if edges.len() < FEWEST_EDGES {
        return Vec::new();
    }
    let curves = Chains::of(ground.positions, ground.topology, edges).curves();
    if curves.is_empty() && ground.noise == 0.0 {
        return Vec::new();
    }
    let angles = CreaseAngles { ground, of_face };
    let turn = |&(edge, faces): &(u32, [u32; 2])| (edge, angles.at(edge, faces));
    // Creases are sought among all edges only where curves do not tell of them.
    let on_curves: HashSet<u32> = curves.iter().flat_map(|c| &c.edges).copied().collect();
    let asked = |&&(edge, _): &&(u32, _)| ground.noise > 0.0 || on_curves.contains(&edge);
    let turns: HashMap<u32, f64> = edges.par_iter().filter(asked).map(turn).collect();
    let some: Vec<(u32, [u32; 2])> = a_few(edges, MOST_FOR_MEDIAN).copied().collect();
    let mut some: Vec<f64> = some.par_iter().map(turn).map(|(_, turn)| turn).collect();
    some.sort_unstable_by(f64::total_cmp);
    let part = Part {
        ground,
        edges,
        turns: &turns,
        median: some[some.len() / 2],
    };
    let mut creased = HashSet::default();
    let mut though_smooth = HashSet::default();
    for curve in curves {
        match curve.counts {
            Counts::IfItTurns => {}
            Counts::ThoughSmooth => though_smooth.extend(curve.edges.iter().copied()),
            Counts::IfItTurnsMuch => {
                if part.mean_turn(&curve.edges) < RING_TURNS * part.least_turn() {
                    continue;
                }
            }
        }
        creased.extend(curve.edges);
    }
    if ground.noise > 0.0 {
        creased.extend(part.creased_by_turn());
    }
    if creased.is_empty() {
        return Vec::new();
    }
    part.flood(&creased, &though_smooth)
}

/// One free form.
pub(crate) struct Part<'a> {
    pub ground: Ground<'a>,
    /// Its inner edges, with their faces.
    pub edges: &'a [(u32, [u32; 2])],
    /// Turn in degrees of each inner edge that may be a crease.
    pub turns: &'a HashMap<u32, f64>,
    /// Median turn in degrees.
    pub median: f64,
}

impl Part<'_> {
    /// Mean turn along edges in degrees, by length.
    fn mean_turn(&self, edges: &[u32]) -> f64 {
        let (mut whole, mut turned) = (0.0, 0.0);
        for &edge in edges {
            let length = self.ground.edge_length(edge);
            whole += length;
            turned += length * self.turns[&edge];
        }
        turned / f64::max(whole, f64::MIN_POSITIVE)
    }
}
