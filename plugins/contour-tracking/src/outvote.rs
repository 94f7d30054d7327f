//! Labels held against the surfaces the mesh lies on.
//!
//! Where vertices lie on a cylinder to the last bits of a float, a face of it that bears the label of the fillet beside it
//! has gone over, however alike the two are bent. So each surface takes the label that most of it bears, and where two such
//! surfaces meet the boundary between their labels is proved.

use seamline_ecs::LabelledMesh;
use seamline_ecs::components::{FaceLabel, NONE};

use crate::straighten::{is_shared, votes};

/// Labels after surfaces have had their say.
pub struct Outvoted {
    /// One a face.
    pub labels: Vec<FaceLabel>,
    /// The surface that has settled the label of each face, [`NONE`] where none has.
    pub settled_by: Vec<u32>,
    /// Edges between two labels that are where two surfaces meet.
    pub proved: Vec<u32>,
}

/// Gives each surface beside `rough` edges the label that most of it bears; a label that is nowhere else counts up to
/// twice. A surface is parted by somebody's will, and left, where two labels have more than half of all they have, or where
/// two that are at home nowhere share it.
///
/// `surfaces` has one a face, [`NONE`] where there is none, or is empty.
pub fn outvote(mesh: &LabelledMesh<'_>, surfaces: &[u32], rough: &[u32]) -> Outvoted {
    let mut outvoted = Outvoted {
        labels: mesh.labels.to_vec(),
        settled_by: vec![NONE; mesh.labels.len()],
        proved: Vec::new(),
    };
    let Some(&last) = surfaces.iter().filter(|&&surface| surface != NONE).max() else {
        return outvoted;
    };
    let mut is_rough = vec![false; last as usize + 1];
    let pairs = rough
        .iter()
        .filter_map(|&edge| mesh.topology.face_pair(edge as usize));
    for surface in pairs.flatten().map(|face| surfaces[face as usize]) {
        if surface != NONE {
            is_rough[surface as usize] = true;
        }
    }
    let mut winner = winners(mesh, surfaces, last as usize + 1);
    for (winner, is_rough) in winner.iter_mut().zip(is_rough) {
        if !is_rough {
            *winner = NONE;
        }
    }
    let faces = outvoted.labels.iter_mut().zip(&mut outvoted.settled_by);
    for ((label, settled_by), &surface) in faces.zip(surfaces) {
        if surface != NONE && winner[surface as usize] != NONE {
            label.0 = winner[surface as usize];
            *settled_by = surface;
        }
    }
    let parts = |&edge: &u32| {
        mesh.topology.face_pair(edge as usize).is_some_and(|faces| {
            let [a, b] = faces.map(|face| outvoted.settled_by[face as usize]);
            let [label, beyond] = faces.map(|face| outvoted.labels[face as usize]);
            a != NONE && b != NONE && label != beyond
        })
    };
    outvoted.proved = (0..mesh.angles.len() as u32).filter(parts).collect();
    outvoted
}

/// The label of each of so many surfaces, [`NONE`] where somebody has parted one.
fn winners(mesh: &LabelledMesh<'_>, surfaces: &[u32], count: usize) -> Vec<u32> {
    let votes = votes(mesh, surfaces);
    let mut label_areas = vec![0.0; mesh.labels.len()];
    for &(_, label, area) in &votes {
        label_areas[label as usize] += area;
    }
    // Where most of a label is.
    let mut home = vec![NONE; label_areas.len()];
    for &(surface, label, area) in &votes {
        if area > 0.5 * label_areas[label as usize] {
            home[label as usize] = surface;
        }
    }
    let mut faces = vec![0; count];
    for &surface in surfaces.iter().filter(|&&surface| surface != NONE) {
        faces[surface as usize] += 1;
    }
    let mut winner = vec![NONE; count];
    for of_surface in votes.chunk_by(|a, b| a.0 == b.0) {
        let surface = of_surface[0].0;
        if surface == NONE {
            continue;
        }
        let home_of = |vote: &(u32, u32, f64)| home[vote.1 as usize];
        let at_home = of_surface.iter().filter(|vote| home_of(vote) == surface);
        // What is at home elsewhere has only gone over.
        let meant = of_surface
            .iter()
            .filter(|vote| [surface, NONE].contains(&home_of(vote)));
        if at_home.count() > 1 || is_shared(faces[surface as usize], meant.map(|vote| vote.2)) {
            continue;
        }
        let weight = |&(_, label, area): &(u32, u32, f64)| match label_areas[label as usize] {
            0.0 => 0.0,
            whole => area * (1.0 + area / whole),
        };
        let most = of_surface
            .iter()
            .max_by(|a, b| weight(a).total_cmp(&weight(b)).then(b.1.cmp(&a.1)));
        winner[surface as usize] = most.map_or(NONE, |vote| vote.1);
    }
    winner
}
