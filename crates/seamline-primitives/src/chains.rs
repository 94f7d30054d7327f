//! Edges of the designed faces, told by how the triangles lie: chains of mesh edges that go straight on from border to
//! border.
//!
//! A mesher divides the curve in which two faces meet first, and then each face by itself. So the curve stays in the mesh
//! as a chain of edges that hardly turns, or turns evenly, where chains inside a face turn this way and that. It does
//! so however coarse the mesh is, and however smoothly the faces meet.
//!
//! How straight is straight enough is asked of the part itself, as in Desolneux, Moisan and Morel, "Meaningful
//! alignments" (2000): a chain counts if chance would hardly give one as straight in a part whose edges go on as those of
//! this part do. In a grid all rows are straight, and none of them counts.

use foldhash::{HashMap, HashSet};
use glam::DVec3;
use rayon::prelude::*;
use seamline_mesh::Topology;

use crate::fans::{fan, straightest};

/// Chains that count of a part, as many as chance is expected to give at most. The borders of a coarse loft are expected
/// .004 times, so that a tenth of this loses them; ten times this cuts smooth blades and bottles.
const FALSE_ALARMS: f64 = 0.01;
/// The same of chains that count though the surface does not turn there, and of rings, where it has to turn as well. At
/// `FALSE_ALARMS` rows inside springs, ducts and handles count: over two sets of 132 and 161 meshes ARI falls by .009
/// and .002.
const FALSE_ALARMS_IF_SMOOTH: f64 = 1e-6;
/// Degrees a chain turns at most at a vertex, measured on the surface: farther, and it ends there.
const MOST_TURN_DEG: f64 = 30.0;
/// A row beside a chain is as straight if it turns by so many degrees more at most.
const AS_STRAIGHT_DEG: f64 = 0.2;
/// Share of the vertices beside a chain in such rows from which the chain is one row of many. Rows of grids have .9 and
/// more, those of swept tubes and many a border about .5. With .5 a filleted wave loses borders (ARI .001 less over 132
/// meshes), with .6 a hull is cut (.0002 less over 229).
const IN_ROWS: f64 = 0.55;
/// Most edges at a vertex of a row, many times those of a grid: beside a hub lies its whole fan, which would be gone over
/// for each of its chains. No mesh of the bench and six series comes out otherwise for it.
const LARGEST_FAN: usize = 64;
/// How often chains are gone through again because new curves end them, so that the whole is linear in the edges. No part
/// of 615 meshes took more than 6.
const MOST_ROUNDS: usize = 16;
/// Degrees up to which two turns are one.
const SAME_DEG: f64 = 1e-3;

/// An edge, and the vertex it leads to.
type Step = (u32, u32);
/// The inner edges of a part, with their faces.
type Edges = [(u32, [u32; 2])];

/// A chain of edges that counts.
pub(crate) struct Curve {
    pub edges: Vec<u32>,
    pub counts: Counts,
}

/// Where a chain counts as a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Counts {
    /// Where the surface turns.
    IfItTurns,
    /// It goes round a tube, as the rows of a tessellation do: where the surface turns much.
    IfItTurnsMuch,
    /// Anywhere.
    ThoughSmooth,
}

/// A chain of edges each of which goes straight on with the next.
#[derive(Default)]
struct Chain {
    edges: Vec<u32>,
    /// Turn between each edge and the next in degrees; one more where it is closed.
    turns: Vec<f64>,
    closed: bool,
    /// Ends, how many of them, at a border or another curve.
    ends: usize,
}

impl Chain {
    /// Greatest turn in size.
    fn most_turn(&self) -> f64 {
        self.turns.iter().map(|turn| turn.abs()).fold(0.0, f64::max)
    }
}

/// How edges go on through the vertices inside a part.
pub(crate) struct Chains<'a> {
    topology: &'a Topology,
    edges: &'a Edges,
    /// What each edge goes on with, and by how many degrees that turns to one side.
    goes_on: HashMap<Step, (u32, f64)>,
    /// Vertices through which an edge goes on.
    inside: HashSet<u32>,
    /// Turns in size, rising.
    turns: Vec<f64>,
    /// Differences in size between a turn and the next, rising.
    changes: Vec<f64>,
}

