//! The JSON schema of the whole configuration file, put together from its tables.

use seamline_ecs::settings::{Profile, SettingsTable};
use serde_json::{Map, Value, json};

use super::file::FRAME;
use super::frame::{RuleTable, WatchTable};

/// The JSON schema of a configuration file: the frame, and the tables of the pipeline.
///
/// Defaults are those of the profile `cad`. Every key may be left out but the root of a watched folder and
/// the files of a rule.
pub fn schema(pipeline_tables: &[SettingsTable]) -> Value {
    let mut definitions = Map::new();
    let mut properties = Map::new();
    let mut watch = table(&SettingsTable::of::<WatchTable>(), &mut definitions);
    watch["required"] = json!(["root"]);
    properties.insert(
        "watch".to_owned(),
        json!({ "type": "array", "items": watch }),
    );
    for known in FRAME
        .iter()
        .map(|frame| frame())
        .chain(pipeline_tables.iter().copied())
    {
        properties.insert(known.name.to_owned(), table(&known, &mut definitions));
    }
    let mut rule = table(&SettingsTable::of::<RuleTable>(), &mut definitions);
    rule["required"] = json!(["files"]);
    let settings = pipeline_tables.iter().map(|known| {
        (
            known.name.to_owned(),
            json!({ "$ref": format!("#/properties/{}", known.name) }),
        )
    });
    rule["properties"]["settings"] = json!({
        "type": "object",
        "description": rule["properties"]["settings"]["description"],
        "properties": Map::from_iter(settings),
        "additionalProperties": false,
    });
    properties.insert(
        "rules".to_owned(),
        json!({ "type": "array", "items": rule }),
    );
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Seamline configuration",
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "$defs": definitions,
    })
}

/// The keys that have no default.
const REQUIRED: [(&str, &str); 2] = [("watch", "root"), ("rules", "files")];

/// One table: no key required, defaults filled in, shared definitions moved to where `$ref` looks for them.
fn table(known: &SettingsTable, definitions: &mut Map<String, Value>) -> Value {
    let mut schema = (known.schema)().to_value();
    let defaults = serde_json::to_value((known.defaults)(Profile::Cad)).unwrap_or_default();
    if let Some(object) = schema.as_object_mut() {
        object.remove("$schema");
        object.remove("required");
        if let Some(Value::Object(shared)) = object.remove("$defs") {
            definitions.extend(shared);
        }
        if let Some(Value::Object(keys)) = object.get_mut("properties") {
            for (key, of_key) in keys {
                let default = defaults
                    .get(key)
                    .filter(|_| !REQUIRED.contains(&(known.name, key.as_str())));
                if let (Some(default), Some(of_key)) = (default, of_key.as_object_mut()) {
                    of_key.insert("default".to_owned(), default.clone());
                }
            }
        }
    }
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_names_every_table_and_its_defaults() {
        let schema = schema(&[]);
        let keys: Vec<_> = schema["properties"].as_object().unwrap().keys().collect();
        for table in ["watch", "output", "state", "quarantine", "done", "daemon"] {
            assert!(keys.iter().any(|key| *key == table), "{table}");
        }
        assert_eq!(
            schema["properties"]["watch"]["items"]["properties"]["stable_for_ms"]["default"],
            2000
        );
        assert_eq!(
            schema["properties"]["watch"]["items"]["required"],
            json!(["root"])
        );
    }

    #[test]
    fn every_reference_of_the_schema_leads_somewhere() {
        let schema = schema(&[]);
        let text = schema.to_string();
        for name in text
            .split("\"#/$defs/")
            .skip(1)
            .filter_map(|rest| rest.split('"').next())
        {
            assert!(schema["$defs"].get(name).is_some(), "{name}");
        }
        assert!(schema["$defs"].get("After").is_some());
    }
}
