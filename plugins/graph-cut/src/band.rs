//! Bands along boundaries, and the cut through each.

use std::collections::VecDeque;

use seamline_ecs::components::{FaceLabel, NONE};
use seamline_mesh::{Sets, Topology};

use crate::max_flow::Flow;

/// What cutting anew has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Recut {
    /// Changes of a face from one patch to another.
    pub moved: usize,
    /// Patches there are.
    pub patches: usize,
}

/// Decides the faces in a band of so many rings on either side of each boundary anew. `costs` is what each edge
/// costs as a boundary; of cuts that cost the same, that is taken which keeps most of the edges there are.
/// Connected faces of equal label are one patch, before and after; patches are numbered by lowest face.
///
/// Pairs of patches are taken by their numbers, each with the labels the ones before have left.
pub fn recut(
    topology: &Topology,
    costs: &[u64],
    band_rings: u32,
    labels: &mut [FaceLabel],
) -> Recut {
    let patches = number_patches(topology, labels);
    let moved = cut_all(topology, costs, band_rings, labels, patches);
    Recut {
        moved,
        patches: number_patches(topology, labels),
    }
}

/// Labels connected faces of equal label alike, numbered by lowest face.
fn number_patches(topology: &Topology, labels: &mut [FaceLabel]) -> usize {
    let mut sets = Sets::new(labels.len());
    for edge in 0..topology.edge_faces.len() {
        if let Some([a, b]) = topology.face_pair(edge)
            && labels[a as usize] == labels[b as usize]
        {
            sets.unite(a, b);
        }
    }
    let (patch_of, count) = sets.numbered();
    for (label, patch) in labels.iter_mut().zip(patch_of) {
        label.0 = patch;
    }
    count
}

fn cut_all(
    topology: &Topology,
    costs: &[u64],
    band_rings: u32,
    labels: &mut [FaceLabel],
    patches: usize,
) -> usize {
    let depths = depths(topology, labels);
    let mut deepest = vec![0; patches];
    for (label, &depth) in labels.iter().zip(&depths) {
        let deepest = &mut deepest[label.0 as usize];
        *deepest = depth.max(*deepest);
    }
    // The outer half at most: a patch one face deep has nothing to give.
    let gives: Vec<u32> = deepest
        .iter()
        .map(|&deepest| band_rings.min(deepest.div_ceil(2)))
        .collect();
    let may_move: Vec<bool> = labels
        .iter()
        .zip(&depths)
        .map(|(label, &depth)| depth < gives[label.0 as usize])
        .collect();

    let mut pairs: Vec<([u32; 2], u32)> = (0..topology.edge_faces.len())
        .filter_map(|edge| {
            let [a, b] = topology.face_pair(edge)?.map(|f| labels[f as usize].0);
            (a != b).then_some(([a.min(b), a.max(b)], edge as u32))
        })
        .collect();
    pairs.sort_unstable();
    let mut cut = Cut {
        topology,
        costs,
        may_move: &may_move,
        band_rings,
        node_of: vec![NONE; labels.len()],
    };
    pairs
        .chunk_by(|a, b| a.0 == b.0)
        .map(|boundary| cut.between(boundary, labels))
        .sum()
}

/// How many faces lie between each face and the nearest boundary of its patch: 0 beside it.
fn depths(topology: &Topology, labels: &[FaceLabel]) -> Vec<u32> {
    let mut depths = vec![NONE; labels.len()];
    let mut queue = VecDeque::new();
    for edge in 0..topology.edge_faces.len() {
        let Some(faces) = topology.face_pair(edge) else {
            continue;
        };
        if labels[faces[0] as usize] != labels[faces[1] as usize] {
            for face in faces {
                if std::mem::replace(&mut depths[face as usize], 0) == NONE {
                    queue.push_back(face);
                }
            }
        }
    }
    while let Some(face) = queue.pop_front() {
        for &edge in &topology.face_edges[face as usize] {
            if let Some(next) = topology.neighbour(face, edge)
                && depths[next as usize] == NONE
            {
                depths[next as usize] = depths[face as usize] + 1;
                queue.push_back(next);
            }
        }
    }
    // A patch without a boundary has no band.
    depths.iter_mut().for_each(|depth| {
        if *depth == NONE {
            *depth = 0;
        }
    });
    depths
}

/// More than the edges of one boundary: that many kept edges weigh less than one step of cost.
const KEPT_EDGES: u64 = 1 << 20;

struct Cut<'a> {
    topology: &'a Topology,
    costs: &'a [u64],
    may_move: &'a [bool],
    band_rings: u32,
    /// The node of each face of the band; [`NONE`] outside of it.
    node_of: Vec<u32>,
}

impl Cut<'_> {
    /// Cuts the band between two patches anew. `boundary` is the edges they had in common. Gives how many faces
    /// have changed sides.
    fn between(&mut self, boundary: &[([u32; 2], u32)], labels: &mut [FaceLabel]) -> usize {
        let sides = boundary[0].0;
        let band = self.band(boundary, labels);
        let mut flow = Flow::new(band.len());
        let mut ends = [false; 2];
        for &face in &band {
            let node = self.node_of[face as usize];
            for &edge in &self.topology.face_edges[face as usize] {
                let Some(next) = self.topology.neighbour(face, edge) else {
                    continue;
                };
                let is_boundary = labels[face as usize] != labels[next as usize];
                let cost = self.costs[edge as usize] * KEPT_EDGES + u64::from(!is_boundary);
                let other = self.node_of[next as usize];
                if other != NONE {
                    if node < other {
                        flow.join(node, other, cost);
                    }
                } else if labels[next as usize].0 == sides[0] {
                    flow.from_source(node, cost);
                    ends[0] = true;
                } else if labels[next as usize].0 == sides[1] {
                    flow.to_sink(node, cost);
                    ends[1] = true;
                }
            }
        }
        let mut moved = 0;
        // Where one side has nothing but band here, there is nothing to cut it from.
        if ends == [true; 2] {
            flow.run();
            let on_source_side = flow.on_source_side();
            for &face in &band {
                let node = self.node_of[face as usize] as usize;
                let side = sides[usize::from(!on_source_side[node])];
                moved += usize::from(labels[face as usize].0 != side);
                labels[face as usize].0 = side;
            }
        }
        for face in band {
            self.node_of[face as usize] = NONE;
        }
        moved
    }

    /// The faces of both sides that may move and lie within the band of their common boundary, each with its
    /// node.
    fn band(&mut self, boundary: &[([u32; 2], u32)], labels: &[FaceLabel]) -> Vec<u32> {
        let sides = boundary[0].0;
        let mut band: Vec<u32> = Vec::new();
        let node_of = &mut self.node_of;
        let mut take = |face: u32, band: &mut Vec<u32>| {
            let at = face as usize;
            if self.may_move[at] && node_of[at] == NONE && sides.contains(&labels[at].0) {
                node_of[at] = band.len() as u32 + 2;
                band.push(face);
            }
        };
        for &(_, edge) in boundary {
            let faces = self.topology.face_pair(edge as usize);
            for face in faces.into_iter().flatten() {
                take(face, &mut band);
            }
        }
        let mut ring = 0..band.len();
        for _ in 1..self.band_rings {
            for at in ring.clone() {
                let face = band[at];
                for &edge in &self.topology.face_edges[face as usize] {
                    if let Some(next) = self.topology.neighbour(face, edge) {
                        take(next, &mut band);
                    }
                }
            }
            ring = ring.end..band.len();
        }
        band
    }
}
