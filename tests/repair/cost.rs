//! What rectifying costs beside segmenting, on one mesh, in one run.

use std::sync::Arc;

use seamline_ecs::{Pipeline, Segmentation, Told, Worker};
use seamline_mesh::{Markings, Mesh};
use seamline_tests::{bench, pipeline};

use crate::damage::Damage;
use crate::models::{Model, load};

const ROUNDS: usize = 7;

/// What is the same for both: the mesh in rows before, and what is told of the patches after.
const COMMON: [&str; 3] = ["import", "prepare", "export"];

/// Prints a table; says so where the bench is absent.
pub fn print() {
    let Some(path) = bench("models/large/flange-100000.stl") else {
        return;
    };
    let model = load(&path);
    println!(
        "{} vertices, milliseconds, medians of {ROUNDS}",
        model.mesh.positions().len()
    );
    println!("| profile | what | edges scored | stages | job, all told | job, labels alone |");
    println!("|---|---|---|---|---|---|");
    for profile in ["cad", "lavoue2005"] {
        let profile_is = format!("pipeline.profile={profile}");
        row(&model, &[&profile_is], "segment", None);
        let rectify = "pipeline.kind=rectify";
        for (what, damage) in [
            ("rectify labels", Damage::Rough(0)),
            ("rectify labels, 1 ring rough", Damage::Rough(1)),
        ] {
            let damaged = damage.of(&model).expect("labels can always be damaged");
            row(
                &model,
                &[&profile_is, rectify],
                what,
                Some(damaged.markings),
            );
        }
        let hard = [&profile_is, rectify, "hard-edges.strong_deg=40"];
        row(&model, &hard, "rectify hard edges", None);
    }
}

fn row(model: &Model, settings: &[&str], what: &str, markings: Option<Markings>) {
    let markings = markings.map(Arc::new);
    let all = runs(pipeline(settings), &model.mesh, markings.as_ref());
    let least = Told {
        patch_curvature: false,
        vertex_curvature: false,
    };
    let labels_alone = Pipeline::clone(&pipeline(settings)).telling(least);
    let bare = runs(Arc::new(labels_alone), &model.mesh, markings.as_ref());
    let scored = all[0].stages.iter().find_map(|record| {
        let scored = record.counts.get("edges_scored")?;
        Some(scored.to_string())
    });
    println!(
        "| {} | {what} | {} | {:.1} | {:.1} | {:.1} |",
        settings[0].trim_start_matches("pipeline.profile="),
        scored.as_deref().unwrap_or("all"),
        median(&all, |stage| !COMMON.contains(&stage)),
        median(&all, |_| true),
        median(&bare, |_| true),
    );
}

fn runs(
    pipeline: Arc<Pipeline>,
    mesh: &Arc<Mesh>,
    markings: Option<&Arc<Markings>>,
) -> Vec<Segmentation> {
    let mut worker = Worker::new(pipeline);
    let mut run = || {
        let run = worker.run(Arc::clone(mesh), markings.cloned());
        run.expect("it is done")
    };
    // The first has its rows still to make.
    run();
    (0..ROUNDS).map(|_| run()).collect()
}

fn median(runs: &[Segmentation], counts: impl Fn(&str) -> bool) -> f64 {
    let milliseconds = |run: &Segmentation| -> f64 {
        let stages = run.stages.iter();
        let counted = stages.filter(|record| counts(record.stage.name()));
        counted.map(|record| 1000.0 * record.seconds).sum()
    };
    let mut all: Vec<f64> = runs.iter().map(milliseconds).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}
