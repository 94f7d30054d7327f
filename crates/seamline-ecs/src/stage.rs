//! The stages of the pipeline and the systems that fill them.

use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleConfigs;
use bevy_ecs::system::ScheduleSystem;
use serde::Serialize;
use thiserror::Error;

use crate::job::JobFailure;

/// What a plugin hands over: the systems of its stage, in order.
pub type StageSystems = ScheduleConfigs<ScheduleSystem>;

/// The stages, in the order every mesh passes them.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// Rows for the mesh, its topology, its scale.
    Import,
    /// Normals and areas.
    Prepare,
    /// Dihedral angles, sharp edges and vertices, enrichment.
    Sharp,
    /// Surfaces the vertices lie on exactly, and the patches they make.
    Surfaces,
    /// Curvature tensors and the samples the classifier sees.
    Curvature,
    /// A cluster for every sample. Filled by a plugin.
    Classify,
    /// Regions of equal cluster.
    Grow,
    /// The region adjacency graph and its reduction.
    Merge,
    /// How well each edge would serve as a boundary.
    Score,
    /// Boundaries cleaned and closed. Filled by a plugin, or empty.
    Rectify,
    /// Patches, boundaries and the report.
    Export,
}

/// The systems of [`Stage::Score`] that compute all scores, left out where the rectifier has asked for those it needs
/// ([`crate::Answered`]).
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Scoring;

impl Stage {
    /// All stages, in order.
    pub const ALL: [Self; 11] = [
        Self::Import,
        Self::Prepare,
        Self::Sharp,
        Self::Surfaces,
        Self::Curvature,
        Self::Classify,
        Self::Grow,
        Self::Merge,
        Self::Score,
        Self::Rectify,
        Self::Export,
    ];

    /// The name used in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Import => "import",
            Self::Prepare => "prepare",
            Self::Sharp => "sharp",
            Self::Surfaces => "surfaces",
            Self::Curvature => "curvature",
            Self::Classify => "classify",
            Self::Grow => "grow",
            Self::Merge => "merge",
            Self::Score => "score",
            Self::Rectify => "rectify",
            Self::Export => "export",
        }
    }
}

/// Why a step could not do its work on this mesh. It ends the job, not the worker.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{message}")]
pub struct StepError {
    /// What went wrong, in one line.
    pub message: String,
    /// What would be right.
    pub hint: String,
}

impl StepError {
    /// An error with its hint.
    pub fn new(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            hint: hint.into(),
        }
    }
}

/// A system that may fail, made into one that notes the failure: later stages are then skipped.
pub fn fallible<M>(system: impl IntoSystem<(), Result<(), StepError>, M> + 'static) -> StageSystems
where
    M: 'static,
{
    system.pipe(note_failure).into_configs()
}

fn note_failure(In(result): In<Result<(), StepError>>, mut failure: ResMut<JobFailure>) {
    if let Err(error) = result {
        failure.0.get_or_insert(error);
    }
}
