//! The tables of `plugins/COMPARISON.md`.

use seamline_ecs::SwappableStage;
use seamline_plugins::registry;

use crate::models::{Model, Row};

/// Prints all of them.
pub fn print(models: &[Model]) {
    println!("{}", Row::HEAD);
    for classifier in names(SwappableStage::Classify) {
        for rectifier in names(SwappableStage::Rectify).into_iter().chain(["none"]) {
            let settings = [
                format!("pipeline.classifier={classifier}"),
                format!("pipeline.rectifier={rectifier}"),
            ];
            let name = format!("{classifier}, {rectifier}");
            println!("{}", Row::of(models, &name, &settings.each_ref().map(String::as_str)));
        }
    }
}

fn names(stage: SwappableStage) -> Vec<&'static str> {
    let registry = registry();
    let of_stage = registry.entries().iter().filter(|entry| entry.stage == stage);
    of_stage.map(|entry| entry.name).collect()
}
