//! A pipeline put together: which steps run, under which settings.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::job::Told;
use crate::plugin::{MakeSystems, PluginChoice, PluginEntry, Registry, SwappableStage};
use crate::settings::{self, OutOfRange, Profile, SettingsError, SettingsTable, StepSettings};
use crate::stage::{Scoring, Stage};

/// Puts systems into a schedule and their settings into its world.
pub type InstallStep = Arc<dyn Fn(&mut World, &mut Schedule) + Send + Sync>;

/// What a pipeline does with a mesh.
#[derive(
    Resource, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum PipelineKind {
    /// Cuts it into patches.
    #[default]
    Segment,
    /// Cleans and closes the boundaries that another tool has found: labels, edges, or hard edges
    /// (`[hard-edges]`). Nothing is classified, grown or merged.
    Rectify,
}

/// The `[pipeline]` table: what is done, by which profile, with which plugins.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PipelineSettings {
    /// `segment`, or `rectify`: clean the boundaries that another tool has found. On the command line it is the
    /// command that says so.
    pub kind: PipelineKind,
    /// The set of defaults: `cad` or `lavoue2005`.
    pub profile: Profile,
    /// The plugin that gives each curvature sample a cluster; empty: the first registered. A program of your
    /// own: `{ command = ["python3", "my_classifier.py"] }`.
    pub classifier: PluginChoice,
    /// The plugin that cleans the boundaries, or `none`; empty: the first registered. Or a program, as above.
    pub rectifier: PluginChoice,
    /// Threads used on one mesh; 0: all there are. Results do not depend on it.
    pub threads: usize,
}

impl StepSettings for PipelineSettings {
    const TABLE: &'static str = "pipeline";
    const SEVERAL_KINDS: &'static [&'static str] = &["classifier", "rectifier"];

    fn defaults(profile: Profile) -> Self {
        Self {
            kind: PipelineKind::default(),
            profile,
            classifier: PluginChoice::DEFAULT,
            rectifier: PluginChoice::DEFAULT,
            threads: 0,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        let holds = self.threads <= 256;
        OutOfRange::unless(holds, "threads", "a number from 0 (all there are) to 256")
    }
}

/// The built-in steps: their tables of settings, and how they are installed under the settings in force.
pub struct BuiltinSteps {
    /// One a step.
    pub tables: Vec<SettingsTable>,
    /// Defaults in place of the profile's where a classifier other than the first registered is chosen, so that
    /// it is asked: `(table, key, value)`.
    pub with_chosen_classifier: &'static [(&'static str, &'static str, bool)],
    /// Reads the tables in force and gives what installs the steps.
    pub install: fn(&Table) -> Result<InstallStep, SettingsError>,
    /// The tables that have no part in a pipeline of this kind.
    pub idle: fn(PipelineKind) -> &'static [&'static str],
}

/// Everything a worker needs to know, ready to be shared by all of them.
#[derive(Clone)]
pub struct Pipeline {
    install: Vec<InstallStep>,
    in_force: Table,
    threads: usize,
    kind: PipelineKind,
    told: Told,
}

impl Pipeline {
    /// Puts a pipeline together from the built-in steps, the registered plugins and what is `given` of
    /// their settings (tables as in the configuration).
    ///
    /// Errors: unknown tables, keys and plugin names, each with the nearest known one; values of the wrong
    /// kind or out of range.
    pub fn assemble(
        builtin: &BuiltinSteps,
        registry: &Registry,
        given: &Table,
    ) -> Result<Self, SettingsError> {
        let chosen_profile = profile(given)?;
        let tables = tables(builtin, registry);
        let mut in_force = settings::resolve(&tables, chosen_profile, given)?;
        if chooses_classifier(&in_force, registry)? {
            let given = with_defaults(given, builtin.with_chosen_classifier);
            in_force = settings::resolve(&tables, chosen_profile, &given)?;
        }
        let mut pipeline: PipelineSettings = settings::read(&in_force)?;

        let mut install = vec![(builtin.install)(&in_force)?];
        let PipelineSettings {
            kind,
            classifier,
            rectifier,
            ..
        } = &mut pipeline;
        let kind = *kind;
        let classify = (SwappableStage::Classify, classifier);
        let classify = (kind == PipelineKind::Segment).then_some(classify);
        for (stage, choice) in classify
            .into_iter()
            .chain([(SwappableStage::Rectify, rectifier)])
        {
            let systems = choose(registry, stage, choice, &in_force)?;
            install.extend(systems.map(|make| install_plugin(stage, make)));
            if kind == PipelineKind::Rectify
                && let PluginChoice::Named(name) = choice
                && let Ok(PluginEntry {
                    early: Some(early), ..
                }) = registry.find(stage, name)
            {
                install.push(install_early(early(&in_force)?));
            }
        }

        let chosen = [&pipeline.classifier, &pipeline.rectifier];
        for idle in registry.entries() {
            let is_chosen =
                |choice: &&PluginChoice| **choice == PluginChoice::Named(idle.name.to_owned());
            if !chosen.iter().any(is_chosen) {
                in_force.remove(idle.name);
            }
        }
        for idle in (builtin.idle)(kind) {
            in_force.remove(*idle);
        }
        let threads = pipeline.threads;
        let mut said = Table::try_from(pipeline).expect("settings are tables of plain values");
        said.remove("threads");
        if kind == PipelineKind::Rectify {
            said.remove("classifier");
        }
        in_force.insert(PipelineSettings::TABLE.to_owned(), Value::Table(said));
        Ok(Self {
            install,
            in_force,
            threads,
            kind,
            told: Told::default(),
        })
    }

