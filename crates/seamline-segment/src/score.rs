//! The boundary score (paper 5.2): how badly an edge would serve as a boundary, from 0
//! (well: along the lines of least curvature, where curvature changes) to 90 degrees.

use bevy_ecs::prelude::*;
use glam::DVec3;
use rayon::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::*;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Column, ColumnMut, MeshTopology, Scoring, StageSystems};
use seamline_mesh::Topology;
use serde::{Deserialize, Serialize};

use crate::curvature::measure_vertices_for_score;
use crate::eigen::tangent_principal_frame;
use crate::facets;
use crate::surfaces::settle_scores;

/// The `[score]` table.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScoreSettings {
    /// Weight of the curvature score against the angle score: `omega_c` of the paper.
    pub curvature_weight: f64,
}

impl StepSettings for ScoreSettings {
    const TABLE: &'static str = "score";

    fn defaults(_: Profile) -> Self {
        Self {
            curvature_weight: 0.5,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.curvature_weight >= 0.0,
            "curvature_weight",
            "a weight of 0 or more",
        )
    }
}

/// Below this sum of principal curvatures a vertex has no direction to speak of.
const NO_DIRECTION: f64 = 1e-6;

/// The same for a facet: a tenth of one over the part's size.
const NO_FACET_DIRECTION: f64 = 0.1;

/// The score of an angle that says nothing: the limit of (6) for a tensor that bends all ways alike.
const UNDECIDED_DEG: f64 = 45.0;

pub(crate) fn vertex_systems() -> StageSystems {
    // Measured again, since the mesh is no longer enriched.
    (measure_vertices_for_score, score_by_vertices)
        .chain()
        .in_set(Scoring)
}

pub(crate) fn facet_systems() -> StageSystems {
    (score_by_facets, settle_scores).chain().in_set(Scoring)
}

/// Where nothing but the scores needs curvature.
pub(crate) fn measured_facet_systems() -> StageSystems {
    (facets::systems(), score_by_facets).chain().in_set(Scoring)
}

fn score_by_vertices(
    settings: Res<ScoreSettings>,
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    curvatures: Column<VertexCurvature>,
    mut scores: ColumnMut<BoundaryScore>,
) {
    vertex_scores(
        &topology.0,
        &positions,
        &curvatures,
        settings.curvature_weight,
        &mut scores,
    );
}

fn score_by_facets(
    settings: Res<ScoreSettings>,
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    shapes: Column<FaceShape>,
    facet_of_face: Column<FaceSample>,
    samples: Column<Sample>,
    mut scores: ColumnMut<BoundaryScore>,
) {
    facet_scores(
        &topology.0,
        &positions,
        &shapes,
        &facet_of_face,
        &samples,
        settings.curvature_weight,
        &mut scores,
    );
}

/// The score of every edge from the two facets at it: their mean tensor across their mean normal, and how
/// much their curvatures differ. 0 at borders and non-manifold edges.
pub fn facet_scores(
    topology: &Topology,
    positions: &[Position],
    shapes: &[FaceShape],
    facet_of_face: &[FaceSample],
    samples: &[Sample],
    curvature_weight: f64,
    scores: &mut [BoundaryScore],
) {
    score_edges(topology, positions, scores, |_, faces, along| {
        let facets = faces.map(|face| &samples[facet_of_face[face as usize].0 as usize]);
        let normals = faces.map(|face| shapes[face as usize].normal);
        facet_score(along, facets, normals, curvature_weight)
    });
}

/// The score of an edge from the facets and the normals of its faces.
pub(crate) fn facet_score(
    along: DVec3,
    facets: [&Sample; 2],
    normals: [DVec3; 2],
    curvature_weight: f64,
) -> f64 {
    let angle = facet_angle_score(along, facets, normals[0] + normals[1]);
    weighed(angle, facet_curvature_score(facets), curvature_weight)
}

/// Fills the scores: `score` is asked for edges with two faces, by edge, faces and unit direction; others
/// have 0.
fn score_edges(
    topology: &Topology,
    positions: &[Position],
    scores: &mut [BoundaryScore],
    score: impl Fn(u32, [u32; 2], DVec3) -> f64 + Sync,
) {
    scores
        .par_iter_mut()
        .enumerate()
        .with_min_len(2048)
        .for_each(|(edge, to)| {
            to.0 = topology.face_pair(edge).map_or(0.0, |faces| {
                score(edge as u32, faces, along(topology, positions, edge))
            });
        });
}

/// Unit direction of an edge.
pub(crate) fn along(topology: &Topology, positions: &[Position], edge: usize) -> DVec3 {
    let [a, b] = topology.edge_vertices[edge].map(|v| positions[v as usize].0);
    (b - a).normalize_or_zero()
}

/// The score of every edge from the curvature at its ends and at the vertices across. 0 at borders and
/// non-manifold edges, which are boundaries whatever their score.
pub fn vertex_scores(
    topology: &Topology,
    positions: &[Position],
    curvatures: &[VertexCurvature],
    curvature_weight: f64,
    scores: &mut [BoundaryScore],
) {
    score_edges(topology, positions, scores, |edge, faces, along| {
        let ends = topology.edge_vertices[edge as usize].map(|v| curvatures[v as usize]);
        let across = faces.map(|face| curvatures[topology.opposite_vertex(face, edge) as usize].k);
        vertex_score(along, ends, across, curvature_weight)
    });
}

