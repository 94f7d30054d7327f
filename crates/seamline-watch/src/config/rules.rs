//! Rules by path: which files are cut in another way, and in which.

use std::path::Path;

use seamline_ecs::PluginChoice;
use seamline_ecs::settings::{SettingsError, StepSettings, lay_over};
use toml::{Table, Value};

use super::file::at_home;
use super::frame::RuleTable;
use super::{ConfigError, ConfigFile};
use crate::include::Patterns;

/// A rule of a configuration.
#[derive(Clone, Debug)]
pub struct Rule {
    /// The files it holds for, by their path below the watched folder.
    pub files: Patterns,
    /// The tables of the pipeline for these files: those of the file, with the rule's laid over them.
    pub settings: Table,
    at: usize,
}

impl Rule {
    /// An error of the rule's settings, told of the keys of the rule, with its line.
    pub fn locate(&self, file: &ConfigFile, mut error: SettingsError) -> ConfigError {
        let within = match error.key.strip_prefix("pipeline.") {
            Some(key) => key.to_owned(),
            None => format!("settings.{}", error.key),
        };
        error.key = format!("rules.{}.{within}", self.at);
        file.locate(error)
    }
}

impl ConfigFile {
    /// The rules, in the order in which they are asked.
    ///
    /// # Errors
    ///
    /// An unknown key, a value of the wrong kind, a pattern that is none. The settings of a rule are checked by
    /// who puts its pipeline together.
    pub fn rules(&self) -> Result<Vec<Rule>, ConfigError> {
        let elements = match self.tables().get(RuleTable::TABLE) {
            None => return Ok(Vec::new()),
            Some(Value::Array(elements)) => elements,
            Some(_) => {
                return Err(self.locate(SettingsError::new(
                    RuleTable::TABLE,
                    "is one table",
                    "wants a list: write `[[rules]]`",
                )));
            }
        };
        let numbered = elements.iter().enumerate();
        numbered
            .map(|(at, element)| self.rule(at, element))
            .collect()
    }

    fn rule(&self, at: usize, element: &Value) -> Result<Rule, ConfigError> {
        let table: RuleTable = self.table(Some(element), &format!("rules.{at}"))?;
        let files = Patterns::new(&table.files).map_err(|error| {
            let key = format!("rules.{at}.files");
            self.locate(SettingsError::new(
                key,
                error,
                "as in `files = [\"castings/**\"]`",
            ))
        })?;
        let mut settings = self.pipeline_settings();
        lay_over(&mut settings, &table.settings);
        let pipeline = named(&table, self.path().parent().unwrap_or(Path::new("")));
        lay_over(
            &mut settings,
            &Table::from_iter([("pipeline".to_owned(), Value::Table(pipeline))]),
        );
        Ok(Rule {
            files,
            settings,
            at,
        })
    }
}

/// The keys of `[pipeline]` that a rule gives.
fn named(rule: &RuleTable, folder: &Path) -> Table {
    let mut pipeline = Table::new();
    if !rule.pipeline.is_empty() {
        pipeline.insert("kind".to_owned(), Value::String(rule.pipeline.clone()));
    }
    if !rule.profile.is_empty() {
        pipeline.insert("profile".to_owned(), Value::String(rule.profile.clone()));
    }
    for (key, choice) in [
        ("classifier", &rule.classifier),
        ("rectifier", &rule.rectifier),
    ] {
        if *choice != PluginChoice::DEFAULT
            && let Ok(value) = Value::try_from(choice)
        {
            pipeline.insert(key.to_owned(), value);
        }
    }
    at_home(&mut pipeline, folder);
    pipeline
}
