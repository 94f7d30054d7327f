//! Boundaries that run through triangles: smooth curves in place of the edges a mesh happens to have.
//!
//! A boundary that no crease holds is drawn along a smoothed copy of itself: vertices of the boundary get their signed
//! distance from it, and triangles are cut where the distance changes its sign. Sharp edges, junctions and what is
//! near other boundaries stay as they are.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;
use glam::DVec3;
use schemars::JsonSchema;
use seamline_ecs::components::{FaceLabel, Position, SharpEdge};
use seamline_ecs::settings::{Profile, StepSettings};
use seamline_ecs::{Column, ColumnMut, Counts, MeshTopology, Stage, boundary};
use seamline_mesh::{EdgeKind, Topology};
use serde::{Deserialize, Serialize};

/// The `[refine]` table: boundaries that cut triangles.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RefineSettings {
    /// May boundaries that are rectified run through triangles? New vertices are put on edges; `patches.ply` and
    /// `boundaries.obj` then show the finer mesh, labels are still one a face of the input, by most of its area.
    pub enabled: bool,
}

impl StepSettings for RefineSettings {
    const TABLE: &'static str = "refine";

    fn defaults(_: Profile) -> Self {
        Self { enabled: false }
    }
}

/// Rounds of smoothing, each the mean of a vertex and its two neighbours along the boundary. More shrink small circles.
const SMOOTHING_ROUNDS: usize = 5;

/// A cut keeps so far from the ends of its edge, as a share of it: nearer, slivers come of it.
const LEAST_SHARE: f64 = 0.05;

/// A vertex nearer to the smoothed boundary than this share of the edges beside it is on it: a boundary that is straight
/// stays as it is.
const STRAIGHT_SHARE: f64 = 0.1;

/// Stands for a vertex that is on no boundary that moves.
const FIXED: u32 = u32::MAX;

/// A mesh whose boundaries run through triangles, in rows.
#[derive(Resource, Clone, Debug, Default)]
pub struct RefinedRows {
    /// The edge and the share of the way along it of each new vertex, numbered after those there are.
    pub new_vertices: Vec<(u32, f64)>,
    /// All triangles, each with the face it is of and its label.
    pub triangles: Vec<([u32; 3], u32, FaceLabel)>,
    /// The label of most of each face.
    pub face_labels: Vec<FaceLabel>,
}

pub(crate) fn refine_boundaries(
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    sharp: Column<SharpEdge>,
    mut labels: ColumnMut<FaceLabel>,
    mut refined: ResMut<RefinedRows>,
    mut counts: ResMut<Counts>,
) {
    *refined = refine(&topology.0, &positions, &sharp, &labels);
    let added = refined.new_vertices.len();
    counts.note(Stage::Export, "vertices_added", added);
    most_of_each(&positions, &refined, &topology.0, &mut labels);
    refined.face_labels = labels.to_vec();
}

/// Cuts the triangles along smoothed boundaries. The labels of faces that are not cut may change as well.
pub fn refine(
    topology: &Topology,
    positions: &[Position],
    sharp: &[SharpEdge],
    labels: &[FaceLabel],
) -> RefinedRows {
    let field = Field::of(topology, positions, sharp, labels);
    let mut refined = RefinedRows::default();
    let mut at_edge: BTreeMap<u32, u32> = BTreeMap::new();
    for (face, &corners) in topology.triangles.iter().enumerate() {
        let run = corners.iter().copied().find(|&v| field.is_free(v));
        let Some(free) = run else {
            refined.triangles.push((corners, face as u32, labels[face]));
            continue;
        };
        let sides = field.sides(free);
        let signs = corners.map(|v| field.sign(v, labels[face], sides));
        let label_of = |sign: i8| match sign {
            0 => labels[face],
            1 => sides[0],
            _ => sides[1],
        };
        let mut cut = |corner: usize| {
            let edge = topology.face_edges[face][corner];
            *at_edge.entry(edge).or_insert_with(|| {
                refined
                    .new_vertices
                    .push((edge, field.share(topology, positions, edge)));
                (positions.len() + refined.new_vertices.len() - 1) as u32
            })
        };
        let pieces = split(corners, signs, &mut cut);
        let pieces = pieces.into_iter();
        refined
            .triangles
            .extend(pieces.map(|(piece, sign)| (piece, face as u32, label_of(sign))));
    }
    refined
}

