//! `seamline plugins`: each swappable stage, what can fill it, and its settings.

use anyhow::Result;
use seamline_ecs::settings::{Profile, SettingsTable};
use seamline_ecs::{PluginEntry, SwappableStage};
use serde_json::{Value, json};

use crate::args::PluginsArgs;
use crate::outcome::Outcome;

const STAGES: [SwappableStage; 2] = [SwappableStage::Classify, SwappableStage::Rectify];

/// Lists all plugins.
pub fn run(args: &PluginsArgs) -> Result<Outcome> {
    let registry = seamline_plugins::registry();
    if args.json {
        let listed: Vec<_> = registry.entries().iter().map(as_json).collect();
        println!("{}", serde_json::to_string_pretty(&listed)?);
        return Ok(Outcome::Done);
    }
    for stage in STAGES {
        println!("{} (--{}):", stage.stage().name(), stage.key());
        for entry in registry
            .entries()
            .iter()
            .filter(|entry| entry.stage == stage)
        {
            println!("  {}  {}", entry.name, entry.summary);
            for (key, about, [cad, lavoue2005]) in keys(&entry.settings) {
                println!("      {}.{key}", entry.name);
                println!("          {about}");
                println!("          cad: {cad}, lavoue2005: {lavoue2005}");
            }
        }
        if stage == SwappableStage::Rectify {
            println!("  none  leaves the boundaries as merging made them");
        }
    }
    Ok(Outcome::Done)
}

fn as_json(entry: &PluginEntry) -> Value {
    json!({
        "stage": entry.stage,
        "name": entry.name,
        "summary": entry.summary,
        "schema": (entry.settings.schema)(),
        "defaults": {
            "cad": (entry.settings.defaults)(Profile::Cad),
            "lavoue2005": (entry.settings.defaults)(Profile::Lavoue2005),
        },
    })
}

/// Every key of a table, what it is, and its default in each profile.
fn keys(table: &SettingsTable) -> Vec<(String, String, [String; 2])> {
    let schema = (table.schema)();
    let defaults = [Profile::Cad, Profile::Lavoue2005].map(|profile| (table.defaults)(profile));
    let about = |key: &str| {
        let text = schema
            .get("properties")
            .and_then(|p| p.get(key))
            .and_then(|p| p.get("description"));
        text.and_then(Value::as_str)
            .unwrap_or_default()
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    defaults[0]
        .keys()
        .map(|key| {
            (
                key.clone(),
                about(key),
                defaults.each_ref().map(|table| table[key].to_string()),
            )
        })
        .collect()
}
