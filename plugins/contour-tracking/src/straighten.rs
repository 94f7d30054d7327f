//! Labels with rough boundaries, made straight before their edges are looked at one by one.
//!
//! A face that went over to the wrong side leaves no trace in the mesh: inside a flat piece nothing tells one triangle
//! from the next. So pieces are labelled, not triangles, and what a piece says of itself is weighed against how
//! badly each of its sides would serve as a boundary.

use std::collections::VecDeque;

use rayon::prelude::*;
use seamline_ecs::components::{FaceLabel, NONE};
use seamline_ecs::{Evidence, LabelledMesh};
use seamline_mesh::Sets;

use crate::outvote::{Outvoted, outvote};

/// Triangles that turn by less than this are one piece, as with facets.
const FLAT_DEG: f64 = 0.1;

/// A piece of so many triangles whose labels are this far from being one is two patches by somebody's will.
const MANY: u32 = 8;
const MINORITY_SHARE: f64 = 0.4;

/// Rounds in which pieces learn of those further on.
const ROUNDS: u32 = 20;

/// A label is given up only for one that is better by more than rounding.
const BETTER: f64 = 1.0 + 1e-9;

/// Gives the pieces beside `rough` edges, and those beside pieces that have changed, the label of least cost, until
/// none changes. A label costs a piece, for each side with another label beyond, the length times the score of
/// the edge (a sharp one costs nothing), and `vote_weight` times its perimeter times the share of its area that
/// bore another label.
///
/// Each change lowers the sum of all costs, so it ends. Pieces whose label their [surface settles](outvote) do not change
/// any more; the edges between those are given as proved.
pub fn straighten(
    mesh: &LabelledMesh<'_>,
    evidence: &dyn Evidence,
    rough: &[u32],
    vote_weight: f64,
) -> (Vec<FaceLabel>, Vec<u32>) {
    let Outvoted {
        labels,
        settled_by,
        proved,
    } = outvote(mesh, &evidence.surfaces(), rough);
    let mesh = &LabelledMesh {
        labels: &labels,
        ..*mesh
    };
    let mut pieces = Pieces::of(mesh, &settled_by);
    let cost_of = |edge: u32| match mesh.sharp[edge as usize].0 {
        true => 0.0,
        false => mesh.edge_length(edge as usize) * evidence.score(edge) / 90.0,
    };
    let mut active: Vec<u32> = rough
        .iter()
        .filter_map(|&edge| mesh.topology.face_pair(edge as usize))
        .flat_map(|faces| faces.map(|face| pieces.of_face[face as usize]))
        .collect();
    active.sort_unstable();
    active.dedup();
    active.retain(|&piece| !pieces.settled[piece as usize]);
    active
        .iter()
        .for_each(|&piece| pieces.weigh_sides(piece, cost_of));
    let mut labels = share_out(&pieces, &active, vote_weight);
    settle(&mut pieces, cost_of, &active, vote_weight, &mut labels);
    while move_groups(&pieces, &active, vote_weight, &mut labels) {
        settle(&mut pieces, cost_of, &active, vote_weight, &mut labels);
    }
    let label = |&piece: &u32| FaceLabel(labels[piece as usize]);
    (pieces.of_face.iter().map(label).collect(), proved)
}

