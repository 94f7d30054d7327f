//! Contours completed from hard edges alone, without any segmentation (paper 5.4: "we can imagine using it as
//! a contour tracking post-process to a hard edge detection algorithm").

use seamline_contour_tracking::{patches, track};
use seamline_ecs::components::{BoundaryScore, ContourState, FaceLabel, Position, SharpEdge};
use seamline_ecs::{Column, MeshTopology, Worker};
use seamline_mesh::{EdgeKind, read, weld};
use seamline_tests::{bench, pipeline};
use std::sync::Arc;

use bevy_ecs::prelude::*;
use bevy_ecs::system::RunSystemOnce;

#[test]
fn hard_edges_of_fandisk_close_into_the_same_14_patches_from_25_to_60_degrees() {
    let Some(path) = bench("paper/fandisk.obj") else {
        return;
    };
    let mesh = Arc::new(weld(read(&path).expect("fandisk reads"), 0.0));
    for angle in [25, 30, 40, 50, 60] {
        let settings = [
            "pipeline.profile=lavoue2005",
            "pipeline.rectifier=none",
            &format!("sharp.angle_deg={angle}"),
        ];
        let mut worker = Worker::new(pipeline(&settings));
        worker.segment(Arc::clone(&mesh)).expect("fandisk is cut");
        let columns = |t: Res<MeshTopology>,
                       p: Column<Position>,
                       s: Column<BoundaryScore>,
                       e: Column<SharpEdge>| {
            (t.0.clone(), p.to_vec(), s.to_vec(), e.to_vec())
        };
        let (topology, positions, scores, sharp) = worker
            .world_mut()
            .run_system_once(columns)
            .expect("the columns are there");

        let mark = |sharp: &SharpEdge| {
            if sharp.0 {
                ContourState::Correct
            } else {
                ContourState::Off
            }
        };
        let mut states: Vec<_> = sharp.iter().map(mark).collect();
        let mut labels = vec![FaceLabel(0); mesh.triangles.len()];
        let tracked = track(&topology, &positions, &scores, 2.0, &mut states);
        let count = patches(&topology, &mut states, &mut labels);

        let contour: Vec<_> = (0..states.len())
            .filter(|&e| states[e] != ContourState::Off)
            .collect();
        let length: f64 = contour
            .iter()
            .map(|&e| {
                let [a, b] = topology.edge_vertices[e].map(|v| positions[v as usize].0);
                a.distance(b)
            })
            .sum();
        assert!(
            topology
                .edge_kind
                .iter()
                .all(|&kind| kind == EdgeKind::Regular)
        );
        assert_eq!((count, contour.len()), (14, 743), "at {angle} degrees");
        assert!(
            (length - 13.7327).abs() < 1e-3,
            "at {angle} degrees: {length}"
        );
        assert!(
            tracked.open_ends >= 2 && tracked.steps >= 15,
            "at {angle} degrees: {tracked:?}"
        );
    }
}
