//! Contours on a sheet of 4 x 4 unit squares, split between its columns 0, 1 and 2, 3.

use glam::dvec3;
use seamline_contour_tracking::{ContourTrackingSettings, Ground, mark, patches, track};
use seamline_ecs::components::{BoundaryScore, ContourState, FaceLabel, Position, SharpEdge};
use seamline_ecs::settings::{Profile, StepSettings};
use seamline_mesh::Topology;

const SIDE: u32 = 4;

fn ground<'a>(
    topology: &'a Topology,
    positions: &'a [Position],
    scores: &'a &[BoundaryScore],
) -> Ground<'a> {
    Ground {
        topology,
        positions,
        evidence: scores,
        turn_weight: 2.0,
        max_gap: f64::INFINITY,
    }
}

struct Sheet {
    topology: Topology,
    positions: Vec<Position>,
    /// Left half 0, right half 1.
    labels: Vec<FaceLabel>,
    scores: Vec<BoundaryScore>,
    sharp: Vec<SharpEdge>,
    states: Vec<ContourState>,
}

impl Sheet {
    fn new() -> Self {
        let at = |x: u32, y: u32| y * (SIDE + 1) + x;
        let mut triangles = Vec::new();
        let mut labels = Vec::new();
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
            labels.extend([FaceLabel(u32::from(x >= SIDE / 2)); 2]);
        }
        let corners = (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| (x, y)));
        let positions: Vec<_> = corners
            .map(|(x, y)| Position(dvec3(f64::from(x), f64::from(y), 0.0)))
            .collect();
        let topology = Topology::build(positions.len(), triangles);
        let edges = topology.edge_vertices.len();
        Self {
            topology,
            positions,
            labels,
            scores: vec![BoundaryScore(40.0); edges],
            sharp: vec![SharpEdge(false); edges],
            states: vec![ContourState::Off; edges],
        }
    }

    /// The edge of the middle line from `y` to `y + 1`.
    fn middle(&self, y: u32) -> usize {
        let ends = [y, y + 1].map(|y| y * (SIDE + 1) + SIDE / 2);
        self.topology
            .edge_vertices
            .iter()
            .position(|&e| e == ends)
            .expect("the edge is there")
    }

    fn score_middle(&mut self, ys: &[u32], score: f64) {
        for &y in ys {
            let edge = self.middle(y);
            self.scores[edge].0 = score;
        }
    }

    fn mark(&mut self, settings: &ContourTrackingSettings) {
        let scores = &&self.scores[..];
        mark(
            &ground(&self.topology, &self.positions, scores),
            &self.sharp,
            &self.labels,
            settings,
            &mut self.states,
        );
    }

    fn middle_states(&self) -> Vec<ContourState> {
        (0..SIDE).map(|y| self.states[self.middle(y)]).collect()
    }

    fn finish(&mut self) -> (usize, usize) {
        let ends = track(
            ground(&self.topology, &self.positions, &&self.scores[..]),
            &mut self.states,
        );
        (
            ends.iter().map(|end| end.edges as usize).sum(),
            patches(&self.topology, false, &mut self.states, &mut self.labels),
        )
    }
}

fn paper() -> ContourTrackingSettings {
    ContourTrackingSettings::defaults(Profile::Lavoue2005)
}

#[test]
fn a_boundary_edge_is_correct_if_its_score_is_low_or_it_is_sharp() {
    let mut sheet = Sheet::new();
    sheet.score_middle(&[0], 9.0);
    let sharp = sheet.middle(2);
    sheet.sharp[sharp].0 = true;
    sheet.mark(&paper());
    use ContourState::{Correct, Off};
    assert_eq!(sheet.middle_states(), [Correct, Off, Correct, Off]);
    assert_eq!(
        sheet.states.iter().filter(|&&state| state != Off).count(),
        2
    );
}

#[test]
fn a_gap_closes_straight_on() {
    let mut sheet = Sheet::new();
    sheet.score_middle(&[0, 3], 0.0);
    sheet.mark(&paper());
    assert_eq!(sheet.finish(), (2, 2));
    use ContourState::{Correct, Tracked};
    assert_eq!(sheet.middle_states(), [Correct, Tracked, Tracked, Correct]);
}

#[test]
fn a_contour_that_ends_inside_walks_on_to_the_border() {
    let mut sheet = Sheet::new();
    sheet.score_middle(&[0], 0.0);
    sheet.mark(&paper());
    assert_eq!(sheet.finish(), (3, 2));
}

#[test]
fn a_contour_turns_only_where_straight_on_is_worse_by_twice_the_turn() {
    // The diagonals turn by 45 degrees, which weighs 90.
    for (straight_on, goes_straight_on) in [(89.0, true), (91.0, false)] {
        let mut sheet = Sheet::new();
        sheet.scores.fill(BoundaryScore(0.0));
        sheet.score_middle(&[1], straight_on);
        let first = sheet.middle(0);
        sheet.states[first] = ContourState::Correct;
        sheet.finish();
        assert_eq!(
            sheet.middle_states()[1] == ContourState::Tracked,
            goes_straight_on
        );
    }
}

#[test]
fn a_boundary_without_any_correct_edge_vanishes_in_the_paper_and_is_kept_in_cad() {
    let mut sheet = Sheet::new();
    sheet.mark(&paper());
    assert_eq!(sheet.finish(), (0, 1));

    let mut sheet = Sheet::new();
    sheet.mark(&ContourTrackingSettings::defaults(Profile::Cad));
    assert_eq!(sheet.middle_states(), [ContourState::Kept; 4]);
    assert_eq!(sheet.finish(), (0, 2));
}

#[test]
fn a_piece_that_parts_nothing_is_taken_off_its_contour() {
    let mut sheet = Sheet::new();
    let inside = sheet.middle(1);
    sheet.states[inside] = ContourState::Correct;
    assert_eq!(
        patches(&sheet.topology, false, &mut sheet.states, &mut sheet.labels),
        1
    );
    assert_eq!(sheet.states[inside], ContourState::Off);
}