/// The pieces of a triangle whose corners lie on either side of a curve, or on it, each with its side. `cut` gives the
/// new vertex on the edge from a corner to the next.
fn split(
    corners: [u32; 3],
    signs: [i8; 3],
    cut: &mut impl FnMut(usize) -> u32,
) -> Vec<([u32; 3], i8)> {
    let whole = signs.iter().copied().find(|&sign| sign != 0).unwrap_or(0);
    if signs.iter().all(|&sign| sign == 0 || sign == whole) {
        return vec![(corners, whole)];
    }
    // Turned so that the first corner is on the curve, or alone on its side.
    let first = signs
        .iter()
        .position(|&sign| sign == 0)
        .or_else(|| (0..3).find(|&i| signs.iter().filter(|&&s| s == signs[i]).count() == 1))
        .unwrap_or(0);
    let [i, j, k] = [first, (first + 1) % 3, (first + 2) % 3];
    let [a, b, c] = [corners[i], corners[j], corners[k]];
    if signs[i] == 0 {
        let m = cut(j);
        return vec![([a, b, m], signs[j]), ([a, m, c], signs[k])];
    }
    let (m, n) = (cut(i), cut(k));
    vec![
        ([a, m, n], signs[i]),
        ([m, b, c], signs[j]),
        ([m, c, n], signs[j]),
    ]
}

/// Signed distances from the smoothed boundaries, at the vertices that may leave them.
struct Field {
    /// By vertex: its place among the free ones, or [`FIXED`].
    free_of: Vec<u32>,
    /// Of each free vertex: the labels on its positive and on its negative side.
    sides: Vec<[FaceLabel; 2]>,
    /// Of each free vertex.
    distances: Vec<f64>,
    /// Of each free vertex: the smoothed curve through it.
    curves: Vec<[DVec3; 3]>,
    on_boundary: Vec<bool>,
}

impl Field {
    fn of(
        topology: &Topology,
        positions: &[Position],
        sharp: &[SharpEdge],
        labels: &[FaceLabel],
    ) -> Self {
        let mut at: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let mut on_boundary = vec![false; positions.len()];
        for edge in boundary(topology, labels) {
            for v in topology.edge_vertices[edge as usize] {
                at.entry(v).or_default().push(edge);
                on_boundary[v as usize] = true;
            }
        }
        let sides_of = |v: u32| -> Option<[FaceLabel; 2]> {
            let faces = topology.vertex_faces.row(v as usize).iter();
            let mut found: Vec<FaceLabel> = faces.map(|&face| labels[face as usize]).collect();
            found.sort_unstable_by_key(|label| label.0);
            found.dedup();
            found.try_into().ok()
        };
        let is_smooth = |edge: &u32| {
            topology.edge_kind[*edge as usize] == EdgeKind::Regular && !sharp[*edge as usize].0
        };
        let mut candidates: BTreeMap<u32, ([u32; 2], [FaceLabel; 2])> = BTreeMap::new();
        for (&v, edges) in &at {
            let all_regular = topology.vertex_edges.row(v as usize).iter().all(is_smooth);
            if let ([a, b], true, Some(sides)) = (&edges[..], all_regular, sides_of(v)) {
                let ends = [*a, *b].map(|edge| topology.far_end(edge, v));
                candidates.insert(v, (ends, sides));
            }
        }
        // Near other boundaries, and beside what stays, nothing moves.
        let stays = |v: u32, ends: &[u32; 2], sides: &[FaceLabel; 2]| {
            let around = topology.vertex_edges.row(v as usize).iter();
            around.map(|&edge| topology.far_end(edge, v)).any(|w| {
                on_boundary[w as usize]
                    && !ends.contains(&w)
                    && candidates.get(&w).is_none_or(|other| other.1 != *sides)
            })
        };
        let free: Vec<(u32, [u32; 2], [FaceLabel; 2])> = candidates
            .iter()
            .filter(|(v, (ends, sides))| !stays(**v, ends, sides))
            .map(|(&v, &(ends, sides))| (v, ends, sides))
            .collect();
        let mut free_of = vec![FIXED; positions.len()];
        for (i, (v, ..)) in free.iter().enumerate() {
            free_of[*v as usize] = i as u32;
        }
        let mut smooth: Vec<DVec3> = free.iter().map(|f| positions[f.0 as usize].0).collect();
        let place = |smooth: &[DVec3], v: u32| match free_of[v as usize] {
            FIXED => positions[v as usize].0,
            i => smooth[i as usize],
        };
        for _ in 0..SMOOTHING_ROUNDS {
            let mean = |(i, (_, [a, b], _)): (usize, &(u32, [u32; 2], _))| {
                (place(&smooth, *a) + 2.0 * smooth[i] + place(&smooth, *b)) / 4.0
            };
            smooth = free.iter().enumerate().map(mean).collect();
        }
        let curve = |(i, (_, [a, b], _)): (usize, &(u32, [u32; 2], _))| {
            [place(&smooth, *a), smooth[i], place(&smooth, *b)]
        };
        let curves: Vec<[DVec3; 3]> = free.iter().enumerate().map(curve).collect();
        let distances = free
            .iter()
            .zip(&smooth)
            .map(|(&(v, [a, b], sides), &to)| {
                let from = positions[v as usize].0;
                // Towards the positive side, across the boundary.
                let mut across = DVec3::ZERO;
                for &face in topology.vertex_faces.row(v as usize) {
                    let corners = topology.triangles[face as usize];
                    let middle = corners
                        .iter()
                        .map(|&c| positions[c as usize].0)
                        .sum::<DVec3>()
                        / 3.0;
                    let out = (middle - from).normalize_or_zero();
                    across += if labels[face as usize] == sides[0] {
                        out
                    } else {
                        -out
                    };
                }
                let edges = (positions[a as usize].0.distance(from)
                    + positions[b as usize].0.distance(from))
                    / 2.0;
                let distance = -(to - from).dot(across.normalize_or_zero());
                if distance.abs() < STRAIGHT_SHARE * edges {
                    0.0
                } else {
                    distance
                }
            })
            .collect();
        Self {
            free_of,
            sides: free.iter().map(|f| f.2).collect(),
            distances,
            curves,
            on_boundary,
        }
    }

