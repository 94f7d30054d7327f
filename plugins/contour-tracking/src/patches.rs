//! Patches between closed contours.

use seamline_ecs::components::{ContourState, FaceLabel};
use seamline_mesh::{Sets, Topology};

/// Labels faces that hang together without crossing a contour alike, numbered by lowest face. Contour edges
/// with the same patch on both sides are taken off their contour; with `keep_creases` those of them that were not
/// tracked become creases. Gives the number of patches.
pub fn patches(
    topology: &Topology,
    keep_creases: bool,
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
            *state = match *state {
                ContourState::Correct | ContourState::Kept if keep_creases => ContourState::Crease,
                _ => ContourState::Off,
            };
        }
    }
    count
}
