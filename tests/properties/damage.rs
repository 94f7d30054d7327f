//! Meshes with holes, doubled, turned and torn faces are cut all the same: every face of the file is in a patch.

use std::sync::Arc;

use proptest::prelude::*;
use seamline_ecs::Worker;
use seamline_mesh::{PolygonMesh, weld};
use seamline_tests::pipeline;

use crate::drawn::{Drawn, cases, shape};

const SETTINGS: [&[&str]; 4] = [
    &["pipeline.profile=cad"],
    &["pipeline.profile=cad", "pipeline.rectifier=none"],
    &["pipeline.profile=lavoue2005"],
    &[
        "pipeline.profile=lavoue2005",
        "curvature.tensor=ball",
        "curvature.ball_radius=0.1",
    ],
];

/// What may happen to a face.
#[derive(Clone, Copy, Debug)]
enum Damage {
    Lost,
    Twice,
    TurnedOver,
    /// One corner is where the one before it is.
    Collapsed,
    /// One corner is another vertex of the mesh, by its share of all numbers.
    Torn(f64),
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        Just(Damage::Lost),
        Just(Damage::Twice),
        Just(Damage::TurnedOver),
        Just(Damage::Collapsed),
        (0.0..1.0).prop_map(Damage::Torn),
    ]
}

/// A shape and what happens to which of its faces, each by its share of all numbers.
fn damaged_shape() -> impl Strategy<Value = (Drawn, Vec<(f64, Damage)>)> {
    (shape(), prop::collection::vec((0.0..1.0, damage()), 0..60))
}

fn damaged(drawn: &Drawn, damages: &[(f64, Damage)]) -> PolygonMesh {
    let whole = weld(drawn.shape.polygons(), 0.0).polygons;
    let vertices = whole.positions.len() as f64;
    let mut faces: Vec<Vec<u32>> = (0..whole.face_count())
        .map(|f| whole.face(f).to_vec())
        .collect();
    for &(share, damage) in damages {
        let at = (share * faces.len() as f64) as usize;
        match damage {
            // One face is left, so that there is something to cut.
            Damage::Lost if faces.len() > 1 => drop(faces.swap_remove(at)),
            Damage::Lost => {}
            Damage::Twice => faces.push(faces[at].clone()),
            Damage::TurnedOver => faces[at].reverse(),
            Damage::Collapsed => faces[at][1] = faces[at][0],
            Damage::Torn(vertex) => faces[at][0] = (vertex * vertices) as u32,
        }
    }
    let mut starts = vec![0];
    for face in &faces {
        starts.push(starts[starts.len() - 1] + face.len() as u32);
    }
    PolygonMesh {
        starts,
        corners: faces.concat(),
        ..whole
    }
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn every_face_of_a_damaged_mesh_is_in_a_patch_and_patches_are_numbered_by_first_face(
        (drawn, damages) in damaged_shape(), settings in prop::sample::select(&SETTINGS[..]),
    ) {
        let mesh = Arc::new(weld(damaged(&drawn, &damages), 0.0));
        let cut = match Worker::new(pipeline(settings)).segment(Arc::clone(&mesh)) {
            Ok(cut) => cut,
            // So little may be left that there is nothing to cut.
            Err(error) => {
                prop_assert_eq!(error.message, "no face has an area");
                return Ok(());
            }
        };
        prop_assert_eq!(cut.face_patches.len(), mesh.polygons.face_count());
        let mut known = 0;
        for &patch in &cut.face_patches {
            prop_assert!(patch <= known, "patch {patch} comes before patch {known}");
            known = known.max(patch + 1);
        }
        prop_assert_eq!(known as usize, cut.patches.len());

        for (id, patch) in cut.patches.iter().enumerate() {
            prop_assert_eq!(patch.id as usize, id);
            let faces = cut.face_patches.iter().filter(|&&of_face| of_face as usize == id);
            prop_assert_eq!(patch.summary.faces as usize, faces.count());
        }
        let vertices = &cut.vertices;
        let curvatures = vertices.k_min.iter().chain(&vertices.k_max);
        let directions = vertices.d_min.iter().chain(&vertices.d_max).flatten();
        prop_assert!(curvatures.chain(directions).all(|x| x.is_finite()));
        prop_assert!(cut.boundaries.iter().all(|b| b.patches[0] < b.patches[1]));
    }
}
