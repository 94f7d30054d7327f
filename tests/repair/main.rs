//! Damages boundaries of CAD meshes whose patches are known, has them rectified, and scores before and after.
//!
//! `cargo run --release -p seamline-tests --example repair`: the table of `plugins/REPAIR.md`. Arguments are settings,
//! as `contour-tracking.open_ends=bridge`, or `only=WORD` for the models whose name has a word, `each` to see each of
//! them, and `write=DIR` for labels before and after as files. `cost` prints what rectifying costs beside segmenting instead.

mod cost;
mod damage;
mod models;

use std::env;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use seamline_ecs::Worker;
use seamline_tests::pipeline;
use seamline_tests::score::agreement;

use damage::{Damage, Damaged};
use models::{Model, VARIANTS, models};

fn main() {
    if env::args()
        .nth(1)
        .is_some_and(|argument| argument == "cost")
    {
        return cost::print();
    }
    let Some(models) = models() else { return };
    let [mut only, mut each, mut write] = [String::new(), String::new(), String::new()];
    let mut settings = vec!["pipeline.kind=rectify".to_owned()];
    for argument in env::args().skip(1) {
        match argument.split_once('=') {
            Some(("only", word)) => only = word.to_owned(),
            Some(("write", folder)) => write = folder.to_owned(),
            None if argument == "each" => each = argument,
            _ => settings.push(argument),
        }
    }
    let models: Vec<Model> = models
        .into_iter()
        .filter(|model| model.name.contains(&only))
        .collect();
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    let mut worker = Worker::new(pipeline(&settings));
    println!("| damage | {} |", VARIANTS.join(" | "));
    println!("|---|---|---|---|");
    for damage in Damage::ALL {
        let cells: Vec<String> = (0..VARIANTS.len())
            .map(|variant| {
                let of_variant = models.iter().filter(|model| model.variant == variant);
                let outcomes: Vec<Outcome> = of_variant
                    .filter_map(|model| {
                        let outcome = rectify(&mut worker, model, damage, &write)?;
                        if !each.is_empty() {
                            eprintln!("{damage:?} {}: {outcome:?}", model.name);
                        }
                        Some(outcome)
                    })
                    .collect();
                cell(&outcomes)
            })
            .collect();
        println!("| {} | {} |", damage.name(), cells.join(" | "));
    }
}

/// Boundary F1 of one model.
#[derive(Clone, Copy, Debug)]
struct Outcome {
    edges: f64,
    before: f64,
    after: f64,
}

fn cell(outcomes: &[Outcome]) -> String {
    let mean = |of: fn(&Outcome) -> f64| {
        outcomes.iter().map(of).sum::<f64>() / outcomes.len().max(1) as f64
    };
    format!(
        "{:.3} / {:.3} / {:.3}",
        mean(|o| o.edges),
        mean(|o| o.before),
        mean(|o| o.after)
    )
}

/// `None` where there is nothing to damage.
fn rectify(worker: &mut Worker, model: &Model, damage: Damage, write: &str) -> Option<Outcome> {
    let Damaged {
        markings,
        labels,
        edges_f1,
    } = damage.of(model)?;
    let rectified = worker
        .run(Arc::clone(&model.mesh), Some(Arc::new(markings)))
        .expect("it is rectified");
    if !write.is_empty() {
        for (when, labels) in [("before", &labels), ("after", &rectified.face_patches)] {
            let lines: Vec<String> = labels.iter().map(u32::to_string).collect();
            let folder = PathBuf::from(write).join(when).join(damage.word());
            fs::create_dir_all(&folder).expect("a folder for labels");
            let place = folder.join(format!("{}.seg", model.name));
            fs::write(place, lines.join("\n") + "\n").expect("labels are written");
        }
    }
    let f1 = |labels: &[u32]| agreement(&model.mesh, &model.truth, labels).boundary_f1;
    Some(Outcome {
        edges: edges_f1,
        before: f1(&labels),
        after: f1(&rectified.face_patches),
    })
}
