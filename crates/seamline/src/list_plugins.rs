//! `seamline plugins`: each swappable stage, what can fill it, and its settings.

use std::io;

use anyhow::Result;
use seamline_ecs::settings::{Profile, SettingsTable};
use seamline_ecs::{PluginEntry, SwappableStage};
use serde_json::{Value, json};

use crate::args::PluginsArgs;
use crate::outcome::Outcome;
use crate::say::print;
use crate::settings::pipeline_tables;

/// Lists all plugins and the settings of every step.
pub fn run(args: &PluginsArgs) -> Result<Outcome> {
    let registry = seamline_plugins::registry();
    let is_plugin = |table: &SettingsTable| {
        registry
            .entries()
            .iter()
            .any(|entry| entry.name == table.name)
    };
    let builtin: Vec<_> = pipeline_tables()
        .into_iter()
        .filter(|table| !is_plugin(table))
        .collect();
    if args.json {
        let plugins: Vec<_> = registry.entries().iter().map(as_json).collect();
        let steps: Vec<_> = builtin.iter().map(table_as_json).collect();
        print(&serde_json::to_string_pretty(
            &json!({ "plugins": plugins, "steps": steps }),
        )?)?;
        return Ok(Outcome::Done);
    }
    for stage in SwappableStage::ALL {
        print(&format_args!(
            "{} (--{}):",
            stage.stage().name(),
            stage.key()
        ))?;
        for entry in registry
            .entries()
            .iter()
            .filter(|entry| entry.stage == stage)
        {
            print(&format_args!("  {}  {}", entry.name, entry.summary))?;
            print_keys(&entry.settings)?;
        }
        if stage == SwappableStage::Rectify {
            print(&"  none  leaves the boundaries as merging made them")?;
        }
        print(&format_args!(
            "  {{ command = [\"program\", \"argument\"] }}  a program of your own (plugins/command)"
        ))?;
    }
    print(&"built-in steps:")?;
    for table in &builtin {
        print(&format_args!("  {}", table.name))?;
        print_keys(table)?;
    }
    Ok(Outcome::Done)
}

fn print_keys(table: &SettingsTable) -> io::Result<()> {
    for (key, about, [cad, lavoue2005]) in keys(table) {
        print(&format_args!("      {}.{key}", table.name))?;
        print(&format_args!("          {about}"))?;
        let default = if cad == lavoue2005 {
            cad
        } else {
            format!("cad {cad}, lavoue2005 {lavoue2005}")
        };
        print(&format_args!("          default: {default}"))?;
    }
    Ok(())
}

fn as_json(entry: &PluginEntry) -> Value {
    let mut json = table_as_json(&entry.settings);
    json["stage"] = json!(entry.stage);
    json["summary"] = json!(entry.summary);
    json
}

fn table_as_json(table: &SettingsTable) -> Value {
    json!({
        "name": table.name,
        "schema": (table.schema)(),
        "defaults": {
            "cad": (table.defaults)(Profile::Cad),
            "lavoue2005": (table.defaults)(Profile::Lavoue2005),
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