impl<'a> Chains<'a> {
    pub fn of(positions: &[DVec3], topology: &'a Topology, edges: &'a Edges) -> Self {
        let inner: HashSet<u32> = edges.iter().map(|&(edge, _)| edge).collect();
        let ends = |&(edge, _): &(u32, _)| topology.edge_vertices[edge as usize];
        let mut vertices: Vec<u32> = edges.iter().flat_map(ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let is_inside = |&vertex: &u32| {
            let mut around = topology.vertex_edges.row(vertex as usize).iter();
            around.all(|edge| inner.contains(edge))
        };
        let pairs = |vertex: u32| {
            let pairs = fan(positions, topology, vertex).map(|fan| straightest(&fan));
            let pairs = pairs.into_iter().flatten();
            pairs.flat_map(move |(from, to, turn)| {
                let forth = ((from, vertex), (to, turn));
                [forth, ((to, vertex), (from, -turn))]
            })
        };
        let inside = vertices.into_par_iter().filter(is_inside);
        let goes_on: Vec<(Step, (u32, f64))> = inside.flat_map_iter(pairs).collect();
        let goes_on: HashMap<Step, (u32, f64)> = goes_on.into_iter().collect();
        let change = |(&(_, vertex), &(next, turn)): (&Step, &(u32, f64))| {
            let (_, after) = goes_on.get(&(next, topology.far_end(next, vertex)))?;
            Some((after - turn).abs())
        };
        let mut changes: Vec<f64> = goes_on.iter().filter_map(change).collect();
        let mut turns: Vec<f64> = goes_on.values().map(|(_, turn)| turn.abs()).collect();
        changes.sort_unstable_by(f64::total_cmp);
        turns.sort_unstable_by(f64::total_cmp);
        Self {
            topology,
            edges,
            inside: goes_on.keys().map(|&(_, vertex)| vertex).collect(),
            goes_on,
            turns,
            changes,
        }
    }

    /// The chains that count. They end at the border of the part, at one another, or at rows of the tessellation, or close.
    /// Rows do not count, but end others all the same: without, bottles and chessmen are cut from rim to rim (ARI .001 and
    /// .003 less over 161 and 132 meshes).
    pub fn curves(&self) -> Vec<Curve> {
        let mut curves: Vec<Curve> = Vec::new();
        let [mut taken, mut stops] = [HashSet::default(), HashSet::default()];
        let mut tests = None;
        for _ in 0..MOST_ROUNDS {
            let mut ends_others = Vec::new();
            let all = self.all(&taken, &stops);
            let tests = *tests.get_or_insert(all.len() as f64);
            for chain in all.into_iter().filter(|c| c.closed || c.ends == 2) {
                let false_alarms = tests * self.chance(&chain);
                if false_alarms >= FALSE_ALARMS {
                    continue;
                }
                ends_others.extend(chain.edges.iter().copied());
                if let Some(counts) = self.counts(&chain, false_alarms) {
                    let edges = chain.edges;
                    curves.push(Curve { edges, counts });
                }
            }
            if ends_others.is_empty() {
                break;
            }
            for edge in ends_others {
                taken.insert(edge);
                stops.extend(self.topology.edge_vertices[edge as usize]);
            }
        }
        curves
    }

    /// Where a chain that chance would hardly give counts. `None` for what may be a row of a tessellation.
    fn counts(&self, chain: &Chain, false_alarms: f64) -> Option<Counts> {
        let sure = false_alarms < FALSE_ALARMS_IF_SMOOTH;
        match (chain.closed, sure) {
            (true, false) => None,
            _ if self.share_in_rows(chain) >= IN_ROWS => None,
            (true, true) => Some(Counts::IfItTurnsMuch),
            (false, true) => Some(Counts::ThoughSmooth),
            (false, false) => Some(Counts::IfItTurns),
        }
    }

    /// How likely a chain of as many edges is that goes as straight on, or turns as evenly.
    fn chance(&self, chain: &Chain) -> f64 {
        let pairs = chain.turns.windows(2);
        let most_change = pairs.map(|t| (t[1] - t[0]).abs()).fold(0.0, f64::max);
        let turns = chain.turns.len();
        let straight = share_up_to(&self.turns, chain.most_turn()).powi(turns as i32);
        let even = share_up_to(&self.changes, most_change).powi(turns.saturating_sub(1) as i32);
        straight.min(even)
    }

    /// All chains of edges not `taken`, which end at the latest at the vertices of `stops`.
    fn all(&self, taken: &HashSet<u32>, stops: &HashSet<u32>) -> Vec<Chain> {
        let mut seen = taken.clone();
        let mut all = Vec::new();
        for &(edge, _) in self.edges {
            if !seen.insert(edge) {
                continue;
            }
            let [a, b] = self.topology.edge_vertices[edge as usize];
            let mut chain = Chain {
                edges: vec![edge],
                ..Chain::default()
            };
            let end = self.follow((edge, b), &mut seen, stops, &mut chain);
            if !chain.closed {
                chain.edges.reverse();
                chain.turns = chain.turns.iter().rev().map(|turn| -turn).collect();
                let begin = self.follow((edge, a), &mut seen, stops, &mut chain);
                // A ring that a seam crosses is still one.
                chain.closed = end == begin;
            }
            all.push(chain);
        }
        all
    }

    /// Goes on from the last edge of a chain as long as it goes straight on. Gives the vertex it ends at.
    fn follow(
        &self,
        from: Step,
        seen: &mut HashSet<u32>,
        stops: &HashSet<u32>,
        chain: &mut Chain,
    ) -> u32 {
        let (mut edge, mut vertex) = from;
        loop {
            if stops.contains(&vertex) || self.is_at_border(vertex) {
                chain.ends += 1;
                return vertex;
            }
            let Some(&(next, turn)) = self.goes_on.get(&(edge, vertex)) else {
                return vertex;
            };
            if next == from.0 && turn.abs() <= MOST_TURN_DEG {
                chain.turns.push(turn);
                chain.closed = true;
                return vertex;
            }
            if turn.abs() > MOST_TURN_DEG || !seen.insert(next) {
                return vertex;
            }
            chain.edges.push(next);
            chain.turns.push(turn);
            vertex = self.topology.far_end(next, vertex);
            edge = next;
        }
    }

    /// The edges at a vertex, each with its other end.
    fn around(&self, vertex: u32) -> impl Iterator<Item = Step> {
        let edges = self.topology.vertex_edges.row(vertex as usize).iter();
        edges.map(move |&edge| (edge, self.topology.far_end(edge, vertex)))
    }

    /// Does a vertex lie at the border of the part, so that nothing goes on through it?
    fn is_at_border(&self, vertex: u32) -> bool {
        !self.inside.contains(&vertex)
    }

    /// Share of the vertices beside a chain that lie in rows along it which are as straight.
    fn share_in_rows(&self, chain: &Chain) -> f64 {
        let straight = AS_STRAIGHT_DEG + chain.most_turn();
        let ends = |&edge: &u32| self.topology.edge_vertices[edge as usize];
        let on: HashSet<u32> = chain.edges.iter().flat_map(ends).collect();
        let fan = |vertex: u32| self.topology.vertex_edges.row(vertex as usize).len();
        let may_be_in_row = |vertex: u32| !self.is_at_border(vertex) && fan(vertex) <= LARGEST_FAN;
        let inside = on.iter().filter(|&&vertex| may_be_in_row(vertex));
        let beside: HashSet<u32> = inside
            .flat_map(|&vertex| self.around(vertex))
            .map(|(_, far)| far)
            .filter(|far| !on.contains(far) && may_be_in_row(*far))
            .collect();
        let in_row = |&&vertex: &&u32| {
            self.around(vertex).any(|(edge, far)| {
                let next = self.goes_on.get(&(edge, vertex));
                next.is_some_and(|&(next, turn)| {
                    turn.abs() <= straight
                        && [far, self.topology.far_end(next, vertex)]
                            .iter()
                            .all(|end| beside.contains(end))
                })
            })
        };
        beside.iter().filter(in_row).count() as f64 / beside.len().max(1) as f64
    }
}

/// Share of rising values up to one.
fn share_up_to(values: &[f64], most: f64) -> f64 {
    let count = values.partition_point(|&value| value <= most + SAME_DEG);
    count as f64 / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE: u32 = 24;
    const HIGH: u32 = 16;

    /// Squares in two triangles each; vertices inside are off the grid by up to `off`, those of the column `straight` are not.
    fn sheet(off: f64, straight: Option<u32>) -> (Vec<DVec3>, Topology) {
        let at = |x: u32, y: u32| y * (WIDE + 1) + x;
        let any = |seed: u32| (f64::from(seed) * 12.9898).sin() * 43758.5453 % 1.0;
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for y in 0..=HIGH {
            for x in 0..=WIDE {
                let inside = x % WIDE != 0 && y % HIGH != 0 && straight != Some(x);
                let off = if inside { off } else { 0.0 };
                let [dx, dy] = [1, 2].map(|i| off * any(2 * at(x, y) + i));
                positions.push(DVec3::new(f64::from(x) + dx, f64::from(y) + dy, 0.0));
                if x < WIDE && y < HIGH {
                    let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                    triangles.extend(if any(at(x, y)) > 0.0 {
                        [[a, b, c], [a, c, d]]
                    } else {
                        [[a, b, d], [b, c, d]]
                    });
                }
            }
        }
        let topology = Topology::build(positions.len(), triangles);
        (positions, topology)
    }

    fn curves(positions: &[DVec3], topology: &Topology) -> Vec<Curve> {
        let inner = |edge: usize| Some((edge as u32, topology.face_pair(edge)?));
        let edges: Vec<_> = (0..topology.edge_faces.len()).filter_map(inner).collect();
        Chains::of(positions, topology, &edges).curves()
    }

    #[test]
    fn the_curve_two_meshes_meet_in_counts_and_nothing_else_does() {
        let (positions, topology) = sheet(0.3, Some(9));
        let found = curves(&positions, &topology);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].counts, Counts::ThoughSmooth);
        assert_eq!(found[0].edges.len(), HIGH as usize);
        for &edge in &found[0].edges {
            let ends = topology.edge_vertices[edge as usize];
            assert!(ends.iter().all(|&v| positions[v as usize].x == 9.0));
        }
    }

    #[test]
    fn no_row_of_a_grid_counts() {
        let (positions, topology) = sheet(0.0, None);
        assert!(curves(&positions, &topology).is_empty());
    }

    #[test]
    fn chance_alone_gives_no_curve() {
        let (positions, topology) = sheet(0.3, None);
        assert!(curves(&positions, &topology).is_empty());
    }
}
