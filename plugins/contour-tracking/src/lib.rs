//! The paper's rectifier: correct boundary edges are marked, then contours are tracked from their open ends
//! until they close (paper 5.3).

mod bridge;
mod contours;
mod mark;
mod outvote;
mod patches;
mod straighten;
mod stretches;
mod strokes;
mod track;

use schemars::JsonSchema;
use seamline_ecs::components::{ContourState, FaceLabel, SharpEdge};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{
    EndFate, Evidence, GivenAs, LabelledMesh, Labels, Rectifier, StepError, boundary,
};
use serde::{Deserialize, Serialize};

pub use bridge::bridge;
pub use contours::Ground;
pub use mark::{mark, mark_given, runs};
pub use outvote::{Outvoted, outvote};
pub use patches::patches;
pub use straighten::straighten;
pub use stretches::stretches;
pub use strokes::strokes;
pub use track::track;

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
    /// How open ends of contours are closed: `track`, `bridge` or `leave`. `track` repairs best: of hard edges of which
    /// three in ten are missing it makes boundaries of F1 .80 on fine meshes, `bridge` .76.
    pub open_ends: ClosingRule,
    /// The longest piece that is added to close one open end, as a share of the part's size (`mesh.scale`); 0: any.
    pub max_gap_share: f64,
    /// What becomes of a piece of contour that ends where nothing closes it, and so encloses no patch.
    pub dangling: DanglingRule,
    /// Given edges, of which some may be wrong: a run of them between two junctions is not taken if none of it is correct
    /// by its score or turns by more than 15 degrees, and it closes nothing, or closes something by one edge alone that
    /// goes on straight at neither end, as an edge thrown across a flat does.
    pub doubt_given: bool,
    /// Given labels: where their boundary turns by more than this between edges that are not correct it is rough, and
    /// the faces beside it are labelled anew before anything else; else it is kept as it is. The sides of a cylinder of
    /// twelve turn by 30.
    pub rough_above_deg: f64,
    /// How much a flat piece beside a rough boundary is held to the label most of it bears, against where
    /// its boundary would run best; 0: not at all. From 0.1 to 0.3 boundary F1 moves by .01.
    pub vote_weight: f64,
}

/// A way to close open ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ClosingRule {
    /// Step by step along the edge of least weight until a contour is met: the paper's.
    Track,
    /// By the cheapest way over the whole mesh to another open end or to a contour.
    Bridge,
    /// Not at all.
    Leave,
}

/// What becomes of contours that enclose nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DanglingRule {
    /// They are dropped, as in the paper.
    Drop,
    /// They are kept as creases inside one patch, and reported.
    Keep,
}

impl StepSettings for ContourTrackingSettings {
    const TABLE: &'static str = "contour-tracking";

    fn defaults(profile: Profile) -> Self {
        Self {
            correct_below_deg: 10.0,
            sharp_is_correct: true,
            keep_unmarked: profile == Profile::Cad,
            turn_weight: 2.0,
            open_ends: ClosingRule::Track,
            max_gap_share: 0.0,
            dangling: DanglingRule::Drop,
            doubt_given: true,
            rough_above_deg: 30.0,
            vote_weight: 0.2,
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
        )?;
        OutOfRange::unless(
            self.max_gap_share >= 0.0,
            "max_gap_share",
            "a share of the part's size, 0 (any) or more",
        )?;
        OutOfRange::unless(
            (0.0..=180.0).contains(&self.rough_above_deg),
            "rough_above_deg",
            "a turn from 0 to 180 degrees (none is rough)",
        )?;
        OutOfRange::unless(
            self.vote_weight >= 0.0,
            "vote_weight",
            "a weight of 0 or more",
        )
    }
}

impl Rectifier for ContourTrackingSettings {
    const SUMMARY: &'static str =
        "keeps correct boundary edges and tracks contours from them until they close (the paper's)";

    fn rectify(&self, mesh: &LabelledMesh<'_>) -> Result<Labels, StepError> {
        Ok(self.rectified(mesh, &mesh.scores))
    }

    /// Scores are asked for where what was given is doubted or turns, along gaps, and beside what is labelled anew.
    fn rectify_asking(&self, mesh: &LabelledMesh<'_>, evidence: &dyn Evidence) -> Option<Labels> {
        Some(self.rectified(mesh, evidence))
    }
}

impl ContourTrackingSettings {
    fn rectified(&self, mesh: &LabelledMesh<'_>, evidence: &dyn Evidence) -> Labels {
        let ground = Ground {
            topology: mesh.topology,
            positions: mesh.positions,
            evidence,
            turn_weight: self.turn_weight,
            max_gap: match (self.open_ends, self.max_gap_share) {
                (ClosingRule::Leave, _) => 0.0,
                (_, 0.0) => f64::INFINITY,
                (_, share) => share,
            },
        };
        let mut of_face = mesh.labels.to_vec();
        let (contours, doubted) = self.marked(mesh, &ground, &mut of_face);
        self.closed(ground, of_face, contours, doubted)
    }