    fn is_free(&self, vertex: u32) -> bool {
        self.free_of[vertex as usize] != FIXED
    }

    fn sides(&self, free: u32) -> [FaceLabel; 2] {
        self.sides[self.free_of[free as usize] as usize]
    }

    /// The side of a corner of a face: 1, -1, or 0 on the curve.
    fn sign(&self, vertex: u32, label: FaceLabel, sides: [FaceLabel; 2]) -> i8 {
        match self.free_of[vertex as usize] {
            FIXED if self.on_boundary[vertex as usize] => 0,
            FIXED => {
                if label == sides[0] {
                    1
                } else {
                    -1
                }
            }
            i => match self.distances[i as usize] {
                d if d > 0.0 => 1,
                d if d < 0.0 => -1,
                _ => 0,
            },
        }
    }

    /// How far along an edge, from its lower vertex, the curve crosses it.
    fn share(&self, topology: &Topology, positions: &[Position], edge: u32) -> f64 {
        let ends = topology.edge_vertices[edge as usize];
        let distance = |v: u32, other: u32| match self.free_of[v as usize] {
            FIXED => {
                let at = positions[v as usize].0;
                let curve = self.curves[self.free_of[other as usize] as usize];
                to_segment(at, curve[0], curve[1]).min(to_segment(at, curve[1], curve[2]))
            }
            i => self.distances[i as usize].abs(),
        };
        let [a, b] = [distance(ends[0], ends[1]), distance(ends[1], ends[0])];
        let share = if a + b > 0.0 { a / (a + b) } else { 0.5 };
        share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE)
    }
}

