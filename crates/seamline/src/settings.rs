//! Settings of the pipeline from file, environment and command line, in rising order of weight.

use std::env;
use std::ffi::OsString;

use anyhow::Result;
use seamline_ecs::settings::{Profile, SettingsError, SettingsTable, StepSettings, set_dotted};
use seamline_ecs::{Pipeline, PipelineSettings, tables};
use seamline_segment::builtin_steps;
use seamline_watch::ConfigFile;
use seamline_watch::include::Patterns;
use toml::Table;

use crate::args::PipelineArgs;
use crate::outcome::WrongUse;

const ENVIRONMENT_PREFIX: &str = "SEAMLINE_";

/// Every table a configuration may hold for the pipeline.
pub fn pipeline_tables() -> Vec<SettingsTable> {
    tables(&builtin_steps(), &seamline_plugins::registry())
}

/// The pipeline a command asks for: `said` are dotted keys that the command itself stands for.
pub fn pipeline_of_args(args: &PipelineArgs, said: &[(&str, String)]) -> Result<Pipeline> {
    let file = args
        .config
        .as_ref()
        .map(|path| ConfigFile::read(path, &pipeline_tables()));
    assemble(file.transpose()?.as_ref(), args, said)
}

/// The pipeline of a configuration, with the environment laid over it.
pub fn pipeline_of_file(file: &ConfigFile) -> Result<Pipeline> {
    assemble(Some(file), &PipelineArgs::default(), &[])
}

/// The rules of a configuration, each with its pipeline; the environment is laid over all of them.
pub fn rules_of_file(file: &ConfigFile) -> Result<Vec<(Patterns, Pipeline)>> {
    let registry = seamline_plugins::registry();
    let assemble = |given: &Table| Pipeline::assemble(&builtin_steps(), &registry, given);
    let mut rules = Vec::new();
    for rule in file.rules()? {
        assemble(&rule.settings).map_err(|error| rule.locate(file, error))?;
        let mut given = rule.settings;
        lay_environment_over(&mut given, env::vars_os())?;
        rules.push((rule.files, assemble(&given)?));
    }
    Ok(rules)
}

fn assemble(
    file: Option<&ConfigFile>,
    args: &PipelineArgs,
    said: &[(&str, String)],
) -> Result<Pipeline> {
    let registry = seamline_plugins::registry();
    let assemble = |given: &Table| Pipeline::assemble(&builtin_steps(), &registry, given);
    let mut given = Table::new();
    if let Some(file) = file {
        given = file.pipeline_settings();
        // Alone first, so that its mistakes are told with their line.
        assemble(&given).map_err(|error| file.locate(error))?;
    }
    lay_environment_over(&mut given, env::vars_os())?;
    lay_args_over(&mut given, args)?;
    for (key, value) in said {
        set_dotted(&mut given, key, value)?;
    }
    Ok(assemble(&given)?)
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
            set_dotted(given, key, value)?;
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
    variables: impl Iterator<Item = (OsString, OsString)>,
) -> Result<(), SettingsError> {
    let mut ours: Vec<_> = variables
        .map(|(name, value)| (name.to_string_lossy().into_owned(), value))
        .filter(|(name, _)| name.starts_with(ENVIRONMENT_PREFIX))
        .collect();
    ours.sort();
    let known = known_variables();
    for (name, value) in ours {
        let Some((_, key)) = known.iter().find(|(known, _)| *known == name) else {
            let known = known.iter().map(|(known, _)| known.as_str());
            return Err(SettingsError::unknown(
                &name,
                "variable of the environment",
                &name,
                known,
            ));
        };
        let value = value.to_str().ok_or_else(|| {
            SettingsError::new(&name, "is not text", "wants a value as in a configuration")
        })?;
        set_dotted(given, key, value)?;
    }
    Ok(())
}

/// Every variable that is looked at, and the dotted key it stands for.
fn known_variables() -> Vec<(String, String)> {
    let variable =
        |name: &str| ENVIRONMENT_PREFIX.to_owned() + &name.replace('-', "_").to_uppercase();
    let mut known = Vec::new();
    for table in pipeline_tables() {
        for key in (table.defaults)(Profile::default()).keys() {
            let dotted = format!("{}.{key}", table.name);
            if table.name == PipelineSettings::TABLE {
                known.push((variable(key), dotted.clone()));
            }
            known.push((variable(&format!("{}__{key}", table.name)), dotted));
        }
    }
    known
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
            .map(|(name, value)| (name.into(), value.into()));
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
