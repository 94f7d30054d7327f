//! What is known of each element. One archetype an element kind: few, wide components, all given at spawn.
//!
//! Lengths are in units of the scaled mesh ([`crate::MeshScale`]), curvatures in one over that.

use bevy_ecs::prelude::*;
use glam::DVec3;

/// Stands for "none" in the numbers below.
pub const NONE: u32 = u32::MAX;

/// Principal curvatures by the paper's convention: `k_max >= |k_min|`, and `k_min < 0` where the surface
/// bends both ways (saddles).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Principal {
    /// The lesser in magnitude; negative on saddles.
    pub k_min: f64,
    /// The greater in magnitude; never negative.
    pub k_max: f64,
}

impl Principal {
    /// The feature vector `(|k_min|, k_max)` that regions are compared by (paper 4.2.2).
    pub fn feature(self) -> [f64; 2] {
        [self.k_min.abs(), self.k_max]
    }
}

/// A symmetric 3 x 3 tensor: `xx, yy, zz, xy, xz, yz`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SymmetricTensor(pub [f64; 6]);

// Vertices.

/// Vertex: where it is, scaled and centred.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct Position(pub DVec3);

/// Vertex: is it the end of a sharp edge?
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct SharpVertex(pub bool);

/// Vertex: curvature with every edge counted, sharp ones too, so that a sharp border looks highly curved.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct VertexCurvature {
    /// Principal curvatures.
    pub k: Principal,
    /// Unit direction of least curvature: along a cylinder's axis.
    pub d_min: DVec3,
    /// Unit direction of greatest curvature.
    pub d_max: DVec3,
}

/// Vertex: curvature with sharp edges left out.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct SmoothCurvature(pub Principal);

// Faces.

/// Face: unit normal and area. A face without area has a neighbour's normal.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct FaceShape {
    /// Unit normal, outward where the mesh is oriented so; zero if no neighbour has one.
    pub normal: DVec3,
    /// Area.
    pub area: f64,
}

/// Face: the curvature sample it belongs to, [`NONE`] if samples lie on vertices.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceSample(pub u32);

/// Face: the surface it was found to lie on, [`NONE`] if none was looked for.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceSurface(pub u32);

/// Face: its region after growing and merging, its patch after rectifying.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceLabel(pub u32);

// Edges.

/// Edge: signed dihedral angle in radians, positive where convex; zero at borders and non-manifold edges.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct DihedralAngle(pub f64);

/// Edge: is it sharp? Borders, non-manifold edges and edges of turned faces are.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct SharpEdge(pub bool);

/// Edge: how badly it would serve as a boundary, 0 (well) to 90 degrees (paper 5.2).
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct BoundaryScore(pub f64);

/// Edge: its part in the final contours.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContourState {
    /// Not on a contour.
    #[default]
    Off,
    /// A correct boundary edge of the segmentation (paper 5.3.1).
    Correct,
    /// Kept although no edge of its boundary is known to be correct.
    Kept,
    /// Added by the tracker to close a contour (paper 5.3.2).
    Tracked,
    /// Given, but inside one patch: it ends where nothing closes it, and is kept for what it is.
    Crease,
    /// Given, but not taken: nothing about it looks like a boundary, and it closes nothing.
    Doubted,
}

// Samples of curvature: facets, or vertices that are not sharp.

/// Sample: what the classifier compares, made of `(|k_min|, k_max)`, in steps of [`SampleFeature::STEP`].
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleFeature(pub [f64; 2]);

impl SampleFeature {
    /// Far below any difference that matters, far above rounding: what is equal in exact arithmetic is
    /// equal here, so that ties are ties.
    pub const STEP: f64 = 1.0 / (1u64 << 30) as f64;

    /// Rounded to steps.
    pub fn rounded(values: [f64; 2]) -> Self {
        Self(values.map(|value| (value / Self::STEP).round() * Self::STEP))
    }
}

/// Sample: what it was taken from.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct Sample {
    /// Area of the facet; zero for a vertex ([`crate::CurvatureSamples::areas`]).
    pub area: f64,
    /// `(|k_min|, k_max)` after filtering.
    pub curvature: [f64; 2],
    /// Mean curvature tensor of the facet, sharp edges left out; zero for a vertex.
    pub tensor: SymmetricTensor,
    /// Unit direction of least curvature: along a cylinder's axis. Any tangent direction where both curvatures
    /// are equal.
    pub d_min: [f32; 3],
    /// The vertex it lies on, [`NONE`] for a facet.
    pub vertex: u32,
}

/// Sample: its cluster, as the classifier has it.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleCluster(pub u32);

// Surfaces.

/// Surface: what it is, with its evidence; a free form too has a row.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface(pub crate::results::PatchSurface);

// Regions and patches.

/// Region: what is left after merging.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct Region {
    /// `(|k_min|, k_max)`, area mean.
    pub curvature: [f64; 2],
    /// Area.
    pub area: f64,
    /// Length of its boundary.
    pub perimeter: f64,
}

/// Patch: one piece of the finished segmentation.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct Patch(pub crate::results::PatchSummary);
