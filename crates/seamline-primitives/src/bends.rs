//! Strips across a torus, each of which lies on a cylinder of its tube's radius: two beside each other lie on the torus.

use std::collections::HashSet;

use crate::grow::Soil;
use crate::hypothesis::Hypothesis;
use crate::scout::{Scout, Tried};
use crate::surface::Kind;

/// Radii that differ by no more than this share are those of one tube.
const SAME_RADIUS: f64 = 0.02;
/// Cosine of the angle up to which two axes are one (half a degree).
const ONE_AXIS: f64 = 0.99996;

/// Tori tried on each two strong cylinders of one radius that meet smoothly and have different axes.
pub(crate) fn tori(soil: &mut Soil, before: &Tried, found: &[Hypothesis]) -> Vec<Hypothesis> {
    let view = soil.view;
    let mut holder = vec![None; view.pieces.count()];
    let mut on_torus = vec![false; view.pieces.count()];
    for (number, hypothesis) in found.iter().enumerate().filter(|(_, h)| h.strong) {
        for &piece in &hypothesis.pieces {
            match hypothesis.surface.kind {
                Kind::Cylinder => holder[piece as usize] = Some(number),
                Kind::Torus if hypothesis.exact => on_torus[piece as usize] = true,
                _ => {}
            }
        }
    }
    let mut tried = HashSet::new();
    let mut tori: Vec<Hypothesis> = Vec::new();
    for link in view.pieces.links.iter().filter(|link| !link.wall) {
        let [Some(a), Some(b)] = link.pieces.map(|p| holder[p as usize]) else {
            continue;
        };
        let [seed, other] = link.pieces;
        let known = on_torus[seed as usize] && on_torus[other as usize];
        if known || a == b || !bend(&found[a], &found[b]) || !tried.insert([a.min(b), a.max(b)]) {
            continue;
        }
        let mut pieces = found[a].pieces.clone();
        pieces.extend(&found[b].pieces);
        pieces.sort_unstable();
        pieces.dedup();
        if let Some(torus) = Scout::new(soil, seed, before).of_kind(Kind::Torus, &pieces) {
            for &piece in torus.pieces.iter().filter(|_| torus.strong && torus.exact) {
                on_torus[piece as usize] = true;
            }
            tori.push(torus);
        }
    }
    tori
}

/// Are two cylinders of one radius about different axes?
fn bend(a: &Hypothesis, b: &Hypothesis) -> bool {
    let [a, b] = [a.surface, b.surface];
    (a.a - b.a).abs() <= SAME_RADIUS * a.a && a.axis.dot(b.axis).abs() < ONE_AXIS
}
