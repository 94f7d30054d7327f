//! Labels that are given: left alone where they are right, mended where they are rough.

use std::sync::Arc;

use schemars::JsonSchema;
use seamline_contour_tracking::ContourTrackingSettings;
use seamline_ecs::settings::{Profile, StepSettings};
use seamline_ecs::{LabelledMesh, Labels, Pipeline, Rectifier, Registry, StepError, Worker};
use seamline_mesh::{Markings, Mesh, Topology, shapes, weld};
use seamline_segment::builtin_steps;
use seamline_tests::score::agreement;
use seamline_tests::{pipeline, same_partition};
use serde::{Deserialize, Serialize};

/// A smooth cube, its six flats, twelve rounded edges and eight corners.
fn cube() -> (Arc<Mesh>, Vec<u32>) {
    let cube = shapes::smooth_cube(0.2, 4, 6);
    let truth = cube.patches.clone();
    (Arc::new(weld(cube.polygons(), 0.0)), truth)
}

fn rectified(mesh: &Arc<Mesh>, labels: &[u32], settings: &[&str]) -> Vec<u32> {
    let settings: Vec<&str> = [&["pipeline.kind=rectify"], settings].concat();
    let given = Markings::Labels(labels.to_vec());
    Worker::new(pipeline(&settings))
        .run(Arc::clone(mesh), Some(Arc::new(given)))
        .expect("it is rectified")
        .face_patches
}

/// Of labels of faces, which may have several triangles.
fn boundary_f1(mesh: &Mesh, truth: &[u32], labels: &[u32]) -> f64 {
    let [truth, labels] = [truth, labels].map(|of_face| -> Vec<u32> {
        let faces = mesh.face_of_triangle.iter();
        faces.map(|&face| of_face[face as usize]).collect()
    });
    agreement(mesh, &truth, &labels).boundary_f1
}

/// Every third face beside a boundary goes over to the other side.
fn roughened(mesh: &Mesh, truth: &[u32]) -> Vec<u32> {
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let mut labels = truth.to_vec();
    let pairs = (0..topology.edge_faces.len()).filter_map(|edge| topology.face_pair(edge));
    let face = |triangle: u32| mesh.face_of_triangle[triangle as usize] as usize;
    let parted = pairs.filter(|pair| truth[face(pair[0])] != truth[face(pair[1])]);
    for [a, b] in parted.step_by(3) {
        labels[face(a)] = truth[face(b)];
    }
    labels
}

#[test]
fn right_labels_stay_as_they_are() {
    let (mesh, truth) = cube();
    assert!(same_partition(&rectified(&mesh, &truth, &[]), &truth));
}

#[test]
fn rough_labels_of_a_smooth_cube_are_mended_alike_on_any_number_of_threads() {
    let (mesh, truth) = cube();
    let rough = roughened(&mesh, &truth);
    let f1 = |labels: &[u32]| boundary_f1(&mesh, &truth, labels);
    let one = rectified(&mesh, &rough, &["pipeline.threads=1"]);
    let four = rectified(&mesh, &rough, &["pipeline.threads=4"]);
    assert_eq!(one, four);
    let (before, after) = (f1(&rough), f1(&one));
    assert!(before < 0.7, "{before}");
    assert!(after > 0.9, "{before} becomes {after}");
}

#[test]
fn rough_labels_are_mended_wholly_where_each_lies_on_a_surface_of_its_own() {
    for shape in [
        shapes::smooth_cube(0.2, 4, 6),
        shapes::stadium(3.0, 1.0, 1.0, 12),
    ] {
        let truth = shape.patches.clone();
        let mesh = Arc::new(weld(shape.polygons(), 0.0));
        let rough = roughened(&mesh, &truth);
        let without = rectified(&mesh, &rough, &["surfaces.enabled=false"]);
        assert!(boundary_f1(&mesh, &truth, &without) < 0.99);
        assert!(same_partition(&rectified(&mesh, &rough, &[]), &truth));
    }
}

#[test]
fn labels_of_one_mesh_do_not_serve_the_next() {
    let (mesh, truth) = cube();
    let mut worker = Worker::new(pipeline(&["pipeline.kind=rectify"]));
    let given = Arc::new(Markings::Labels(truth.clone()));
    let first = worker.run(Arc::clone(&mesh), Some(given));
    assert!(same_partition(
        &first.expect("it is rectified").face_patches,
        &truth
    ));
    let nothing = worker.run(mesh, None).expect_err("nothing is given");
    assert_eq!(nothing.message, "nothing is given to be rectified");
}

#[test]
fn scores_are_computed_only_where_a_contour_is_open_or_rough() {
    let (mesh, truth) = cube();
    let rough = roughened(&mesh, &truth);
    for profile in ["pipeline.profile=cad", "pipeline.profile=lavoue2005"] {
        let mut worker = Worker::new(pipeline(&["pipeline.kind=rectify", profile]));
        let mut count = |labels: &Vec<u32>, what: &str| {
            let given = Arc::new(Markings::Labels(labels.clone()));
            let done = worker.run(Arc::clone(&mesh), Some(given));
            let stages = done.expect("it is rectified").stages;
            let mut counts = stages.iter().map(|record| &record.counts);
            counts.find_map(|counts| counts.get(what).copied()).unwrap()
        };
        assert_eq!(count(&truth, "edges_scored"), 0);
        let scored = count(&rough, "edges_scored");
        assert!(scored > 0 && scored < count(&rough, "edges"), "{scored}");
    }
}

/// What is looked at edge by edge is the same as what is computed for all edges at once, as the rectifier that is
/// wrapped here has it.
#[test]
fn what_is_asked_for_edge_by_edge_gives_the_patches_that_all_scores_give() {
    let (mesh, truth) = cube();
    let labels = Markings::Labels(roughened(&mesh, &truth));
    let given = [Some(Arc::new(labels)), None];
    for (profile, given) in ["cad", "lavoue2005"]
        .into_iter()
        .flat_map(|profile| given.iter().map(move |given| (profile, given)))
    {
        let of = |rectifier: &str| {
            let registry = Registry::default()
                .with_rectifier::<ContourTrackingSettings>()
                .with_rectifier::<AllScores>();
            let settings = format!(
                "hard-edges.strong_deg = 30.0\nsurfaces.enabled = false\n[pipeline]\nkind = 'rectify'\nprofile = '{profile}'\nrectifier = '{rectifier}'"
            );
            let settings = settings.parse().expect("these are settings");
            let pipeline = Pipeline::assemble(&builtin_steps(), &registry, &settings);
            let mut worker = Worker::new(Arc::new(pipeline.expect("it goes together")));
            let done = worker.run(Arc::clone(&mesh), given.clone());
            done.expect("it is rectified")
        };
        let [asking, all] = ["contour-tracking", "all-scores"].map(of);
        assert_eq!(asking.face_patches, all.face_patches);
        assert_eq!(asking.patches, all.patches);
    }
}

/// Contour tracking, but that it has all scores computed first.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
struct AllScores(ContourTrackingSettings);

impl StepSettings for AllScores {
    const TABLE: &'static str = "all-scores";

    fn defaults(profile: Profile) -> Self {
        Self(ContourTrackingSettings::defaults(profile))
    }
}

impl Rectifier for AllScores {
    const SUMMARY: &'static str = "contour tracking with all scores";

    fn rectify(&self, mesh: &LabelledMesh<'_>) -> Result<Labels, StepError> {
        self.0.rectify(mesh)
    }
}
