//! Creases inside a free form: the borders of its faces, where the triangles and the turn of the surface tell of them.

use std::collections::{BTreeMap, HashMap, HashSet};

use glam::DVec3;
use rayon::prelude::*;
use seamline_mesh::{Sets, Topology};

use crate::chains::Chains;
use crate::crease_angles::CreaseAngles;
use crate::parts::Form;
use crate::pieces::Triangles;

/// A part of fewer faces is left whole.
const FEWEST_FACES: usize = 20;
/// A share of the part's area, and a number of faces, below which a piece of it is no patch.
const LEAST_AREA_SHARE: f64 = 0.02;
const LEAST_FACES: usize = 6;
/// Two pieces whose common border turns by less on average are one; and by less than so many medians.
const BORDER_DEG: f64 = 3.0;
const BORDER_MEDIANS: f64 = 2.0;

/// What sums of lengths round off at most, as a share.
const ROUNDING: f64 = 1e-9;

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
        for (face, piece) in part.pieces(noise) {
            if piece > 0 {
                of_face[face as usize] = next + piece - 1;
            }
        }
        next = of_face.iter().max().map_or(next, |&m| next.max(m + 1));
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

    /// Pieces between the creases, those too alike united.
    fn flood(&self, creased: &HashSet<u32>, though_smooth: &HashSet<u32>) -> Vec<(u32, u32)> {
        let mut faces: Vec<u32> = self.edges.iter().flat_map(|&(_, faces)| faces).collect();
        faces.sort_unstable();
        faces.dedup();
        let row = |face: u32| faces.binary_search(&face).unwrap_or(0) as u32;
        let mut sets = Sets::new(faces.len());
        for &(edge, [a, b]) in self.edges {
            if !creased.contains(&edge) {
                sets.unite(row(a), row(b));
            }
        }
        self.merge(&faces, &mut sets, row, though_smooth);
        let (numbers, _) = sets.numbered();
        faces.into_iter().zip(numbers).collect()
    }

    /// Unites pieces over borders that turn too little, weakest first. Borders `though_smooth` stand.
    fn merge(
        &self,
        faces: &[u32],
        sets: &mut Sets,
        row: impl Fn(u32) -> u32,
        though_smooth: &HashSet<u32>,
    ) {
        let least_turn = BORDER_DEG.max(BORDER_MEDIANS * self.median);
        loop {
            let mut sizes: BTreeMap<u32, (f64, usize)> = BTreeMap::new();
            for (i, &face) in faces.iter().enumerate() {
                let (area, count) = sizes.entry(sets.first(i as u32)).or_default();
                *area += self.triangles.areas[face as usize];
                *count += 1;
            }
            if sizes.len() < 2 {
                return;
            }
            let whole: f64 = sizes.values().map(|(area, _)| area).sum();
            let mut borders: BTreeMap<[u32; 2], (f64, f64)> = BTreeMap::new();
            for &(edge, pair) in self.edges {
                let [a, b] = pair.map(|face| sets.first(row(face)));
                if a != b {
                    let [p, q] = self.topology.edge_vertices[edge as usize]
                        .map(|v| self.positions[v as usize]);
                    let (length, turn) = borders.entry([a.min(b), a.max(b)]).or_default();
                    *length += p.distance(q);
                    let stands = though_smooth.contains(&edge);
                    let least = if stands { least_turn } else { 0.0 };
                    *turn += p.distance(q) * self.turns[&edge].max(least);
                }
            }
            let small = |set: &u32| {
                let (area, count) = sizes[set];
                area < LEAST_AREA_SHARE * whole || count < LEAST_FACES
            };
            let weakest = borders
                .into_iter()
                .map(|(pair, (length, turn))| (pair, turn / length.max(f64::MIN_POSITIVE)))
                .filter(|(pair, turn)| {
                    *turn < (1.0 - ROUNDING) * least_turn || pair.iter().any(small)
                })
                .min_by(|a, b| a.1.total_cmp(&b.1));
            let Some(([a, b], _)) = weakest else {
                return;
            };
            sets.unite(a, b);
        }
    }
}