/// The score of an edge from the curvature at its ends and at the vertices across.
pub(crate) fn vertex_score(
    along: DVec3,
    ends: [VertexCurvature; 2],
    across: [Principal; 2],
    curvature_weight: f64,
) -> f64 {
    let angles = ends
        .each_ref()
        .map(|end| angle_score(along, end, NO_DIRECTION));
    weighed(
        angles.iter().sum::<f64>() / 2.0,
        curvature_score(ends.map(|end| end.k), across),
        curvature_weight,
    )
}

fn weighed(angle: f64, curvature: f64, weight: f64) -> f64 {
    (angle + weight * curvature) / (1.0 + weight)
}

/// The part of one vertex in `S_a` (6): the angles to the directions of least and greatest curvature, each
/// weighted by the other's curvature, in degrees.
pub fn angle_score(along: DVec3, at: &VertexCurvature, no_direction: f64) -> f64 {
    let (k_min, k_max) = (at.k.k_min.abs(), at.k.k_max);
    if k_max + k_min < no_direction {
        return UNDECIDED_DEG;
    }
    let to_min = degrees_between(along, at.d_min);
    let to_max = degrees_between(along, at.d_max);
    (to_min * k_max + to_max * k_min) / (k_max + k_min)
}

/// The angle of two lines, 0 to 90 degrees.
fn degrees_between(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b).abs()).to_degrees()
}

/// `S_c` in degrees: 0 where curvature changes wholly at the edge, 90 where it does not change.
pub fn curvature_score(ends: [Principal; 2], across: [Principal; 2]) -> f64 {
    let [a, b] = across;
    let to_edge = |side: Principal| {
        relative_difference(side, ends[0]).min(relative_difference(side, ends[1]))
    };
    90.0 * (1.0 - relative_difference(a, b).max(to_edge(a)).max(to_edge(b)))
}

fn relative_difference(x: Principal, y: Principal) -> f64 {
    feature_difference(x.feature(), y.feature())
}

fn feature_difference(x: [f64; 2], y: [f64; 2]) -> f64 {
    let size = x[0].max(y[0]) + x[1].max(y[1]);
    if size < NO_DIRECTION {
        0.0
    } else {
        ((x[0] - y[0]).abs() + (x[1] - y[1]).abs()) / size
    }
}

/// The angle score of an edge between two facets, by the mean of their tensors across their mean normal.
fn facet_angle_score(along: DVec3, [a, b]: [&Sample; 2], normal: DVec3) -> f64 {
    let mut mean = SymmetricTensor::default();
    for ((mean, a), b) in mean.0.iter_mut().zip(a.tensor.0).zip(b.tensor.0) {
        *mean = (a + b) / 2.0;
    }
    let frame = tangent_principal_frame(&mean, normal.normalize_or_zero());
    let at = VertexCurvature {
        k: frame.k,
        d_min: frame.d_min,
        d_max: frame.d_max,
    };
    angle_score(along, &at, NO_FACET_DIRECTION)
}

fn facet_curvature_score([a, b]: [&Sample; 2]) -> f64 {
    90.0 * (1.0 - feature_difference(a.curvature, b.curvature))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALONG: DVec3 = DVec3::X;

    fn k(k_min: f64, k_max: f64) -> Principal {
        Principal { k_min, k_max }
    }

    /// The score of an edge whose ends have curvature `end` with `d_min` at `turn_deg` from the edge.
    fn score(a: Principal, b: Principal, end: Principal, turn_deg: f64) -> f64 {
        let d_min = DVec3::new(
            turn_deg.to_radians().cos(),
            turn_deg.to_radians().sin(),
            0.0,
        );
        let at = VertexCurvature {
            k: end,
            d_min,
            d_max: d_min.cross(DVec3::Z),
        };
        weighed(
            angle_score(ALONG, &at, NO_DIRECTION),
            curvature_score([end; 2], [a, b]),
            0.5,
        )
    }

    fn assert_near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }

    #[test]
    fn a_plane_that_becomes_a_fillet_along_its_ruling_scores_0() {
        assert_near(score(k(0.0, 0.0), k(0.0, 5.0), k(0.0, 2.5), 0.0), 0.0);
    }

    #[test]
    fn within_a_cylinder_a_ruling_scores_30_and_a_circle_90() {
        let c = k(0.0, 5.0);
        assert_near(score(c, c, c, 0.0), 30.0);
        assert_near(score(c, c, c, 90.0), 90.0);
    }

    #[test]
    fn a_radius_that_doubles_along_a_ruling_scores_15() {
        assert_near(score(k(0.0, 5.0), k(0.0, 10.0), k(0.0, 7.5), 0.0), 15.0);
    }

    #[test]
    fn a_sphere_and_a_plane_score_60_for_every_edge() {
        let c = k(3.0, 3.0);
        assert_near(score(c, c, c, 17.0), 60.0);
        assert_near(score(k(0.0, 0.0), k(0.0, 0.0), k(0.0, 0.0), 17.0), 60.0);
    }

    #[test]
    fn an_edge_20_degrees_off_where_curvatures_are_1_and_3_has_an_angle_score_of_32_and_a_half() {
        let d_min = DVec3::new(20f64.to_radians().cos(), 20f64.to_radians().sin(), 0.0);
        let at = VertexCurvature {
            k: k(1.0, 3.0),
            d_min,
            d_max: d_min.cross(DVec3::Z),
        };
        assert_near(angle_score(ALONG, &at, NO_DIRECTION), 32.5);
    }

    #[test]
    fn a_ridge_between_flat_sides_scores_0() {
        assert_near(score(k(0.0, 0.0), k(0.0, 0.0), k(0.0, 9.0), 0.0), 0.0);
    }
}
