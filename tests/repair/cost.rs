//! What rectifying costs beside segmenting, on one mesh, in one run.

use std::fs;
use std::sync::Arc;

use seamline_ecs::{Segmentation, Worker};
use seamline_mesh::{Markings, Mesh, read, weld};
use seamline_tests::{bench, pipeline};

const ROUNDS: usize = 7;

/// What counts as segmenting: everything between the mesh in rows and the boundary scores.
const SEGMENTING: [&str; 6] = [
    "sharp",
    "surfaces",
    "curvature",
    "classify",
    "grow",
    "merge",
];

/// Prints a table; says so where the bench is absent.
pub fn print() {
    let Some(path) = bench("models/large/flange-100000.stl") else {
        return;
    };
    let mesh = Arc::new(weld(read(&path).expect("the model reads"), 0.0));
    let truth = fs::read_to_string(path.with_extension("seg")).expect("its truth");
    let truth = truth.lines().map(|line| line.parse().expect("a label"));
    let truth = Arc::new(Markings::Labels(truth.collect()));
    println!(
        "{} vertices, milliseconds, medians of {ROUNDS}",
        mesh.positions().len()
    );
    println!("| profile | what | segmenting | score | rectifying | whole job |");
    println!("|---|---|---|---|---|---|");
    for profile in ["cad", "lavoue2005"] {
        let profile_is = format!("pipeline.profile={profile}");
        let segment = Worker::new(pipeline(&[&profile_is]));
        row(profile, "segment", segment, &mesh, None);
        let labels = Worker::new(pipeline(&[&profile_is, "pipeline.kind=rectify"]));
        row(profile, "rectify labels", labels, &mesh, Some(&truth));
        let hard = ["hard-edges.strong_deg=40", "pipeline.kind=rectify"];
        let hard = Worker::new(pipeline(&[&profile_is, hard[0], hard[1]]));
        row(profile, "rectify hard edges", hard, &mesh, None);
    }
}

fn row(
    profile: &str,
    what: &str,
    mut worker: Worker,
    mesh: &Arc<Mesh>,
    markings: Option<&Arc<Markings>>,
) {
    let runs: Vec<Segmentation> = (0..=ROUNDS)
        .map(|_| {
            let run = worker.run(Arc::clone(mesh), markings.cloned());
            run.expect("it is done")
        })
        .skip(1)
        .collect();
    let median = |counts: &dyn Fn(&str) -> bool| {
        let sum = |run: &Segmentation| -> f64 {
            let stages = run
                .stages
                .iter()
                .filter(|record| counts(record.stage.name()));
            stages.map(|record| record.seconds).sum()
        };
        let mut all: Vec<f64> = runs.iter().map(sum).collect();
        all.sort_by(f64::total_cmp);
        1000.0 * all[all.len() / 2]
    };
    println!(
        "| {profile} | {what} | {:.1} | {:.1} | {:.1} | {:.1} |",
        median(&|stage| SEGMENTING.contains(&stage)),
        median(&|stage| stage == "score"),
        median(&|stage| stage == "rectify"),
        median(&|_| true),
    );
}
