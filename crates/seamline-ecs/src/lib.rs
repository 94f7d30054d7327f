//! A mesh as a world of entities, and the stages it passes through.
//!
//! Vertices, faces, edges, curvature samples, regions and patches are entities; what is known of them are
//! components ([`components`]). Every step is a system in a [`Stage`]; a [`Worker`] owns one world and one
//! schedule and sends mesh after mesh through them. Which plugin fills the swappable stages is looked up
//! by name in a [`Registry`].
//!
//! Two rules keep this at the speed of plain arrays (measured; see ARCHITECTURE.md):
//! systems lend whole columns to their kernels as slices ([`Column`], [`ColumnMut`]), and rows are recycled
//! from mesh to mesh ([`rows`]).

mod column;
pub mod components;
pub mod contract;
mod job;
mod pipeline;
pub mod plugin;
pub mod results;
pub mod rows;
pub mod settings;
mod stage;
mod worker;

pub use column::{Column, ColumnMut};
pub use job::{
    Counts, GivenAs, GivenBoundary, InputMarkings, InputMesh, JobFailure, Measures, MeshScale,
    MeshTopology, Settled, Told,
};
pub use pipeline::{BuiltinSteps, InstallStep, Pipeline, PipelineKind, PipelineSettings, tables};
pub use plugin::{
    Answered, Classifier, Clusters, CommandSettings, CurvatureSamples, EndFate, Evidence,
    EvidenceOnDemand, LabelledMesh, Labels, MakeEvidence, MakeSystems, OpenEnd, OpenEnds,
    PluginChoice, PluginEntry, Rectifier, Registry, SwappableStage, boundary, classifier_systems,
    rectifier_systems,
};
pub use results::Segmentation;
pub use stage::{Scoring, Stage, StageSystems, StepError, fallible};
pub use worker::{Progress, StageError, Worker};
