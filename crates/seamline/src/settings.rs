//! Settings of the pipeline from file, environment and command line, in rising order of weight.

use std::env;

use anyhow::Result;
use seamline_ecs::settings::{SettingsError, SettingsTable, set_dotted};
use seamline_ecs::{Pipeline, tables};
use seamline_segment::builtin_steps;
use seamline_watch::ConfigFile;
use toml::Table;

use crate::args::PipelineArgs;
use crate::outcome::WrongUse;

const ENVIRONMENT_PREFIX: &str = "SEAMLINE_";

/// Every table a configuration may hold for the pipeline.
pub fn pipeline_tables() -> Vec<SettingsTable> {
    tables(&builtin_steps(), &seamline_plugins::registry())
}

/// A pipeline under settings from a file, with the environment laid over them.
pub fn pipeline_of_file(file: &ConfigFile) -> Result<Pipeline> {
    let given = file.pipeline_settings();
    let registry = seamline_plugins::registry();
    // Alone first, so that its mistakes are told with their line.
    Pipeline::assemble(&builtin_steps(), &registry, &given).map_err(|e| file.locate(e))?;
    let mut given = given;
    lay_environment_over(&mut given, env::vars())?;
    Ok(Pipeline::assemble(&builtin_steps(), &registry, &given)?)
}

/// The pipeline a command asks for.
pub fn pipeline_of_args(args: &PipelineArgs) -> Result<Pipeline> {
    let mut given = Table::new();
    if let Some(path) = &args.config {
        let file = ConfigFile::read(path, &pipeline_tables())?;
        given = file.pipeline_settings();
        let registry = seamline_plugins::registry();
        Pipeline::assemble(&builtin_steps(), &registry, &given).map_err(|e| file.locate(e))?;
    }
    lay_environment_over(&mut given, env::vars())?;
    lay_args_over(&mut given, args)?;
    let registry = seamline_plugins::registry();
    Ok(Pipeline::assemble(&builtin_steps(), &registry, &given)?)
}

fn lay_args_over(given: &mut Table, args: &PipelineArgs) -> Result<()> {
    for setting in &args.set {
        let (key, value) = setting.split_once('=').ok_or_else(|| {
            WrongUse(format!(
                "--set {setting}: wants KEY=VALUE, as merge.threshold=50"
            ))
        })?;
        set_dotted(given, key.trim(), value.trim())?;
    }
    let named = [
        ("pipeline.profile", &args.profile),
        ("pipeline.classifier", &args.classifier),
        ("pipeline.rectifier", &args.rectifier),
    ];
    for (key, value) in named {
        if let Some(value) = value {
            set_dotted(given, key, &toml::Value::String(value.clone()).to_string())?;
        }
    }
    if let Some(threads) = args.threads {
        set_dotted(given, "pipeline.threads", &threads.to_string())?;
    }
    Ok(())
}

/// `SEAMLINE_PROFILE`, `_CLASSIFIER`, `_RECTIFIER`, `_THREADS` stand for the keys of `[pipeline]`; any other
/// key is `SEAMLINE_TABLE__KEY`.
fn lay_environment_over(
    given: &mut Table,
    variables: impl Iterator<Item = (String, String)>,
) -> Result<(), SettingsError> {
    let mut ours: Vec<_> = variables
        .filter(|(name, _)| name.starts_with(ENVIRONMENT_PREFIX))
        .collect();
    ours.sort();
    for (name, value) in ours {
        let key = name[ENVIRONMENT_PREFIX.len()..].to_lowercase();
        let (table, key) = key.split_once("__").unwrap_or(("pipeline", &key));
        let tables = pipeline_tables();
        let known = tables
            .iter()
            .find(|known| known.name.replace('-', "_") == table);
        let table = known.map_or(table, |known| known.name);
        set_dotted(given, &format!("{table}.{key}"), &value)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variable_names_a_key_of_any_table() {
        let mut given = Table::new();
        let variables = [
            ("SEAMLINE_PROFILE", "lavoue2005"),
            ("SEAMLINE_CONTOUR_TRACKING__CORRECT_BELOW_DEG", "5"),
            ("PATH", "/bin"),
        ];
        let variables = variables
            .into_iter()
            .map(|(name, value)| (name.to_owned(), value.to_owned()));
        lay_environment_over(&mut given, variables).unwrap();
        assert_eq!(given["pipeline"]["profile"].as_str(), Some("lavoue2005"));
        assert_eq!(
            given["contour-tracking"]["correct_below_deg"].as_integer(),
            Some(5)
        );
        assert_eq!(given.len(), 2);
    }

    #[test]
    fn the_command_line_beats_what_is_given_before() {
        let mut given = "[pipeline]\nprofile = 'cad'\n[merge]\nthreshold = 1.0"
            .parse()
            .unwrap();
        let args = PipelineArgs {
            profile: Some("lavoue2005".to_owned()),
            set: vec!["merge.threshold=50".to_owned()],
            ..PipelineArgs::default()
        };
        lay_args_over(&mut given, &args).unwrap();
        assert_eq!(given["pipeline"]["profile"].as_str(), Some("lavoue2005"));
        assert_eq!(given["merge"]["threshold"].as_integer(), Some(50));
    }
}
