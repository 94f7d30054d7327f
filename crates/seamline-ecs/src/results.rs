//! What comes out of the pipeline for one mesh.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;
use seamline_mesh::Findings;
use serde::Serialize;

use crate::stage::Stage;

/// The patches of one mesh and all that is reported of them. Lengths, areas and curvatures are in the
/// file's own unit again.
#[derive(Resource, Clone, Debug)]
pub struct Segmentation {
    /// The patch of each input face. Ids from 0, numbered by first face.
    pub face_patches: Vec<u32>,
    /// One a patch, by id.
    pub patches: Vec<PatchReport>,
    /// One a pair of patches that touch, by ids.
    pub boundaries: Vec<Boundary>,
    /// Curvature at each welded vertex.
    pub vertices: VertexQuantities,
    /// What the mesh is and what was wrong with it.
    pub findings: Findings,
    /// One a stage, in order.
    pub stages: Vec<StageRecord>,
}

/// Curvature at each vertex: principal values in one over the file's unit, unit directions. Zero at
/// vertices no triangle uses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexQuantities {
    /// Lesser principal curvature in magnitude; negative on saddles.
    pub k_min: Vec<f32>,
    /// Greater principal curvature in magnitude.
    pub k_max: Vec<f32>,
    /// Direction of `k_min`.
    pub d_min: Vec<[f32; 3]>,
    /// Direction of `k_max`.
    pub d_max: Vec<[f32; 3]>,
}

/// Numbers of one patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PatchSummary {
    /// Input faces.
    pub faces: u32,
    /// Area.
    pub area: f64,
    /// Length of its boundary, borders of the mesh included.
    pub perimeter: f64,
    /// Lesser principal curvature of its faces: area mean.
    pub k_min_mean: f64,
    /// The same: standard deviation.
    pub k_min_spread: f64,
    /// Greater principal curvature of its faces: area mean.
    pub k_max_mean: f64,
    /// The same: standard deviation.
    pub k_max_spread: f64,
}

/// One patch in the report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PatchReport {
    /// Its id, as in `labels.seg`.
    pub id: u32,
    /// Its numbers.
    #[serde(flatten)]
    pub summary: PatchSummary,
    /// The patches it touches, by id.
    pub neighbours: Vec<u32>,
}

/// Where two patches touch.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Boundary {
    /// The two ids, lower first.
    pub patches: [u32; 2],
    /// Length.
    pub length: f64,
    /// Share of the length that lies on sharp edges, 0 to 1.
    pub sharp_share: f64,
    /// The curves, as welded vertices; a closed one ends where it begins.
    #[serde(skip)]
    pub polylines: Vec<Vec<u32>>,
}

/// What a stage did to this mesh.
#[derive(Clone, Debug, Serialize)]
pub struct StageRecord {
    /// The stage.
    pub stage: Stage,
    /// How long it took, by the clock.
    pub seconds: f64,
    /// What its steps counted.
    pub counts: BTreeMap<&'static str, u64>,
}
