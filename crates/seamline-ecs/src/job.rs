//! Resources of the mesh that is being worked on.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::DVec3;
use seamline_mesh::{Markings, Mesh, Topology};

use crate::stage::{Stage, StepError};

/// The welded mesh as it was read, in the file's unit.
#[derive(Resource, Clone)]
pub struct InputMesh(pub Arc<Mesh>);

/// What another tool has marked on the mesh, where its boundaries are to be rectified.
#[derive(Resource, Clone)]
pub struct InputMarkings(pub Arc<Markings>);

/// The boundaries that were given to be rectified.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct GivenBoundary {
    /// The edges they run along, rising.
    pub edges: Vec<u32>,
    /// What they were given as.
    pub origin: GivenAs,
    /// How many edges were given besides that have not just two faces: contours end there anyway.
    pub at_borders: usize,
}

/// What boundaries were given as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GivenAs {
    /// Nothing: the patches are those of the segmentation.
    #[default]
    Nothing,
    /// Labels of faces: boundaries are closed.
    Labels,
    /// Edges that somebody names: they may have gaps, and some may be wrong.
    Edges,
    /// Edges that turn by more than an angle: they may have gaps.
    HardEdges,
}

/// What is told of finished patches beyond what finding them takes: all of it, unless somebody says that nobody reads it.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub struct Told {
    /// Mean and spread of curvature of each patch; 0 where they are not told.
    pub patch_curvature: bool,
    /// Curvature at each vertex; none where it is not told.
    pub vertex_curvature: bool,
}

impl Default for Told {
    fn default() -> Self {
        Self {
            patch_curvature: true,
            vertex_curvature: true,
        }
    }
}

/// Edges and neighbours. While the mesh is enriched, those of the enriched mesh.
#[derive(Resource, Default)]
pub struct MeshTopology(pub Topology);

/// From the file's coordinates `p` to scaled ones: `(p - centre) / length`.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct MeshScale {
    /// What becomes the origin, in the file's unit.
    pub centre: DVec3,
    /// What becomes 1, in the file's unit; never zero.
    pub length: f64,
}

/// The patch of each face where a step before Classify has found them already; else `None`. Where there are, the
/// classifier is not asked.
#[derive(Resource, Clone, Debug, Default)]
pub struct Settled(pub Option<Vec<u32>>);

impl Settled {
    /// Is there something left to classify?
    pub(crate) fn not_yet(settled: Res<Self>) -> bool {
        settled.0.is_none()
    }
}

/// The first failure of a step, if any: the stages after it are skipped.
#[derive(Resource, Default)]
pub struct JobFailure(pub Option<StepError>);

/// What the steps measured on the mesh and have to tell, for the report: the threshold that was found, ...
#[derive(Resource, Default)]
pub struct Measures(Vec<(Stage, &'static str, f64)>);

impl Measures {
    /// Notes one finite number. JSON has no others.
    pub fn note(&mut self, stage: Stage, name: &'static str, value: f64) {
        debug_assert!(value.is_finite(), "{name} is {value}");
        self.0.push((stage, name, value));
    }

    /// What a stage noted.
    pub fn of(&self, stage: Stage) -> impl Iterator<Item = (&'static str, f64)> {
        let of_stage = self.0.iter().filter(move |(s, ..)| *s == stage);
        of_stage.map(|&(_, name, value)| (name, value))
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.0.clear();
    }
}

/// Numbers the steps have to tell, for the report: sharp edges, clusters, regions grown, ...
#[derive(Resource, Default)]
pub struct Counts(Vec<(Stage, &'static str, u64)>);

impl Counts {
    /// Notes one number; a second one under the same name replaces the first.
    pub fn note(&mut self, stage: Stage, name: &'static str, value: usize) {
        match self
            .0
            .iter_mut()
            .find(|(s, n, _)| *s == stage && *n == name)
        {
            Some(known) => known.2 = value as u64,
            None => self.0.push((stage, name, value as u64)),
        }
    }

    /// What a stage noted, in the order noted.
    pub fn of(&self, stage: Stage) -> impl Iterator<Item = (&'static str, u64)> {
        self.0
            .iter()
            .filter(move |(s, ..)| *s == stage)
            .map(|&(_, name, value)| (name, value))
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.0.clear();
    }
}