/// The label each piece leans to: the active ones lean as they vote themselves and as those beside them lean, all at
/// once, round after round. Alone, a strip of which one triangle of two is wrong cannot tell which.
fn share_out(pieces: &Pieces, active: &[u32], vote_weight: f64) -> Vec<u32> {
    let mut leanings: Vec<Vec<(u32, f64)>> = (0..pieces.count())
        .map(|piece| pieces.votes(piece).to_vec())
        .collect();
    for _ in 0..ROUNDS {
        let next: Vec<Vec<(u32, f64)>> = active
            .par_iter()
            .with_min_len(256)
            .map(|&piece| {
                let piece = piece as usize;
                let weight = vote_weight * pieces.perimeters[piece];
                let own = pieces
                    .votes(piece)
                    .iter()
                    .map(|&(l, share)| (l, weight * share));
                let beyond = pieces.sides(piece).iter().flat_map(|&(other, cost)| {
                    let leaning = &leanings[other as usize];
                    leaning.iter().map(move |&(l, share)| (l, cost * share))
                });
                let mut sums = summed(own.chain(beyond));
                let whole: f64 = sums.iter().map(|(_, sum)| sum).sum();
                // Between sharp edges alone, with no weight on votes, nothing speaks for any label but the piece's own.
                if whole == 0.0 {
                    return pieces.votes(piece).to_vec();
                }
                sums.iter_mut().for_each(|(_, sum)| *sum /= whole);
                sums
            })
            .collect();
        for (&piece, leaning) in active.iter().zip(next) {
            leanings[piece as usize] = leaning;
        }
    }
    let leaning = leanings.iter();
    leaning.map(|sums| most(sums, None)).collect()
}

/// Gives active pieces, and those beside pieces that have changed, the label of least cost until none changes.
fn settle(
    pieces: &mut Pieces,
    cost_of: impl Fn(u32) -> f64 + Copy,
    active: &[u32],
    vote_weight: f64,
    labels: &mut [u32],
) {
    let mut waits = vec![false; pieces.count()];
    active
        .iter()
        .for_each(|&piece| waits[piece as usize] = true);
    let mut queue: VecDeque<u32> = active.iter().copied().collect();
    while let Some(piece) = queue.pop_front() {
        pieces.weigh_sides(piece, cost_of);
        let piece = piece as usize;
        waits[piece] = false;
        let weight = vote_weight * pieces.perimeters[piece];
        let votes = pieces
            .votes(piece)
            .iter()
            .map(|&(l, share)| (l, weight * share));
        let sides = pieces
            .sides(piece)
            .iter()
            .map(|&(other, cost)| (labels[other as usize], cost));
        let best = most(&summed(votes.chain(sides)), Some(labels[piece]));
        if best == labels[piece] {
            continue;
        }
        labels[piece] = best;
        for &(other, _) in pieces.sides(piece) {
            let other_waits = &mut waits[other as usize];
            if !pieces.settled[other as usize] && !std::mem::replace(other_waits, true) {
                queue.push_back(other);
            }
        }
    }
}

/// Gives groups of pieces the label of least cost: those that hang together, have one label, and have faces that bore
/// another. Of two strips that went over together neither goes back alone. True if any has changed.
fn move_groups(pieces: &Pieces, active: &[u32], vote_weight: f64, labels: &mut [u32]) -> bool {
    let doubtful: Vec<u32> = active
        .iter()
        .copied()
        .filter(|&piece| pieces.votes(piece as usize).len() > 1)
        .collect();
    let place = |piece: u32| doubtful.binary_search(&piece).ok();
    let mut sets = Sets::new(doubtful.len());
    for (at, &piece) in doubtful.iter().enumerate() {
        for &(other, _) in pieces.sides(piece as usize) {
            if labels[other as usize] == labels[piece as usize]
                && let Some(other) = place(other)
            {
                sets.unite(at as u32, other as u32);
            }
        }
    }
    let (group_of, count) = sets.numbered();
    let mut groups: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (&piece, &group) in doubtful.iter().zip(&group_of) {
        groups[group as usize].push(piece);
    }
    let mut changed = false;
    for group in groups.iter().filter(|group| group.len() > 1) {
        let votes = group.iter().flat_map(|&piece| {
            let weight = vote_weight * pieces.perimeters[piece as usize];
            let votes = pieces.votes(piece as usize).iter();
            votes.map(move |&(label, share)| (label, weight * share))
        });
        let sides = group.iter().flat_map(|&piece| pieces.sides(piece as usize));
        let sides = sides
            .filter(|(other, _)| group.binary_search(other).is_err())
            .map(|&(other, cost)| (labels[other as usize], cost));
        let own = labels[group[0] as usize];
        let best = most(&summed(votes.chain(sides)), Some(own));
        if best != own {
            changed = true;
            group
                .iter()
                .for_each(|&piece| labels[piece as usize] = best);
        }
    }
    changed
}

