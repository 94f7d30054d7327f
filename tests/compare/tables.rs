//! The tables of `plugins/COMPARISON.md`.

use std::sync::Arc;

use seamline_ecs::{Segmentation, SwappableStage, Worker};
use seamline_mesh::{Mesh, read, weld};
use seamline_plugins::registry;
use seamline_tests::{bench, pipeline};

use crate::leave_out::{self, Choice};
use crate::row::{Compared, Row, plugin_seconds};

/// Fixed thresholds of merging, and the default among them.
const THRESHOLDS: [(&str, [&str; 6], &str); 2] = [
    ("cad", ["0.5", "0.6", "0.65", "0.7", "0.75", "0.8"], "0.65"),
    ("lavoue2005", ["1", "2", "5", "10", "20", "50"], "5"),
];

/// Settings of the plugins, each with the default in the middle.
const SETTINGS: [(&str, &str, [&str; 3]); 9] = [
    ("kmeans", "clusters", ["8", "16", "32"]),
    ("gmm", "max_components", ["8", "16", "32"]),
    ("gmm", "least_spread", ["0.1", "0.2", "0.4"]),
    ("histogram", "smoothing", ["0.01", "0.02", "0.04"]),
    ("histogram", "valley_below_share", ["0.25", "0.5", "0.75"]),
    ("mean-shift", "bandwidth", ["0.06", "0.12", "0.24"]),
    ("graph-cut", "band_rings", ["1", "3", "6"]),
    ("graph-cut", "length_share", ["0.002", "0.005", "0.02"]),
    ("graph-cut", "kept_share", ["0.25", "0.5", "1"]),
];

/// Prints all of them.
pub fn print(compared: &mut Compared) {
    for profile in ["cad", "lavoue2005"] {
        println!(
            "\n### Every classifier with every rectifier, `{profile}`\n\n{}",
            Row::HEAD
        );
        for (classifier, rectifier) in pairs() {
            let settings = settings(profile, classifier, rectifier);
            let name = format!("`{classifier}`, `{rectifier}`");
            println!("{}", compared.row(&settings).line(&name));
        }
    }
    for (profile, thresholds, _) in THRESHOLDS {
        println!("\n### `merge.threshold`, `{profile}`\n\n{}", Row::HEAD);
        for threshold in thresholds.into_iter().chain(["auto"]) {
            let row = compared.row(&merging(profile, threshold));
            println!("{}", row.line(&format!("`{threshold}`")));
        }
    }
    println!(
        "\n### What the plugins' own settings matter, `cad`\n\n{}",
        Row::HEAD
    );
    for (plugin, key, values) in SETTINGS {
        for value in values {
            let name = format!("`{plugin}.{key} = {value}`");
            println!("{}", compared.row(&tuned(plugin, key, value)).line(&name));
        }
    }
    println!("\n### Settings chosen on half of the parts, scored on the other half\n");
    leave_out::print(compared, &choices());
    if let Some(path) = bench("paper/fandisk.obj") {
        fandisk(&Arc::new(weld(read(&path).expect("fandisk reads"), 0.0)));
    }
}

/// By profile, classifier and rectifier, the settings in `merge.threshold`'s tables.
fn merging(profile: &str, threshold: &str) -> Vec<String> {
    let is_default = |&(of, _, default): &(&str, _, &str)| (of, default) == (profile, threshold);
    let mut settings = settings(profile, "kmeans", "contour-tracking");
    if !THRESHOLDS.iter().any(is_default) {
        settings.push(format!("merge.threshold={threshold}"));
    }
    settings
}

/// A plugin under one setting that is not its default, the other stage left to its default.
fn tuned(plugin: &str, key: &str, value: &str) -> Vec<String> {
    let mut settings = match names(SwappableStage::Rectify).contains(&plugin) {
        true => settings("cad", "kmeans", plugin),
        false => settings("cad", plugin, "contour-tracking"),
    };
    let is_default = |&(of, of_key, values): &(&str, &str, [&str; 3])| {
        (of, of_key, values[1]) == (plugin, key, value)
    };
    if !SETTINGS.iter().any(is_default) {
        settings.push(format!("{plugin}.{key}={value}"));
    }
    settings
}

/// What could have been chosen instead of each default.
fn choices() -> Vec<Choice> {
    let mut choices: Vec<Choice> = Vec::new();
    for (plugin, key, [less, default, more]) in SETTINGS {
        let of = format!("`{plugin}`");
        if choices.last().is_none_or(|last| last.of != of) {
            choices.push(Choice {
                default_takes_part: true,
                of,
                default: tuned(plugin, key, default),
                others: Vec::new(),
            });
        }
        let others =
            [less, more].map(|value| (format!("`{key} = {value}`"), tuned(plugin, key, value)));
        choices
            .last_mut()
            .expect("just pushed")
            .others
            .extend(others);
    }
    for (profile, thresholds, _) in THRESHOLDS {
        let others = thresholds.map(|value| (format!("`{value}`"), merging(profile, value)));
        choices.push(Choice {
            default_takes_part: false,
            of: format!("`merge.threshold = \"auto\"`, `{profile}`"),
            default: merging(profile, "auto"),
            others: others.into(),
        });
    }
    choices
}

/// Fandisk, which has no truth: how many patches, and how long their boundaries are.
fn fandisk(mesh: &Arc<Mesh>) {
    println!(
        "\n### Fandisk: patches, length of all boundaries in longest sides of its box, and ms in the two stages\n"
    );
    println!(
        "| | `cad` | classify, rectify ms | `lavoue2005` | classify, rectify ms |\n|---|---|---|---|---|"
    );
    for (classifier, rectifier) in pairs() {
        let cells = ["cad", "lavoue2005"].map(|profile| {
            let (cut, length) = cut(mesh, &settings(profile, classifier, rectifier));
            let [classify, rectify] = plugin_seconds(&cut).map(|seconds| seconds * 1e3);
            let patches = cut.patches.len();
            format!("{patches}, {length:.3} | {classify:.1}, {rectify:.1}")
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
                cut(mesh, &settings).0.patches.len().to_string()
            });
        println!("| `{setting}` | {} |", cells.join(" | "));
    }
}

fn cut(mesh: &Arc<Mesh>, settings: &[String]) -> (Segmentation, f64) {
    let settings: Vec<_> = settings.iter().map(String::as_str).collect();
    let cut = Worker::new(pipeline(&settings))
        .segment(Arc::clone(mesh))
        .expect("it is cut");
    let [low, high] = mesh.bounding_box();
    let length: f64 = cut.boundaries.iter().map(|boundary| boundary.length).sum();
    (cut, length / (high - low).max_element())
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
