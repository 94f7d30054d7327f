//! A rectifier that decides boundaries anew: faces in a band along each boundary go to one side or the other by
//! a minimum cut, in the spirit of Katz and Tal's fuzzy cut (2003), which the paper compares itself with.
//!
//! What an edge costs as a boundary is its length times how badly it would serve (its boundary score), so that
//! the cut is short and runs where curvature changes. What lies deeper inside a patch than the band stays, and
//! of each patch at least the inner half: a patch never vanishes, and no new one appears but where a cut parts
//! one in two.

mod band;
mod max_flow;

use schemars::JsonSchema;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{LabelledMesh, Labels, Rectifier, StepError};
use serde::{Deserialize, Serialize};

pub use band::{Recut, recut};
pub use max_flow::Flow;

/// The plugin, and its `[graph-cut]` table.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GraphCutSettings {
    /// Width of the band on either side of a boundary, in rings of faces. A patch gives up its outer half at
    /// most, so that one of a single strip stays as it is. On even meshes of the bench (`plugins/COMPARISON.md`) boundary F1
    /// is .913 with 1, .917 with 3 and with 6.
    pub band_rings: u32,
    /// An edge of score 0 costs this share of one of score 90: what is left to decide by length alone. From 0.002 to
    /// 0.02 the means over the bench differ by .001.
    pub length_share: f64,
    /// An edge that is a boundary already costs this share of what it would cost else: how much better a cut must
    /// be than the boundary that is there. The mean of ARI, boundary F1 and exact over the bench is .855 with 0.25, .856
    /// with 0.5, .845 with 1.
    pub kept_share: f64,
}

impl StepSettings for GraphCutSettings {
    const TABLE: &'static str = "graph-cut";

    fn defaults(_: Profile) -> Self {
        Self {
            band_rings: 3,
            length_share: 0.005,
            kept_share: 0.5,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.band_rings <= 1000,
            "band_rings",
            "a number from 0 to 1000",
        )?;
        OutOfRange::unless(
            self.length_share > 0.0 && self.length_share <= 1.0,
            "length_share",
            "a share above 0, 1 at most",
        )?;
        OutOfRange::unless(
            self.kept_share > 0.0 && self.kept_share <= 1.0,
            "kept_share",
            "a share above 0, 1 at most",
        )
    }
}

impl Rectifier for GraphCutSettings {
    const SUMMARY: &'static str =
        "cuts anew within a band along each boundary, where boundary score and length are least";

    fn rectify(&self, mesh: &LabelledMesh<'_>) -> Result<Labels, StepError> {
        let costs = costs(mesh, self);
        let mut of_face = mesh.labels.to_vec();
        let done = recut(mesh.topology, &costs, self.band_rings, &mut of_face);
        Ok(Labels {
            of_face,
            counts: vec![("faces_moved", done.moved), ("patches", done.patches)],
            ..Labels::default()
        })
    }
}

/// Steps in which costs are counted: a cut is compared in whole numbers, so that equal is equal.
const STEPS_A_MEAN_EDGE: f64 = (1u32 << 20) as f64;

/// What each edge costs as a boundary: `length (length_share + (1 - length_share) score / 90)`, and `kept_share` of
/// that if it is one; in whole steps of a millionth of the mean edge, one at least. An edge that is sharp costs
/// as one of score 0.
fn costs(mesh: &LabelledMesh<'_>, settings: &GraphCutSettings) -> Vec<u64> {
    let count = mesh.scores.len();
    let lengths: Vec<f64> = (0..count).map(|edge| mesh.edge_length(edge)).collect();
    let mean = lengths.iter().sum::<f64>() / count.max(1) as f64;
    let steps = if mean > 0.0 {
        STEPS_A_MEAN_EDGE / mean
    } else {
        0.0
    };
    (0..count)
        .map(|edge| {
            let score = if mesh.sharp[edge].0 {
                0.0
            } else {
                mesh.scores[edge].0 / 90.0
            };
            let is_boundary = mesh
                .topology
                .face_pair(edge)
                .is_some_and(|[a, b]| mesh.labels[a as usize] != mesh.labels[b as usize]);
            let kept = if is_boundary {
                settings.kept_share
            } else {
                1.0
            };
            let share = settings.length_share;
            let cost = kept * lengths[edge] * (share + (1.0 - share) * score);
            ((cost * steps).round() as u64).max(1)
        })
        .collect()
}
