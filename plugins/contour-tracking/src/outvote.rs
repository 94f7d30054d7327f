//! Labels held against the surfaces the mesh lies on.
//!
//! Where vertices lie on a cylinder to the last bits of a float, a face of it that bears the label of the fillet beside it
//! has gone over, however alike the two are bent. So each surface takes the label that most of it bears, and where two such
//! surfaces meet the boundary between their labels is proved.

use seamline_ecs::LabelledMesh;
use seamline_ecs::components::{FaceLabel, NONE};

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
/// twice. A surface where two labels have more than half of all they have is parted by somebody's will, and left.
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
    for faces in rough
        .iter()
        .filter_map(|&e| mesh.topology.face_pair(e as usize))
    {
        for surface in faces.map(|face| surfaces[face as usize]) {
            if surface != NONE {
                is_rough[surface as usize] = true;
            }
        }
    }
    let mut label_areas = vec![0.0; mesh.labels.len()];
    let mut votes: Vec<(u32, u32, f64)> = Vec::new();
    for ((&surface, label), shape) in surfaces.iter().zip(mesh.labels).zip(mesh.shapes) {
        label_areas[label.0 as usize] += shape.area;
        if surface != NONE && is_rough[surface as usize] {
            votes.push((surface, label.0, shape.area));
        }
    }
    votes.sort_by_key(|&(surface, label, _)| (surface, label));
    votes.dedup_by(|next, sum| {
        let same = (next.0, next.1) == (sum.0, sum.1);
        if same {
            sum.2 += next.2;
        }
        same
    });
    let mut winner = vec![NONE; last as usize + 1];
    for of_surface in votes.chunk_by(|a, b| a.0 == b.0) {
        let share_of_label = |label: u32, area: f64| match label_areas[label as usize] {
            0.0 => 0.0,
            whole => area / whole,
        };
        let at_home = |&&(_, label, area): &&(u32, u32, f64)| share_of_label(label, area) > 0.5;
        if of_surface.iter().filter(at_home).count() > 1 {
            continue;
        }
        let weight =
            |&(_, label, area): &(u32, u32, f64)| area * (1.0 + share_of_label(label, area));
        let most = of_surface
            .iter()
            .max_by(|a, b| weight(a).total_cmp(&weight(b)).then(b.1.cmp(&a.1)));
        winner[of_surface[0].0 as usize] = most.map_or(NONE, |vote| vote.1);
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
