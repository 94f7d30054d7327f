//! Which hypotheses to believe: greedily by evidence, strong ones first, weak ones where their borders
//! speak for them.

use std::collections::BinaryHeap;

use foldhash::HashSet;

use crate::hypothesis::{Hypothesis, View};
use crate::pieces::NONE;
use crate::regions::Regions;
use crate::surface::Kind;

/// Share of the smooth border of a weak torus, sphere or cylinder that must be tangent to something.
const TANGENT_SHARE: f64 = 0.7;
/// Share of the smooth border of a weak cone or a remnant that may be against something unexplained.
const UNEXPLAINED_SHARE: f64 = 0.3;

/// The connected pieces of a hypothesis that nobody owns, largest evidence first.
pub(crate) fn free_part(
    view: View,
    regions: &Regions,
    hypothesis: &Hypothesis,
    tolerance: f64,
) -> Option<Hypothesis> {
    let free: HashSet<u32> = hypothesis
        .pieces
        .iter()
        .copied()
        .filter(|&p| regions.owner[p as usize] == NONE)
        .collect();
    let mut left = free.clone();
    let mut largest: Vec<u32> = Vec::new();
    for &first in &hypothesis.pieces {
        if !left.remove(&first) {
            continue;
        }
        let mut part = vec![first];
        let mut at = 0;
        while at < part.len() {
            for link in view.pieces.smooth_links(part[at]) {
                let across = link.across(part[at]);
                if left.remove(&across) {
                    part.push(across);
                }
            }
            at += 1;
        }
        if part.len() > largest.len() {
            largest = part;
        }
    }
    (!largest.is_empty())
        .then(|| view.weigh(hypothesis.surface, hypothesis.sign, largest, tolerance))
        .filter(|part| part.evidence >= 1)
}

/// Goes through hypotheses by evidence. A hypothesis that lost pieces since it was weighed is weighed again
/// and comes up later; `believe` decides about one that is whole. Those not believed are given back.
pub(crate) fn select(
    view: View,
    regions: &mut Regions,
    hypotheses: Vec<Hypothesis>,
    tolerance: f64,
    mut believe: impl FnMut(&Regions, &Hypothesis) -> bool,
) -> Vec<Hypothesis> {
    let rank = |h: &Hypothesis, i: usize| {
        (
            h.evidence,
            std::cmp::Reverse(h.surface.kind),
            std::cmp::Reverse(i),
        )
    };
    let mut waiting: Vec<Option<Hypothesis>> = hypotheses.into_iter().map(Some).collect();
    let mut heap: BinaryHeap<_> = waiting
        .iter()
        .enumerate()
        .filter_map(|(i, h)| Some(rank(h.as_ref()?, i)))
        .collect();
    let mut rejected = Vec::new();
    while let Some((_, _, std::cmp::Reverse(i))) = heap.pop() {
        let Some(hypothesis) = waiting[i].take() else {
            continue;
        };
        let whole = hypothesis
            .pieces
            .iter()
            .all(|&p| regions.owner[p as usize] == NONE);
        if !whole {
            if let Some(part) = free_part(view, regions, &hypothesis, tolerance) {
                heap.push(rank(&part, i));
                waiting[i] = Some(part);
            }
        } else if believe(regions, &hypothesis) {
            regions.accept(hypothesis);
        } else {
            rejected.push(hypothesis);
        }
    }
    rejected
}

/// Do the borders of a weak hypothesis, or of what is left of a strong one, speak for it?
pub(crate) fn borders_speak_for(view: View, regions: &Regions, hypothesis: &Hypothesis) -> bool {
    let inside: HashSet<u32> = hypothesis.pieces.iter().copied().collect();
    let border = regions.border(view, hypothesis, |p| inside.contains(&p));
    let smooth = border.smooth();
    let by_tangency = matches!(
        hypothesis.surface.kind,
        Kind::Torus | Kind::Sphere | Kind::Cylinder
    );
    if by_tangency && !(hypothesis.strong && hypothesis.exact) {
        smooth > 0.0 && border.tangent >= TANGENT_SHARE * smooth
    } else {
        smooth == 0.0 || border.unexplained <= UNEXPLAINED_SHARE * smooth
    }
}
