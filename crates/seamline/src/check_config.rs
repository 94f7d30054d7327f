//! `seamline config`: check a configuration, or print the schema of all configurations.

use anyhow::Result;
use seamline_watch::{Config, ConfigFile};

use crate::args::ConfigCommand;
use crate::outcome::Outcome;
use crate::settings::{pipeline_of_file, pipeline_tables};

/// Checks or prints.
pub fn run(command: &ConfigCommand) -> Result<Outcome> {
    match command {
        ConfigCommand::Schema => {
            println!(
                "{}",
                serde_json::to_string_pretty(&seamline_watch::config::schema(&pipeline_tables()))?
            );
        }
        ConfigCommand::Check { config } => {
            let file = ConfigFile::read(config, &pipeline_tables())?;
            let pipeline = pipeline_of_file(&file)?;
            let config_in_force = Config::from_file(&file)?;
            for watched in &config_in_force.watch {
                println!("watches {}", watched.root.display());
            }
            println!("writes to {}", config_in_force.output.display());
            println!("{}", pipeline.settings_in_force());
        }
    }
    Ok(Outcome::Done)
}
