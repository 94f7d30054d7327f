//! Hard edges by the angle of their faces, with hysteresis: what is to be rectified where nothing else is given
//! (paper 5.4, "a hard edge detection algorithm").

use bevy_ecs::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::DihedralAngle;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_mesh::{Sets, Topology};
use serde::{Deserialize, Serialize};

/// The `[hard-edges]` table: boundaries to be rectified that nobody gives, but the angles of the mesh.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HardEdgeSettings {
    /// Edges that turn by more than this are hard. 0: none are looked for, and labels or edges are to be given. On
    /// Fandisk every angle from 25 to 60 gives the same patches.
    pub strong_deg: f64,
    /// Edges that turn by more than this are hard as well where they continue a hard one; 0: the same as
    /// `strong_deg`.
    pub weak_deg: f64,
}

impl StepSettings for HardEdgeSettings {
    const TABLE: &'static str = "hard-edges";

    fn defaults(_: Profile) -> Self {
        Self {
            strong_deg: 0.0,
            weak_deg: 0.0,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (0.0..180.0).contains(&self.strong_deg),
            "strong_deg",
            "an angle from 0 to below 180 degrees",
        )?;
        OutOfRange::unless(
            (0.0..=self.strong_deg).contains(&self.weak_deg),
            "weak_deg",
            "an angle from 0 to `strong_deg`",
        )
    }
}

/// Angles come out of coordinates with a few ulps of error.
const ROUNDING: f64 = 1e-9;

/// Edges between two faces that turn by more than `strong` radians, and those that turn by more than `weak` and hang
/// together with such a one by edges that do, rising. Where two faces run along an edge in the same direction one is
/// taken as turned round. Borders and non-manifold edges are not among them: they are boundaries anyway.
///
/// Cost: linear.
pub fn hard_edges(
    topology: &Topology,
    angles: &[DihedralAngle],
    weak: f64,
    strong: f64,
) -> Vec<u32> {
    let turns = |edge: usize, limit: f64| {
        topology.face_pair(edge).is_some() && angles[edge].0.abs() > limit + ROUNDING
    };
    let mut runs = Sets::new(topology.vertex_edges.row_count());
    let candidates: Vec<usize> = (0..angles.len())
        .filter(|&edge| turns(edge, weak))
        .collect();
    for &edge in &candidates {
        let [a, b] = topology.edge_vertices[edge];
        runs.unite(a, b);
    }
    let mut has_strong = vec![false; topology.vertex_edges.row_count()];
    let run_of =
        |runs: &mut Sets, edge: usize| runs.first(topology.edge_vertices[edge][0]) as usize;
    for &edge in candidates.iter().filter(|&&edge| turns(edge, strong)) {
        has_strong[run_of(&mut runs, edge)] = true;
    }
    candidates
        .into_iter()
        .filter(|&edge| has_strong[run_of(&mut runs, edge)])
        .map(|edge| edge as u32)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of squares along x, folded at each of its rungs by the angle given.
    fn folded(rungs: &[f64]) -> (Topology, Vec<DihedralAngle>) {
        let count = rungs.len() as u32 + 1;
        let triangles: Vec<[u32; 3]> = (0..count)
            .flat_map(|i| {
                let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
                [[a, c, b], [b, c, d]]
            })
            .collect();
        let topology = Topology::build(2 * count as usize + 2, triangles);
        let angle = |ends: &[u32; 2]| {
            let rung =
                (ends[0].is_multiple_of(2) && ends[1] == ends[0] + 1).then(|| ends[0] as usize / 2);
            let inner = rung.filter(|&rung| rung > 0 && rung <= rungs.len());
            DihedralAngle(inner.map_or(0.0, |rung| rungs[rung - 1].to_radians()))
        };
        let angles = topology.edge_vertices.iter().map(angle).collect();
        (topology, angles)
    }

    fn found(rungs: &[f64], weak: f64, strong: f64) -> usize {
        let (topology, angles) = folded(rungs);
        hard_edges(&topology, &angles, weak.to_radians(), strong.to_radians()).len()
    }

    #[test]
    fn an_edge_is_hard_above_the_angle_whichever_way_it_turns_and_not_at_it() {
        assert_eq!(found(&[30.0, -30.0, 29.0, 0.0], 29.0, 29.0), 2);
    }

    #[test]
    fn borders_are_not_among_them() {
        assert_eq!(found(&[0.0], 0.0, 0.0), 0);
    }

    /// The rungs of the strip do not touch each other.
    #[test]
    fn a_weak_edge_that_continues_no_strong_one_is_not_hard() {
        assert_eq!(found(&[20.0, 50.0, 20.0], 15.0, 40.0), 1);
    }

    #[test]
    fn a_weak_edge_that_continues_a_strong_one_is_hard() {
        let topology = Topology::build(5, vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]);
        let angle = |ends: &[u32; 2]| match ends {
            [0, 1] => DihedralAngle(0.9),
            [0, 2] | [0, 4] => DihedralAngle(0.4),
            _ => DihedralAngle(0.0),
        };
        let angles: Vec<_> = topology.edge_vertices.iter().map(angle).collect();
        assert_eq!(hard_edges(&topology, &angles, 0.3, 0.8).len(), 3);
        assert_eq!(hard_edges(&topology, &angles, 0.8, 0.8).len(), 1);
    }
}