/// What is said for each label, by label.
fn summed(said: impl Iterator<Item = (u32, f64)>) -> Vec<(u32, f64)> {
    let mut sums: Vec<(u32, f64)> = Vec::new();
    for (label, weight) in said {
        match sums.iter_mut().find(|(known, _)| *known == label) {
            Some((_, sum)) => *sum += weight,
            None => sums.push((label, weight)),
        }
    }
    sums.sort_unstable_by_key(|&(label, _)| label);
    sums
}

/// The label for which most is said; of equals the lower, but `own` before all others.
fn most(sums: &[(u32, f64)], own: Option<u32>) -> u32 {
    let first = sums.iter().find(|(label, _)| Some(*label) == own);
    let first = first.or(sums.first()).copied();
    let mut best = first.unwrap_or((own.unwrap_or(0), 0.0));
    for &(label, sum) in sums {
        if sum > best.1 * BETTER {
            best = (label, sum);
        }
    }
    best.0
}

/// Flat pieces of a labelled mesh. Where labels part one in earnest, each of its triangles is a piece.
struct Pieces {
    of_face: Vec<u32>,
    /// By piece: is its label settled by the surface it is?
    settled: Vec<bool>,
    perimeters: Vec<f64>,
    /// By piece: where its votes and its sides begin.
    starts: Vec<[usize; 2]>,
    /// A label, and the share of the piece that bears it; half as much again as it could be for a label that is nowhere
    /// else.
    votes: Vec<(u32, f64)>,
    /// The piece beyond, and what a boundary there would cost; not a number before it is weighed.
    sides: Vec<(u32, f64)>,
    /// The edge of each side.
    side_edges: Vec<u32>,
}

impl Pieces {
    fn of(mesh: &LabelledMesh<'_>, settled_by: &[u32]) -> Self {
        let of_face = pieces(mesh, settled_by);
        let count = of_face.iter().max().map_or(0, |&last| last as usize + 1);
        let mut settled = vec![false; count];
        for (&piece, &surface) in of_face.iter().zip(settled_by) {
            settled[piece as usize] |= surface != NONE;
        }
        let mut votes = votes(mesh, &of_face);
        let mut areas = vec![0.0; count];
        votes
            .iter()
            .for_each(|&(piece, _, area)| areas[piece as usize] += area);
        let mut label_areas = vec![0.0; mesh.labels.len()];
        votes
            .iter()
            .for_each(|&(_, label, area)| label_areas[label as usize] += area);
        for (piece, label, area) in &mut votes {
            let (whole, of_label) = (areas[*piece as usize], label_areas[*label as usize]);
            let share = |of: f64| if of > 0.0 { *area / of } else { 1.0 };
            *area = share(whole) * (1.0 + share(of_label)) / 2.0;
        }
        let mut perimeters = vec![0.0; count];
        let mut sides: Vec<(u32, u32, u32)> = Vec::new();
        for edge in 0..mesh.angles.len() {
            let Some(faces) = mesh.topology.face_pair(edge) else {
                continue;
            };
            let [p, q] = faces.map(|face| of_face[face as usize]);
            if p != q {
                let length = mesh.edge_length(edge);
                sides.extend([(p, q, edge as u32), (q, p, edge as u32)]);
                perimeters[p as usize] += length;
                perimeters[q as usize] += length;
            }
        }
        sides.sort_by_key(|&(piece, ..)| piece);
        let mut starts = vec![[0; 2]; count + 1];
        votes
            .iter()
            .for_each(|&(piece, ..)| starts[piece as usize + 1][0] += 1);
        sides
            .iter()
            .for_each(|&(piece, ..)| starts[piece as usize + 1][1] += 1);
        for piece in 0..count {
            let [votes, sides] = starts[piece];
            starts[piece + 1][0] += votes;
            starts[piece + 1][1] += sides;
        }
        Self {
            of_face,
            settled,
            perimeters,
            starts,
            votes: votes
                .into_iter()
                .map(|(_, label, share)| (label, share))
                .collect(),
            sides: sides
                .iter()
                .map(|&(_, other, _)| (other, f64::NAN))
                .collect(),
            side_edges: sides.into_iter().map(|(.., edge)| edge).collect(),
        }
    }