    /// The patches, once open ends are closed.
    fn closed(
        &self,
        ground: Ground<'_>,
        mut of_face: Vec<FaceLabel>,
        mut contours: Vec<ContourState>,
        doubted: Vec<u32>,
    ) -> Labels {
        let states = &mut contours;
        let open_ends = match self.open_ends {
            ClosingRule::Bridge => bridge(ground, states),
            ClosingRule::Track | ClosingRule::Leave => track(ground, states),
        };
        let keep = self.dangling == DanglingRule::Keep;
        let patch_count = patches(ground.topology, keep, states, &mut of_face);
        for edge in doubted.into_iter().map(|edge| edge as usize) {
            if states[edge] == ContourState::Off {
                states[edge] = match self.dangling {
                    DanglingRule::Drop => ContourState::Doubted,
                    DanglingRule::Keep => ContourState::Crease,
                };
            }
        }

        let is_correct = |state: &&ContourState| **state == ContourState::Correct;
        let correct = contours.iter().filter(is_correct).count();
        let left = open_ends.iter().filter(|end| end.fate == EndFate::Left);
        let counts = vec![
            ("correct_edges", correct),
            ("open_ends", open_ends.len()),
            ("open_ends_left", left.count()),
            (
                "tracked_edges",
                open_ends.iter().map(|end| end.edges as usize).sum(),
            ),
            ("patches", patch_count),
        ];
        Labels {
            of_face,
            contours,
            open_ends,
            counts,
        }
    }

    /// The contours to begin with. Labels that were given are made straight where their boundary is rough, and what is
    /// straight of it is kept. With them come the edges given that are doubted.
    fn marked(
        &self,
        mesh: &LabelledMesh<'_>,
        ground: &Ground<'_>,
        labels: &mut Vec<FaceLabel>,
    ) -> (Vec<ContourState>, Vec<u32>) {
        let mut states = vec![ContourState::Off; mesh.angles.len()];
        let mut doubted = Vec::new();
        match mesh.given_as {
            GivenAs::Edges | GivenAs::HardEdges => {
                let doubt = self.doubt_given && mesh.given_as == GivenAs::Edges;
                doubted = mark_given(mesh, ground, doubt, self, &mut states);
            }
            GivenAs::Nothing => mark(ground, mesh.sharp, labels, self, &mut states),
            GivenAs::Labels => {
                let rough = self.mark_labels(ground, mesh.sharp, labels, &mut states);
                if !rough.is_empty() {
                    let proved;
                    (*labels, proved) = straighten(mesh, ground.evidence, &rough, self.vote_weight);
                    let mut sharp = mesh.sharp.to_vec();
                    proved
                        .iter()
                        .for_each(|&edge| sharp[edge as usize].0 = true);
                    self.mark_labels(ground, &sharp, labels, &mut states);
                }
            }
        }
        (states, doubted)
    }

    /// Marks the boundary of labels that were given, keeps what is straight of it, and gives the edges that are rough.
    ///
    /// What is straight by its form stays whatever its scores: they are asked for in other [`runs`] alone.
    fn mark_labels(
        &self,
        ground: &Ground<'_>,
        sharp: &[SharpEdge],
        labels: &[FaceLabel],
        states: &mut [ContourState],
    ) -> Vec<u32> {
        let boundary = boundary(ground.topology, labels);
        let mut rough = Vec::new();
        let mut turns = vec![false; states.len()];
        for by_score in [false, true] {
            let evidence = WhereItTurns {
                evidence: ground.evidence,
                turns: &turns,
            };
            let seen = Ground {
                evidence: &evidence,
                ..*ground
            };
            mark(&seen, sharp, labels, self, states);
            rough.clear();
            for (edge, straight) in stretches(&seen, &boundary, self.rough_above_deg, states) {
                if straight {
                    states[edge as usize] = ContourState::Kept;
                } else {
                    rough.push(edge);
                }
            }
            if by_score || rough.is_empty() {
                break;
            }
            let (run_of, run_count) = runs(ground.topology, &boundary);
            let mut run_turns = vec![false; run_count];
            for (edge, &run) in boundary.iter().zip(&run_of) {
                run_turns[run as usize] |= rough.binary_search(edge).is_ok();
            }
            for (&edge, &run) in boundary.iter().zip(&run_of) {
                turns[edge as usize] = run_turns[run as usize];
            }
        }
        rough
    }
}

/// The scores of edges in runs that turn; all others are as bad as can be.
struct WhereItTurns<'a> {
    evidence: &'a dyn Evidence,
    turns: &'a [bool],
}

impl Evidence for WhereItTurns<'_> {
    fn score(&self, edge: u32) -> f64 {
        if self.turns[edge as usize] {
            self.evidence.score(edge)
        } else {
            90.0
        }
    }
}
