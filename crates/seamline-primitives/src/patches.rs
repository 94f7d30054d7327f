//! Patches: which faces are together, and on which surface.

use glam::DVec3;
use seamline_mesh::{Sets, Topology};

use crate::Fitted;
use crate::few::a_few;

/// Most vertices of a patch that are looked at where all would tell no more.
pub(crate) const MOST_POINTS: usize = 400;

/// Patches, one number a face, and the surface of each.
pub(crate) struct Patches {
    pub of_face: Vec<u32>,
    pub surfaces: Vec<Option<Fitted>>,
}

impl Patches {
    /// Distinct vertices of each patch.
    pub fn vertices(&self, topology: &Topology) -> Vec<Vec<u32>> {
        let mut vertices: Vec<Vec<u32>> = vec![Vec::new(); self.surfaces.len()];
        for (face, &patch) in self.of_face.iter().enumerate() {
            vertices[patch as usize].extend(topology.triangles[face]);
        }
        for all in &mut vertices {
            all.sort_unstable();
            all.dedup();
        }
        vertices
    }

    /// Positions of the same, a few of many, from all over each patch.
    pub fn points(&self, positions: &[DVec3], topology: &Topology) -> Vec<Vec<DVec3>> {
        let at = |all: &Vec<u32>| {
            a_few(all, MOST_POINTS)
                .map(|&v| positions[v as usize])
                .collect()
        };
        self.vertices(topology).iter().map(at).collect()
    }

    /// The same with a number for each connected part of a patch.
    pub fn connected(self, topology: &Topology) -> Self {
        let (of_face, patch_of) = connected(topology, &self.of_face);
        let surfaces = patch_of
            .iter()
            .map(|&p| self.surfaces[p as usize])
            .collect();
        Self { of_face, surfaces }
    }
}

/// A number for each connected set of faces of one part, and the part of each number.
pub(crate) fn connected(topology: &Topology, parts: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut sets = Sets::new(parts.len());
    for edge in 0..topology.edge_faces.len() {
        if let Some([a, b]) = topology.face_pair(edge)
            && parts[a as usize] == parts[b as usize]
        {
            sets.unite(a, b);
        }
    }
    let (of_face, count) = sets.numbered();
    let mut part_of = vec![0; count];
    for (&patch, &part) in of_face.iter().zip(parts) {
        part_of[patch as usize] = part;
    }
    (of_face, part_of)
}