    /// The same pipeline, computing no more of what is only told than this.
    pub fn telling(mut self, told: Told) -> Self {
        self.told = told;
        self
    }

    /// The settings in force, every default written out: what the results depend on, and no more (the
    /// number of threads is not among them).
    pub fn settings_in_force(&self) -> &Table {
        &self.in_force
    }

    /// What it does with a mesh.
    pub fn kind(&self) -> PipelineKind {
        self.kind
    }

    /// Threads used on one mesh; 0: all there are.
    pub fn threads(&self) -> usize {
        self.threads
    }

    pub(crate) fn install(&self, world: &mut World, schedule: &mut Schedule) {
        world.insert_resource(self.told);
        for step in &self.install {
            step(world, schedule);
        }
    }
}

/// Every table a configuration may hold for the pipeline.
pub fn tables(builtin: &BuiltinSteps, registry: &Registry) -> Vec<SettingsTable> {
    let plugins = registry.entries().iter().map(|entry| entry.settings);
    [SettingsTable::of::<PipelineSettings>()]
        .into_iter()
        .chain(builtin.tables.iter().copied())
        .chain(plugins)
        .collect()
}

/// The profile decides the defaults, so it is read before anything else.
fn profile(given: &Table) -> Result<Profile, SettingsError> {
    let named = given
        .get(PipelineSettings::TABLE)
        .and_then(|table| table.get("profile"));
    named.map_or(Ok(Profile::default()), |name| {
        name.clone().try_into().map_err(|_| {
            let found = name
                .as_str()
                .map_or_else(|| name.to_string(), str::to_owned);
            SettingsError::unknown("pipeline.profile", "profile", &found, ["cad", "lavoue2005"])
        })
    })
}

/// The systems of the plugin chosen, if there is one, and the name it has put in the choice.
/// Is the classifier another than is taken where none is named?
fn chooses_classifier(in_force: &Table, registry: &Registry) -> Result<bool, SettingsError> {
    let pipeline: PipelineSettings = settings::read(in_force)?;
    let usual = registry.default_of(SwappableStage::Classify);
    Ok(match pipeline.classifier {
        PluginChoice::Command(_) => true,
        PluginChoice::Named(name) => !name.is_empty() && usual.is_none_or(|it| it.name != name),
    })
}

/// What is given, and `defaults` for what is not.
fn with_defaults(given: &Table, defaults: &[(&str, &str, bool)]) -> Table {
    let mut all = given.clone();
    for &(table, key, value) in defaults {
        let table = all
            .entry(table)
            .or_insert_with(|| Value::Table(Table::new()));
        if let Value::Table(table) = table
            && !table.contains_key(key)
        {
            table.insert(key.to_owned(), Value::Boolean(value));
        }
    }
    all
}

fn choose(
    registry: &Registry,
    stage: SwappableStage,
    choice: &mut PluginChoice,
    in_force: &Table,
) -> Result<Option<MakeSystems>, SettingsError> {
    let name = match choice {
        PluginChoice::Command(command) => return registry.outside(stage, command).map(Some),
        PluginChoice::Named(name) => name,
    };
    if stage == SwappableStage::Rectify && name == "none" {
        return Ok(None);
    }
    let entry = match name.as_str() {
        "" => registry.default_of(stage),
        name => Some(registry.find(stage, name)?),
    };
    *name = entry.map_or("none", |entry| entry.name).to_owned();
    entry.map(|entry| (entry.systems)(in_force)).transpose()
}

/// A rectifier that asks for scores one at a time does so ahead of their being computed for all edges.
fn install_early(make: MakeSystems) -> InstallStep {
    Arc::new(move |_: &mut World, schedule: &mut Schedule| {
        schedule.add_systems(make().in_set(Stage::Score).before(Scoring));
    })
}

fn install_plugin(stage: SwappableStage, make: MakeSystems) -> InstallStep {
    Arc::new(move |_: &mut World, schedule: &mut Schedule| {
        schedule.add_systems(make().in_set(stage.stage()));
    })
}
