//! The tables of `plugins/COMPARISON.md`.

use std::sync::Arc;

use seamline_ecs::{SwappableStage, Worker};
use seamline_mesh::{Mesh, read, weld};
use seamline_plugins::registry;
use seamline_tests::{bench, pipeline};

use crate::models::{Model, Row};

/// Prints all of them.
pub fn print(models: &[Model]) {
    for profile in ["cad", "lavoue2005"] {
        println!(
            "\n### Every classifier with every rectifier, `{profile}`\n\n{}",
            Row::HEAD
        );
        for (classifier, rectifier) in pairs() {
            let settings = settings(profile, classifier, rectifier);
            let name = format!("`{classifier}`, `{rectifier}`");
            println!("{}", row(models, &name, &settings));
        }
    }
    for (profile, thresholds) in [
        ("cad", ["0.5", "0.6", "0.65", "0.7", "0.8", "'auto'"]),
        ("lavoue2005", ["1", "2", "5", "10", "20", "'auto'"]),
    ] {
        println!("\n### `merge.threshold`, `{profile}`\n\n{}", Row::HEAD);
        for threshold in thresholds {
            let mut settings = settings(profile, "kmeans", "contour-tracking");
            settings.push(format!("merge.threshold={threshold}"));
            println!("{}", row(models, &threshold.replace('\'', "`"), &settings));
        }
    }
    println!(
        "\n### What a classifier's own settings matter, `cad`\n\n{}",
        Row::HEAD
    );
    for (classifier, key, values) in [
        ("kmeans", "clusters", ["8", "16", "32"]),
        ("gmm", "max_components", ["8", "16", "32"]),
        ("gmm", "least_spread", ["0.1", "0.2", "0.4"]),
        ("histogram", "smoothing", ["0.01", "0.02", "0.04"]),
        ("histogram", "valley_below_share", ["0.25", "0.5", "0.75"]),
        ("mean-shift", "bandwidth", ["0.06", "0.12", "0.24"]),
    ] {
        for value in values {
            let mut settings = settings("cad", classifier, "contour-tracking");
            settings.push(format!("{classifier}.{key}={value}"));
            println!(
                "{}",
                row(
                    models,
                    &format!("`{classifier}.{key} = {value}`"),
                    &settings
                )
            );
        }
    }
    if let Some(path) = bench("paper/fandisk.obj") {
        fandisk(&Arc::new(weld(read(&path).expect("fandisk reads"), 0.0)));
    }
}

/// Fandisk, which has no truth: how many patches, and how long their boundaries are.
fn fandisk(mesh: &Arc<Mesh>) {
    println!("\n### Fandisk: patches, and length of all boundaries in longest sides of its box\n");
    println!("| | `cad` | `lavoue2005` |\n|---|---|---|");
    for (classifier, rectifier) in pairs() {
        let cells = ["cad", "lavoue2005"].map(|profile| {
            let (patches, length) = patches(mesh, &settings(profile, classifier, rectifier));
            format!("{patches}, {length:.3}")
        });
        println!("| `{classifier}`, `{rectifier}` | {} |", cells.join(" | "));
    }
    println!(
        "\n### Fandisk, `lavoue2005`: patches against the number of clusters (Table 2 of the paper)\n"
    );
    println!("| | T = 5 | T = 5, no rectifier | T = 50, no rectifier |\n|---|---|---|---|");
    let mut rows = Vec::new();
    for k in [5, 10, 15, 18, 20, 30] {
        rows.push(("kmeans", format!("kmeans.clusters={k}")));
    }
    for k in [5, 10, 15, 18, 20, 30] {
        rows.push(("gmm", format!("gmm.max_components={k}")));
    }
    for smoothing in ["0.01", "0.02", "0.05", "0.1", "0.2"] {
        rows.push(("histogram", format!("histogram.smoothing={smoothing}")));
    }
    for bandwidth in ["0.05", "0.1", "0.2", "0.3", "0.5"] {
        rows.push(("mean-shift", format!("mean-shift.bandwidth={bandwidth}")));
    }
    for (classifier, setting) in rows {
        let cells =
            [("5", "contour-tracking"), ("5", "none"), ("50", "none")].map(|(t, rectifier)| {
                let mut settings = settings("lavoue2005", classifier, rectifier);
                settings.extend([setting.clone(), format!("merge.threshold={t}")]);
                patches(mesh, &settings).0.to_string()
            });
        println!("| `{setting}` | {} |", cells.join(" | "));
    }
}

fn patches(mesh: &Arc<Mesh>, settings: &[String]) -> (usize, f64) {
    let settings: Vec<_> = settings.iter().map(String::as_str).collect();
    let cut = Worker::new(pipeline(&settings))
        .segment(Arc::clone(mesh))
        .expect("it is cut");
    let [low, high] = mesh.bounding_box();
    let length: f64 = cut.boundaries.iter().map(|boundary| boundary.length).sum();
    (cut.patches.len(), length / (high - low).max_element())
}

fn row(models: &[Model], name: &str, settings: &[String]) -> Row {
    let settings: Vec<_> = settings.iter().map(String::as_str).collect();
    Row::of(models, name, &settings)
}

fn settings(profile: &str, classifier: &str, rectifier: &str) -> Vec<String> {
    let named = [
        ("profile", profile),
        ("classifier", classifier),
        ("rectifier", rectifier),
    ];
    // Where surfaces explain a mesh no classifier is asked.
    let by_curvature = "surfaces.enabled=false".to_owned();
    let named = named.map(|(key, name)| format!("pipeline.{key}={name}"));
    named.into_iter().chain([by_curvature]).collect()
}

fn pairs() -> impl Iterator<Item = (&'static str, &'static str)> {
    let rectifiers = || names(SwappableStage::Rectify).into_iter().chain(["none"]);
    names(SwappableStage::Classify)
        .into_iter()
        .flat_map(move |classifier| rectifiers().map(move |rectifier| (classifier, rectifier)))
}

fn names(stage: SwappableStage) -> Vec<&'static str> {
    let registry = registry();
    let of_stage = registry
        .entries()
        .iter()
        .filter(|entry| entry.stage == stage);
    of_stage.map(|entry| entry.name).collect()
}
