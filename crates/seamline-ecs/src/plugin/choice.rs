//! Which plugin fills a stage, as it is said in the configuration.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use crate::settings::OutOfRange;

/// A plugin by name, or a program of its own.
#[derive(Clone, Debug, PartialEq)]
pub enum PluginChoice {
    /// A registered plugin: `"kmeans"`. Empty: the first of its stage.
    Named(String),
    /// A program: `{ command = ["python3", "my_classifier.py"] }`.
    Command(CommandSettings),
}

impl PluginChoice {
    /// The first registered of its stage.
    pub const DEFAULT: Self = Self::Named(String::new());
}

/// A program that fills a stage: it gets columns on standard input and answers on standard output, as
/// `plugins/command` tells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CommandSettings {
    /// The program and its arguments.
    pub command: Vec<String>,
    /// The longest it may take over one mesh, in seconds; after that it is ended and the job has failed.
    #[serde(default = "default_timeout_s")]
    pub timeout_s: f64,
    /// The tables it is sent; empty: all of its stage.
    #[serde(default)]
    pub send: Vec<String>,
    /// Any word. Meshes that were cut under another are cut anew, so change it when the program changes.
    #[serde(default)]
    pub version: String,
    /// The folder it is started in, relative to that of the configuration.
    #[serde(default = "default_folder")]
    pub folder: String,
}

fn default_timeout_s() -> f64 {
    60.0
}

fn default_folder() -> String {
    ".".to_owned()
}

impl CommandSettings {
    /// A program under the defaults.
    pub fn new(command: Vec<String>) -> Self {
        Self {
            command,
            timeout_s: default_timeout_s(),
            send: Vec::new(),
            version: String::new(),
            folder: default_folder(),
        }
    }

    /// Are the values in their ranges?
    ///
    /// # Errors
    ///
    /// The key that is not, and what it wants.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let has_program = self.command.first().is_some_and(|name| !name.is_empty());
        OutOfRange::unless(
            has_program,
            "command",
            "a program and its arguments, as [\"python3\", \"my_classifier.py\"]",
        )?;
        OutOfRange::unless(
            self.timeout_s > 0.0 && self.timeout_s <= 86_400.0,
            "timeout_s",
            "seconds above 0, 86400 at most",
        )
    }
}

impl Serialize for PluginChoice {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Named(name) => name.serialize(serializer),
            Self::Command(command) => command.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for PluginChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;

        impl<'de> Visitor<'de> for Choice {
            type Value = PluginChoice;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the name of a plugin, or { command = [\"program\", \"argument\"] }")
            }

            fn visit_str<E>(self, name: &str) -> Result<PluginChoice, E> {
                Ok(PluginChoice::Named(name.to_owned()))
            }

            fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<PluginChoice, M::Error> {
                CommandSettings::deserialize(MapAccessDeserializer::new(map))
                    .map(PluginChoice::Command)
            }
        }

        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for PluginChoice {
    fn schema_name() -> Cow<'static, str> {
        "PluginChoice".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let command = generator.subschema_for::<CommandSettings>();
        json_schema!({ "anyOf": [{ "type": "string" }, command] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Deserialize, Serialize, Debug, PartialEq)]
    struct Table {
        classifier: PluginChoice,
    }

    fn read(text: &str) -> Result<PluginChoice, String> {
        toml::from_str::<Table>(text)
            .map(|table| table.classifier)
            .map_err(|error| error.message().to_owned())
    }

    #[test]
    fn a_plugin_is_chosen_by_name_or_is_a_command() {
        assert_eq!(
            read("classifier = 'kmeans'"),
            Ok(PluginChoice::Named("kmeans".to_owned()))
        );
        let command = read("classifier = { command = ['a', 'b'], timeout_s = 2 }").unwrap();
        let PluginChoice::Command(command) = command else {
            panic!("{command:?}");
        };
        assert_eq!(command.command, ["a", "b"]);
        assert_eq!(command.timeout_s, 2.0);
        assert_eq!(command.folder, ".");
    }

    #[test]
    fn a_choice_that_is_neither_says_what_is_wrong() {
        let unknown = read("classifier = { command = ['a'], timeout = 2 }").unwrap_err();
        assert!(unknown.contains("unknown field `timeout`"), "{unknown}");
        let missing = read("classifier = { timeout_s = 2 }").unwrap_err();
        assert!(missing.contains("missing field `command`"), "{missing}");
        let number = read("classifier = 3").unwrap_err();
        assert!(number.contains("the name of a plugin"), "{number}");
    }
}
