//! What a plugin is: a name, the stage it fills, its settings, and the systems that do the work.

use std::sync::Arc;

use serde::Serialize;
use toml::Table;

use crate::settings::{self, SettingsError, SettingsTable, StepSettings};
use crate::stage::{Stage, StageSystems};

/// A stage that plugins fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SwappableStage {
    /// Gives every sample a cluster.
    ///
    /// Reads `Column<SampleFeature>` and `Column<Sample>`; writes `ColumnMut<SampleCluster>`, every row a
    /// cluster number below the number of samples.
    Classify,
    /// Gives every face its final patch.
    ///
    /// Reads `Res<MeshTopology>`, `Column<BoundaryScore>`, `Column<SharpEdge>`, `Column<Position>`; reads
    /// and writes `ColumnMut<FaceLabel>`, every row a label below the number of faces, and may tell what it
    /// did to each edge in `ColumnMut<ContourState>`.
    Rectify,
}

impl SwappableStage {
    /// Where it stands among all stages.
    pub fn stage(self) -> Stage {
        match self {
            Self::Classify => Stage::Classify,
            Self::Rectify => Stage::Rectify,
        }
    }

    /// The key of `[pipeline]` that names its plugin.
    pub fn key(self) -> &'static str {
        match self {
            Self::Classify => "classifier",
            Self::Rectify => "rectifier",
        }
    }
}

/// A plugin: one way to fill one stage.
///
/// Its systems take columns and resources, never `Commands` or `&mut World`: rows are the pipeline's. The
/// same columns must give the same answer, on any number of threads. A system that cannot do its work on
/// a mesh returns a [`crate::StepError`] (wrap it in [`crate::fallible`]): that ends the job, not the
/// worker.
pub trait StagePlugin {
    /// Its table of the configuration, which bears the plugin's name.
    type Settings: StepSettings;
    /// The stage it fills.
    const STAGE: SwappableStage;
    /// What it does, in one line.
    const SUMMARY: &'static str;

    /// The systems that do the work, in order.
    fn systems(settings: Self::Settings) -> StageSystems;
}

/// Makes a plugin's systems anew, for each worker.
pub type MakeSystems = Arc<dyn Fn() -> StageSystems + Send + Sync>;

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
}

impl PluginEntry {
    /// The entry of `P`.
    pub fn of<P: StagePlugin>() -> Self {
        Self {
            stage: P::STAGE,
            name: P::Settings::TABLE,
            summary: P::SUMMARY,
            settings: SettingsTable::of::<P::Settings>(),
            systems: |in_force| {
                let settings: P::Settings = settings::read(in_force)?;
                Ok(Arc::new(move || P::systems(settings.clone())))
            },
        }
    }
}

/// All plugins there are. The first of a stage is the one taken where none is named.
#[derive(Clone, Default)]
pub struct Registry {
    entries: Vec<PluginEntry>,
}

impl Registry {
    /// Adds `P`.
    pub fn with<P: StagePlugin>(mut self) -> Self {
        self.entries.push(PluginEntry::of::<P>());
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
            let known = of_stage().map(|entry| entry.name).chain(nothing);
            SettingsError::unknown(key, stage.key(), name, known)
        })
    }
}
