//! Patches between closed contours.

use seamline_ecs::components::{ContourState, FaceLabel};
use seamline_mesh::{Sets, Topology};

/// Labels faces that hang together without crossing a contour alike, numbered by lowest face. Contour edges
/// with the same patch on both sides are taken off their contour. Gives the number of patches.
pub fn patches(
    topology: &Topology,
    states: &mut [ContourState],
    labels: &mut [FaceLabel],
) -> usize {
    let mut sets = Sets::new(labels.len());
    for (edge, state) in states.iter().enumerate() {
        if *state == ContourState::Off
            && let Some([a, b]) = topology.face_pair(edge)
        {
            sets.unite(a, b);
        }
    }
    let (patch_of, count) = sets.numbered();
    for (label, patch) in labels.iter_mut().zip(patch_of) {
        label.0 = patch;
    }
    for (edge, state) in states.iter_mut().enumerate() {
        if let Some([a, b]) = topology.face_pair(edge)
            && labels[a as usize] == labels[b as usize]
        {
            *state = ContourState::Off;
        }
    }
    count
}
