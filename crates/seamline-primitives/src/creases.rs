//! Creases inside a free form: the borders of its faces, where the triangles and the turn of the surface tell of them.

use std::collections::{BTreeMap, HashMap, HashSet};

use glam::DVec3;
use rayon::prelude::*;
use seamline_mesh::Topology;

use crate::chains::Chains;
use crate::crease_angles::CreaseAngles;
use crate::parts::Form;
use crate::pieces::Triangles;

/// A part of fewer faces is left whole.
const FEWEST_FACES: usize = 20;

/// Splits free forms along their creases. New parts get numbers after the present ones.
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
    for edges in inner.into_values() {
        if edges.len() < FEWEST_FACES {
            continue;
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
        let median = sorted[sorted.len() / 2];
        let part = Part {
            positions,
            topology,
            triangles,
            edges: &edges,
            turns: &turns,
            median,
        };
        let mut new = 0;
        for (face, piece) in part.pieces(noise) {
            if piece > 0 {
                of_face[face as usize] = next + piece - 1;
                new = new.max(piece);
            }
        }
        next += new;
    }
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
    /// The piece of each face, numbered from 0.
    fn pieces(&self, noise: f64) -> Vec<(u32, u32)> {
        let mut creased = HashSet::new();
        let mut though_smooth = HashSet::new();
        for curve in Chains::of(self.positions, self.topology, self.edges).curves() {
            if curve.though_smooth {
                though_smooth.extend(curve.edges.iter().copied());
            }
            creased.extend(curve.edges);
        }
        if noise > 0.0 {
            creased.extend(self.creased_by_turn());
        }
        if creased.is_empty() {
            return Vec::new();
        }
        self.flood(&creased, &though_smooth)
    }
}