fn to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let t = if length > 0.0 {
        ((p - a).dot(along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance(a + t * along)
}

/// Where a vertex of the refined mesh is.
pub(crate) fn refined_at(
    positions: &[Position],
    refined: &RefinedRows,
    topology: &Topology,
    vertex: u32,
) -> DVec3 {
    match positions.get(vertex as usize) {
        Some(position) => position.0,
        None => {
            let (edge, share) = refined.new_vertices[vertex as usize - positions.len()];
            let [a, b] = topology.edge_vertices[edge as usize].map(|v| positions[v as usize].0);
            a.lerp(b, share)
        }
    }
}

/// Each face gets the label of most of its area; of equals the lower. The last face of a label keeps it: no patch is cut
/// away.
fn most_of_each(
    positions: &[Position],
    refined: &RefinedRows,
    topology: &Topology,
    labels: &mut [FaceLabel],
) {
    let at = |v: u32| refined_at(positions, refined, topology, v);
    let mut faces_of: BTreeMap<u32, usize> = BTreeMap::new();
    for label in labels.iter() {
        *faces_of.entry(label.0).or_default() += 1;
    }
    for pieces in refined.triangles.chunk_by(|a, b| a.1 == b.1) {
        let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
        for (corners, _, label) in pieces {
            let [a, b, c] = corners.map(at);
            *areas.entry(label.0).or_default() += (b - a).cross(c - a).length();
        }
        let most = areas
            .iter()
            .max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(a.0)));
        if let Some((&label, _)) = most {
            let face = &mut labels[pieces[0].1 as usize].0;
            if faces_of.get(face) == Some(&1) {
                continue;
            }
            *faces_of.entry(*face).or_default() -= 1;
            *faces_of.entry(label).or_default() += 1;
            *face = label;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 8;

    /// A sheet of squares, each cut along the same diagonal, whose halves meet in stairs along a slanted line.
    fn sheet() -> (Topology, Vec<Position>, Vec<FaceLabel>) {
        let at = |x: u32, y: u32| y * (SIDE + 1) + x;
        let mut triangles = Vec::new();
        let mut labels = Vec::new();
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
            let right = |dx: f64, dy: f64| f64::from(x) + dx > 2.2 + 0.4 * (f64::from(y) + dy);
            let right = [right(2.0 / 3.0, 1.0 / 3.0), right(1.0 / 3.0, 2.0 / 3.0)];
            labels.extend(right.map(|right| FaceLabel(u32::from(right))));
        }
        let corners = (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| (x, y)));
        let positions: Vec<_> = corners
            .map(|(x, y)| Position(DVec3::new(f64::from(x), f64::from(y), 0.0)))
            .collect();
        (
            Topology::build(positions.len(), triangles),
            positions,
            labels,
        )
    }

    fn length(at: impl Fn(u32) -> DVec3, triangles: &[[u32; 3]], labels: &[FaceLabel]) -> f64 {
        let count = triangles
            .as_flattened()
            .iter()
            .max()
            .map_or(0, |&v| v as usize + 1);
        let topology = Topology::build(count, triangles.to_vec());
        assert!(
            topology
                .edge_kind
                .iter()
                .all(|&kind| kind != EdgeKind::NonManifold)
        );
        let edges = boundary(&topology, labels).into_iter();
        edges
            .map(|edge| {
                let [a, b] = topology.edge_vertices[edge as usize].map(&at);
                a.distance(b)
            })
            .sum()
    }

    #[test]
    fn stairs_become_shorter_and_no_area_is_lost_or_turned_over() {
        let (topology, positions, labels) = sheet();
        let sharp = vec![SharpEdge(false); topology.edge_faces.len()];
        let refined = refine(&topology, &positions, &sharp, &labels);
        let at = |v: u32| refined_at(&positions, &refined, &topology, v);
        let before = length(|v| positions[v as usize].0, &topology.triangles, &labels);
        let (triangles, after_labels): (Vec<_>, Vec<_>) =
            refined.triangles.iter().map(|t| (t.0, t.2)).unzip();
        let after = length(at, &triangles, &after_labels);
        assert!(!refined.new_vertices.is_empty());
        assert!(after < 0.95 * before, "{before} becomes {after}");
        let areas: Vec<f64> = triangles
            .iter()
            .map(|corners| {
                let [a, b, c] = corners.map(at);
                (b - a).cross(c - a).z / 2.0
            })
            .collect();
        assert!(areas.iter().all(|&area| area > 0.0));
        assert!((areas.iter().sum::<f64>() - f64::from(SIDE * SIDE)).abs() < 1e-9);
        // Every edge has the same triangles on its two sides as before: nothing hangs.
        let count = positions.len() + refined.new_vertices.len();
        let border = |t: &Topology| {
            t.edge_kind
                .iter()
                .filter(|k| **k == EdgeKind::Border)
                .count()
        };
        assert_eq!(
            border(&Topology::build(count, triangles)),
            border(&topology)
        );
    }

    #[test]
    fn sharp_boundaries_stay() {
        let (topology, positions, labels) = sheet();
        let sharp = vec![SharpEdge(true); topology.edge_faces.len()];
        let refined = refine(&topology, &positions, &sharp, &labels);
        assert!(refined.new_vertices.is_empty());
        assert!(
            refined
                .triangles
                .iter()
                .all(|t| t.2 == labels[t.1 as usize])
        );
    }

    #[test]
    fn a_patch_of_one_face_keeps_it() {
        let (topology, positions, mut labels) = sheet();
        let whole = FaceLabel(0);
        labels.fill(whole);
        let alone = labels.len() / 2;
        labels[alone] = FaceLabel(1);
        let refined = RefinedRows {
            triangles: topology
                .triangles
                .iter()
                .enumerate()
                .map(|(face, &corners)| (corners, face as u32, whole))
                .collect(),
            ..RefinedRows::default()
        };
        most_of_each(&positions, &refined, &topology, &mut labels);
        assert_eq!(labels[alone], FaceLabel(1));
        assert_eq!(labels[alone + 1], whole);
    }

    #[test]
    fn a_face_has_the_label_of_most_of_its_area() {
        let (topology, positions, mut labels) = sheet();
        let sharp = vec![SharpEdge(false); topology.edge_faces.len()];
        let refined = refine(&topology, &positions, &sharp, &labels);
        most_of_each(&positions, &refined, &topology, &mut labels);
        for pieces in refined.triangles.chunk_by(|a, b| a.1 == b.1) {
            let label = labels[pieces[0].1 as usize];
            assert!(pieces.iter().any(|piece| piece.2 == label));
        }
    }
}
