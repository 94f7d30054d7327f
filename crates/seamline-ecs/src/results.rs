//! What comes out of the pipeline for one mesh.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;
use seamline_mesh::{Findings, PolygonMesh};
use serde::Serialize;

use crate::plugin::EndFate;
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
    /// Curvature at each welded vertex; none where it is not told ([`crate::Told`]).
    pub vertices: VertexQuantities,
    /// What rectifying has changed, where boundaries were given; `None` where the mesh was segmented.
    pub changes: Option<Changes>,
    /// The mesh whose triangles boundaries run through, where they may.
    pub refined: Option<RefinedMesh>,
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

/// What a patch is, in the file's unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PatchSurface {
    /// Type and parameters.
    #[serde(flatten)]
    pub shape: SurfaceShape,
    /// Does it bend away from the inside, as a hole or an inner fillet does? `None` for planes and free forms.
    pub concave: Option<bool>,
    /// Root mean square distance of its vertices from the surface. `None` for free forms.
    pub residual: Option<f64>,
    /// How far the surface is proved, 0 to 1: `e / (e + 1)` with `e` vertices more than determine it, halved where
    /// they lie near and not exactly on it. `None` for free forms.
    pub confidence: Option<f64>,
}

/// Type and parameters of a surface. Directions have length 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum SurfaceShape {
    /// None of the others.
    #[default]
    FreeForm,
    /// A plane.
    Plane {
        /// A point of it.
        point: [f64; 3],
        /// Its normal, outward.
        normal: [f64; 3],
    },
    /// A cylinder of revolution.
    Cylinder {
        /// A point of the axis.
        point: [f64; 3],
        /// Direction of the axis.
        axis: [f64; 3],
        /// Radius.
        radius: f64,
    },
    /// A cone of revolution.
    Cone {
        /// Its tip.
        apex: [f64; 3],
        /// Direction in which it widens.
        axis: [f64; 3],
        /// Between axis and surface.
        half_angle_deg: f64,
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        centre: [f64; 3],
        /// Radius.
        radius: f64,
    },
    /// A torus.
    Torus {
        /// Its centre.
        centre: [f64; 3],
        /// Direction of the axis.
        axis: [f64; 3],
        /// From the centre to the middle of the tube; negative where the tube's inner half is left of one
        /// that meets the axis.
        major_radius: f64,
        /// Of the tube.
        minor_radius: f64,
    },
}

impl SurfaceShape {
    /// A number for it, as `surface_type` of the PLY: 0 free form, 1 plane, 2 cylinder, 3 cone, 4 sphere, 5 torus.
    pub fn number(&self) -> u8 {
        match self {
            Self::FreeForm => 0,
            Self::Plane { .. } => 1,
            Self::Cylinder { .. } => 2,
            Self::Cone { .. } => 3,
            Self::Sphere { .. } => 4,
            Self::Torus { .. } => 5,
        }
    }
}

/// One patch in the report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PatchReport {
    /// Its id, as in `labels.seg`.
    pub id: u32,
    /// Its numbers.
    #[serde(flatten)]
    pub summary: PatchSummary,
    /// What it is. `None` where no surfaces were looked for.
    pub surface: Option<PatchSurface>,
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
    /// The curves, as welded vertices; a closed one ends where it begins. Without those that were added.
    #[serde(skip)]
    pub polylines: Vec<Vec<u32>>,
    /// The curves along edges that were added to the boundaries given; none where the mesh was segmented.
    #[serde(skip)]
    pub added: Vec<Vec<u32>>,
}

/// A mesh whose triangles were cut along its boundaries, in the file's unit.
#[derive(Clone, Debug, Serialize)]
pub struct RefinedMesh {
    /// Vertices that were added, after those of the welded mesh.
    pub vertices_added: usize,
    /// The boundaries as they run now.
    pub boundary: BoundaryMeasure,
    /// Its vertices and triangles.
    #[serde(skip)]
    pub polygons: PolygonMesh,
    /// The patch of each triangle.
    #[serde(skip)]
    pub patches: Vec<u32>,
    /// Curvature at each vertex.
    #[serde(skip)]
    pub vertices: VertexQuantities,
    /// The curves of each pair of patches along edges that were given, as polylines.
    #[serde(skip)]
    pub kept: Vec<([u32; 2], Vec<Vec<u32>>)>,
    /// The same along others, those through triangles among them.
    #[serde(skip)]
    pub added: Vec<([u32; 2], Vec<Vec<u32>>)>,
}

/// What rectifying has changed of the boundaries given. Lengths are in the file's unit, vertices those of the
/// welded mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Changes {
    /// Ends of contours that were open and are not any more.
    pub open_ends_closed: usize,
    /// Ends of contours that are still open.
    pub open_ends_left: usize,
    /// Each open end and what became of it, by vertex.
    pub open_ends: Vec<OpenEndReport>,
    /// Edges by what became of them.
    pub edges: EdgeChanges,
    /// The boundaries as they were given.
    pub before: BoundaryMeasure,
    /// The boundaries of the patches.
    pub after: BoundaryMeasure,
    /// Curves along edges that were given and are boundaries no longer.
    #[serde(skip)]
    pub removed_curves: Vec<Vec<u32>>,
    /// Curves along edges that were given and lie inside one patch.
    #[serde(skip)]
    pub crease_curves: Vec<Vec<u32>>,
}

/// Edges of boundaries by what became of them. `given` is `kept + removed + creases`, and those on borders come on top.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct EdgeChanges {
    /// Given.
    pub given: usize,
    /// Given, and boundaries still.
    pub kept: usize,
    /// Boundaries that were not given.
    pub added: usize,
    /// Given, and no boundaries any more.
    pub removed: usize,
    /// Of those removed, the ones that were never taken: they close nothing and look like no boundary.
    pub doubted: usize,
    /// Given, and kept inside one patch.
    pub creases: usize,
    /// Given on borders of the mesh or where more than two faces meet, which are boundaries in any case.
    pub at_borders: usize,
}

/// How long boundaries are, and how straight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BoundaryMeasure {
    /// Edges.
    pub edges: usize,
    /// Their length.
    pub length: f64,
    /// Mean turn in degrees at the vertices where just two of them meet; straight on is 0.
    pub mean_turn_deg: f64,
    /// Share of these turns that are above 45 degrees.
    pub sharp_turn_share: f64,
    /// Vertices where they end, but for borders and non-manifold edges of the mesh: those close them.
    pub open_ends: usize,
}

/// An open end of a contour.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OpenEndReport {
    /// The welded vertex it is at.
    pub vertex: u32,
    /// What became of it.
    pub fate: EndFate,
    /// Edges added from here.
    pub edges: u32,
    /// Their length.
    pub length: f64,
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
    /// What its steps measured, each in the unit of the setting of that name: the `threshold` at which merging
    /// stopped.
    pub measures: BTreeMap<&'static str, f64>,
}
