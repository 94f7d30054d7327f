//! `seamline config`: check a configuration, or print the schema of all configurations.

use anyhow::Result;
use seamline_watch::{Config, ConfigFile, shown};

use crate::args::ConfigCommand;
use crate::outcome::Outcome;
use crate::say::print;
use crate::settings::{pipeline_of_file, pipeline_tables, rules_of_file};

/// Checks or prints.
pub fn run(command: &ConfigCommand) -> Result<Outcome> {
    match command {
        ConfigCommand::Schema => {
            let schema = seamline_watch::config::schema(&pipeline_tables());
            print(&serde_json::to_string_pretty(&schema)?)?;
        }
        ConfigCommand::Check { config } => {
            let file = ConfigFile::read(config, &pipeline_tables())?;
            let pipeline = pipeline_of_file(&file)?;
            let config = Config::from_file(&file)?;
            for watched in &config.watch {
                let root = &watched.root;
                let absent = if root.is_dir() {
                    ""
                } else {
                    ", which is not there yet"
                };
                print(&format_args!("watches {}{absent}", shown(root)))?;
            }
            print(&format_args!("writes to {}", shown(&config.output)))?;
            print(pipeline.settings_in_force())?;
            for (at, (_, pipeline)) in rules_of_file(&file)?.iter().enumerate() {
                print(&format_args!("\n# under rule {}:", at + 1))?;
                print(pipeline.settings_in_force())?;
            }
        }
    }
    Ok(Outcome::Done)
}
