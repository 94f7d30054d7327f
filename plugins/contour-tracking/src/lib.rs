//! The paper's rectifier: correct boundary edges are marked, then contours are tracked from their open ends
//! until they close (paper 5.3).

mod mark;
mod patches;
mod track;

use schemars::JsonSchema;
use seamline_ecs::components::ContourState;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{LabelledMesh, Labels, Rectifier, StepError};
use serde::{Deserialize, Serialize};

pub use mark::mark;
pub use patches::patches;
pub use track::{Tracked, track};

/// The plugin, and its `[contour-tracking]` table.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContourTrackingSettings {
    /// A boundary edge is correct if its score is below this: `ST` of the paper, which has 5.
    /// Curved sharp rims score about 5, and at 5 Fandisk loses patches.
    pub correct_below_deg: f64,
    /// Sharp boundary edges are correct whatever their score.
    pub sharp_is_correct: bool,
    /// A piece of boundary between two junctions without any correct edge is kept whole. Else it is
    /// dropped, as in the paper.
    pub keep_unmarked: bool,
    /// Weight of the turn against the score: `omega_theta` of the paper.
    pub turn_weight: f64,
}

impl StepSettings for ContourTrackingSettings {
    const TABLE: &'static str = "contour-tracking";

    fn defaults(profile: Profile) -> Self {
        Self {
            correct_below_deg: 10.0,
            sharp_is_correct: true,
            keep_unmarked: profile == Profile::Cad,
            turn_weight: 2.0,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (0.0..=90.0).contains(&self.correct_below_deg),
            "correct_below_deg",
            "a score from 0 to 90 degrees",
        )?;
        OutOfRange::unless(
            self.turn_weight >= 0.0,
            "turn_weight",
            "a weight of 0 or more",
        )
    }
}

impl Rectifier for ContourTrackingSettings {
    const SUMMARY: &'static str =
        "keeps correct boundary edges and tracks contours from them until they close (the paper's)";

    fn rectify(&self, mesh: &LabelledMesh<'_>) -> Result<Labels, StepError> {
        let (topology, scores) = (mesh.topology, mesh.scores);
        let mut contours = vec![ContourState::Off; scores.len()];
        mark(
            topology,
            scores,
            mesh.sharp,
            mesh.labels,
            self,
            &mut contours,
        );
        let weight = self.turn_weight;
        let tracked = track(topology, mesh.positions, scores, weight, &mut contours);
        let mut of_face = mesh.labels.to_vec();
        let patch_count = patches(topology, &mut contours, &mut of_face);

        let is_correct = |state: &&ContourState| **state == ContourState::Correct;
        let counts = vec![
            ("correct_edges", contours.iter().filter(is_correct).count()),
            ("open_ends", tracked.open_ends),
            ("tracked_edges", tracked.steps),
            ("patches", patch_count),
        ];
        Ok(Labels {
            of_face,
            contours,
            counts,
        })
    }
}
