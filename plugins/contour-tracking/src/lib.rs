//! The paper's rectifier: correct boundary edges are marked, then contours are tracked from their open ends
//! until they close (paper 5.3).

mod mark;
mod patches;
mod track;

use bevy_ecs::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::{BoundaryScore, ContourState, FaceLabel, Position, SharpEdge};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{
    Column, ColumnMut, Counts, MeshTopology, Stage, StagePlugin, StageSystems, SwappableStage,
};
use serde::{Deserialize, Serialize};

pub use mark::mark;
pub use patches::patches;
pub use track::{Tracked, track};

/// The plugin.
pub struct ContourTracking;

/// The `[contour-tracking]` table.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
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

impl StagePlugin for ContourTracking {
    type Settings = ContourTrackingSettings;
    const STAGE: SwappableStage = SwappableStage::Rectify;
    const SUMMARY: &'static str =
        "keeps correct boundary edges and tracks contours from them until they close (the paper's)";

    fn systems(settings: ContourTrackingSettings) -> StageSystems {
        let rectify = move |topology: Res<MeshTopology>,
                            positions: Column<Position>,
                            scores: Column<BoundaryScore>,
                            sharp: Column<SharpEdge>,
                            mut states: ColumnMut<ContourState>,
                            mut labels: ColumnMut<FaceLabel>,
                            mut counts: ResMut<Counts>| {
            let states = &mut states[..];
            mark(&topology.0, &scores, &sharp, &labels, &settings, states);
            let tracked = track(
                &topology.0,
                &positions,
                &scores,
                settings.turn_weight,
                states,
            );
            let patch_count = patches(&topology.0, states, &mut labels);

            let marked = states
                .iter()
                .filter(|&&state| state == ContourState::Correct)
                .count();
            counts.note(Stage::Rectify, "correct_edges", marked);
            counts.note(Stage::Rectify, "open_ends", tracked.open_ends);
            counts.note(Stage::Rectify, "tracked_edges", tracked.steps);
            counts.note(Stage::Rectify, "patches", patch_count);
        };
        rectify.into_configs()
    }
}