    /// Has the costs of a piece's sides known.
    fn weigh_sides(&mut self, piece: u32, cost_of: impl Fn(u32) -> f64) {
        let range = self.starts[piece as usize][1]..self.starts[piece as usize + 1][1];
        for ((_, cost), &edge) in self.sides[range.clone()]
            .iter_mut()
            .zip(&self.side_edges[range])
        {
            if cost.is_nan() {
                *cost = cost_of(edge);
            }
        }
    }

    fn count(&self) -> usize {
        self.perimeters.len()
    }

    fn votes(&self, piece: usize) -> &[(u32, f64)] {
        &self.votes[self.starts[piece][0]..self.starts[piece + 1][0]]
    }

    fn sides(&self, piece: usize) -> &[(u32, f64)] {
        &self.sides[self.starts[piece][1]..self.starts[piece + 1][1]]
    }
}

/// Faces of one surface that has settled their label are one piece, whatever the angles between them.
fn pieces(mesh: &LabelledMesh<'_>, settled_by: &[u32]) -> Vec<u32> {
    let flat = FLAT_DEG.to_radians();
    let mut sets = Sets::new(mesh.labels.len());
    for (edge, angle) in mesh.angles.iter().enumerate() {
        let Some([a, b]) = mesh.topology.face_pair(edge) else {
            continue;
        };
        let [on_a, on_b] = [a, b].map(|face| settled_by[face as usize]);
        let is_flat = !mesh.sharp[edge].0 && angle.0.abs() < flat;
        if on_a == on_b && (on_a != NONE || is_flat) {
            sets.unite(a, b);
        }
    }
    let (mut of_face, count) = sets.numbered();
    let mut faces = vec![0; count];
    of_face.iter().for_each(|&piece| faces[piece as usize] += 1);
    let mut parted = vec![false; count];
    for votes in votes(mesh, &of_face).chunk_by(|a, b| a.0 == b.0) {
        let piece = votes[0].0 as usize;
        parted[piece] = is_shared(faces[piece], votes.iter().map(|vote| vote.2));
    }
    let mut next = count as u32;
    for piece in &mut of_face {
        if parted[*piece as usize] {
            *piece = next;
            next += 1;
        }
    }
    of_face
}

/// Do labels of these areas share so many faces by somebody's will?
pub(crate) fn is_shared(faces: u32, areas: impl Iterator<Item = f64> + Clone) -> bool {
    let whole: f64 = areas.clone().sum();
    let most = areas.fold(0.0, f64::max);
    faces >= MANY && whole - most > MINORITY_SHARE * whole
}

/// Piece, label, and the area of the one that bears the other; sorted, each pair once.
pub(crate) fn votes(mesh: &LabelledMesh<'_>, of_face: &[u32]) -> Vec<(u32, u32, f64)> {
    let faces = of_face.iter().zip(mesh.labels).zip(mesh.shapes);
    let mut votes: Vec<(u32, u32, f64)> = faces
        .map(|((&piece, label), shape)| (piece, label.0, shape.area))
        .collect();
    votes.sort_by_key(|&(piece, label, _)| (piece, label));
    votes.dedup_by(|next, sum| {
        let same = (next.0, next.1) == (sum.0, sum.1);
        if same {
            sum.2 += next.2;
        }
        same
    });
    votes
}
