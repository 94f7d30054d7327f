//! What a job is done with: a configuration and the pipeline it asks for, never changed, only replaced.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use seamline_ecs::{Pipeline, PipelineKind};
use toml::Value;

use crate::config::Config;
use crate::include::Patterns;
use crate::memory::limit;
use crate::outputs::OutputFile;
use crate::pairs::{markings_in, meshes_of};

/// A configuration, its pipeline, and the hash of all that results depend on.
pub struct Setup {
    /// Folders, limits, what is written.
    pub config: Config,
    /// What is done to a mesh.
    pub pipeline: Arc<Pipeline>,
    /// BLAKE3, in hexadecimal, of the settings in force and the files to be written. The order of keys and
    /// the number of threads have no part in it.
    pub settings_hash: String,
    /// What the program and all meshes in work may take together ([`crate::memory::limit()`]).
    pub memory_limit_bytes: u64,
    /// Are faces split, so that a mesh takes more memory ([`crate::memory::estimate`])?
    pub enriched: bool,
    /// Is half of what is worked on given by another tool ([`crate::pairs`])?
    pub needs_markings: bool,
    /// What files that a rule takes are cut with: the same with another pipeline.
    rules: Vec<(Patterns, Arc<Setup>)>,
}

impl Setup {
    /// Puts the two together.
    pub fn new(config: Config, pipeline: Arc<Pipeline>) -> Self {
        let memory_limit_bytes = limit(config.limits.memory_limit_bytes);
        Self::within(config, pipeline, memory_limit_bytes)
    }

    fn within(config: Config, pipeline: Arc<Pipeline>, memory_limit_bytes: u64) -> Self {
        let mut said = String::new();
        for (name, table) in sorted(pipeline.settings_in_force()) {
            say(name, table, &mut said);
        }
        for file in OutputFile::ALL
            .into_iter()
            .filter(|&file| config.write.has(file))
        {
            said += file.word();
        }
        let given = |table: &str, key: &str| pipeline.settings_in_force().get(table)?.get(key);
        let enriched = given("sharp", "enrich").and_then(Value::as_bool) == Some(true)
            && given("curvature", "carrier").and_then(Value::as_str) == Some("vertices");
        let looks_itself = given("hard-edges", "strong_deg").and_then(Value::as_float);
        let rectifies = pipeline.kind() == PipelineKind::Rectify;
        let told = config.write.told();
        let pipeline = Arc::new(Pipeline::clone(&pipeline).telling(told));
        Self {
            needs_markings: rectifies && looks_itself.is_none_or(|strong| strong == 0.0),
            enriched,
            memory_limit_bytes,
            config,
            pipeline,
            settings_hash: blake3::hash(said.as_bytes()).to_hex().to_string(),
            rules: Vec::new(),
        }
    }

    /// Has the files that a pattern takes, by their path below the watched folder, go through another pipeline. The
    /// first that takes a file holds.
    pub fn with_rules(mut self, rules: Vec<(Patterns, Arc<Pipeline>)>) -> Self {
        let with = |pipeline| {
            Arc::new(Self::within(
                self.config.clone(),
                pipeline,
                self.memory_limit_bytes,
            ))
        };
        let rules = rules.into_iter();
        self.rules = rules
            .map(|(files, pipeline)| (files, with(pipeline)))
            .collect();
        self
    }

    /// Are there files that need markings?
    pub fn has_pairs(&self) -> bool {
        self.needs_markings || self.rules.iter().any(|(_, setup)| setup.needs_markings)
    }

    /// Is a file half of a pair: a mesh that needs markings, or the markings of one?
    pub fn is_of_pair(self: &Arc<Self>, path: &Path) -> bool {
        match markings_in(path) {
            None => self.for_file(path).needs_markings,
            Some(_) => meshes_of(path)
                .iter()
                .any(|mesh| self.for_file(mesh).needs_markings),
        }
    }

    /// What a file is cut with: this, or the same with the pipeline of the rule that takes it.
    pub fn for_file(self: &Arc<Self>, path: &Path) -> Arc<Self> {
        let below = self
            .config
            .watched_with(path)
            .and_then(|watched| path.strip_prefix(&watched.root).ok());
        let relative = below.unwrap_or(path);
        match self.rules.iter().find(|(files, _)| files.take(relative)) {
            None => Arc::clone(self),
            Some((_, setup)) => Arc::clone(setup),
        }
    }
}

fn sorted(table: &toml::Table) -> BTreeMap<&String, &Value> {
    table.iter().collect()
}

fn say(key: &str, value: &Value, said: &mut String) {
    match value {
        Value::Table(table) => {
            for (inner, value) in sorted(table) {
                say(&format!("{key}.{inner}"), value, said);
            }
        }
        plain => *said += &format!("{key} = {plain}\n"),
    }
}
