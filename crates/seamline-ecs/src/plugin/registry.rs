//! All plugins there are, by stage and name.

use std::sync::Arc;

use toml::Table;

use super::rectifier::early_systems;
use super::{
    Classifier, CommandSettings, Rectifier, SwappableStage, classifier_systems, rectifier_systems,
};
use crate::settings::{self, OutOfRange, SettingsError, SettingsTable, StepSettings};
use crate::stage::StageSystems;

/// Makes a plugin's systems anew, for each worker.
pub type MakeSystems = Arc<dyn Fn() -> StageSystems + Send + Sync>;

/// The systems of a stage that is filled by a program of its own.
pub type OutsideSystems = fn(SwappableStage, &CommandSettings) -> Result<MakeSystems, OutOfRange>;

/// A registered plugin.
#[derive(Clone, Copy)]
pub struct PluginEntry {
    /// The stage it fills.
    pub stage: SwappableStage,
    /// The name it is chosen by.
    pub name: &'static str,
    /// What it does, in one line.
    pub summary: &'static str,
    /// Its settings.
    pub settings: SettingsTable,
    /// Its systems under the settings in force.
    pub systems: fn(&Table) -> Result<MakeSystems, SettingsError>,
    /// Those that run before there are scores; none for a classifier.
    pub early: Option<fn(&Table) -> Result<MakeSystems, SettingsError>>,
}

impl PluginEntry {
    /// The entry of a classifier.
    pub fn classifier<C: Classifier>() -> Self {
        let systems: fn(&Table) -> Result<MakeSystems, SettingsError> = |in_force| {
            let settings: C = settings::read(in_force)?;
            Ok(Arc::new(move || {
                let settings = settings.clone();
                classifier_systems(move |samples| settings.classify(samples))
            }))
        };
        Self::of::<C>(SwappableStage::Classify, C::SUMMARY, systems)
    }

    /// The entry of a rectifier.
    pub fn rectifier<R: Rectifier>() -> Self {
        let systems: fn(&Table) -> Result<MakeSystems, SettingsError> = |in_force| {
            let settings: R = settings::read(in_force)?;
            Ok(Arc::new(move || {
                let settings = settings.clone();
                rectifier_systems(move |mesh| settings.rectify(mesh))
            }))
        };
        let early: fn(&Table) -> Result<MakeSystems, SettingsError> = |in_force| {
            let settings: R = settings::read(in_force)?;
            Ok(Arc::new(move || {
                let settings = settings.clone();
                early_systems(move |mesh, evidence| settings.rectify_asking(mesh, evidence))
            }))
        };
        Self {
            early: Some(early),
            ..Self::of::<R>(SwappableStage::Rectify, R::SUMMARY, systems)
        }
    }

    fn of<S: StepSettings>(
        stage: SwappableStage,
        summary: &'static str,
        systems: fn(&Table) -> Result<MakeSystems, SettingsError>,
    ) -> Self {
        Self {
            stage,
            name: S::TABLE,
            summary,
            settings: SettingsTable::of::<S>(),
            systems,
            early: None,
        }
    }
}

/// All plugins there are. The first of a stage is the one taken where none is named.
#[derive(Clone, Default)]
pub struct Registry {
    entries: Vec<PluginEntry>,
    outside: Option<OutsideSystems>,
}

impl Registry {
    /// Adds a classifier.
    pub fn with_classifier<C: Classifier>(mut self) -> Self {
        self.entries.push(PluginEntry::classifier::<C>());
        self
    }

    /// Adds a rectifier.
    pub fn with_rectifier<R: Rectifier>(mut self) -> Self {
        self.entries.push(PluginEntry::rectifier::<R>());
        self
    }

    /// Lets programs of their own fill stages, by way of `systems`.
    pub fn with_commands(mut self, systems: OutsideSystems) -> Self {
        self.outside = Some(systems);
        self
    }

    /// All entries, in the order they were added.
    pub fn entries(&self) -> &[PluginEntry] {
        &self.entries
    }

    /// The plugin of a stage that is taken where none is named.
    pub fn default_of(&self, stage: SwappableStage) -> Option<&PluginEntry> {
        self.entries.iter().find(|entry| entry.stage == stage)
    }

    /// The plugin of a stage by name. `none` and the empty text are the caller's matter.
    pub fn find(&self, stage: SwappableStage, name: &str) -> Result<&PluginEntry, SettingsError> {
        let of_stage = || self.entries.iter().filter(|entry| entry.stage == stage);
        of_stage().find(|entry| entry.name == name).ok_or_else(|| {
            let key = format!("pipeline.{}", stage.key());
            let nothing = (stage == SwappableStage::Rectify).then_some("none");
            let program = self
                .outside
                .map(|_| "{ command = [\"program\", \"argument\"] }");
            let names = of_stage().map(|entry| entry.name);
            let known = names.chain(nothing).chain(program);
            SettingsError::unknown(key, stage.key(), name, known)
        })
    }

    /// The systems of a stage that a program fills.
    ///
    /// # Errors
    ///
    /// Settings of the command out of range, and a registry without commands.
    pub fn outside(
        &self,
        stage: SwappableStage,
        command: &CommandSettings,
    ) -> Result<MakeSystems, SettingsError> {
        let key = format!("pipeline.{}", stage.key());
        let wrong = |wrong: OutOfRange| {
            let hint = format!("wants {}", wrong.wants);
            SettingsError::new(format!("{key}.{}", wrong.key), "out of range", hint)
        };
        command.check().map_err(wrong)?;
        match self.outside {
            Some(systems) => systems(stage, command).map_err(wrong),
            None => Err(SettingsError::new(
                key.clone(),
                "is a command, and this program starts none",
                "name a plugin; see `seamline plugins`",
            )),
        }
    }
}
