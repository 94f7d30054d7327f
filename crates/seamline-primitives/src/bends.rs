//! Strips across a torus, each of which lies on a cylinder of its tube's radius: those beside each other lie on the torus.

use std::collections::BTreeMap;

use foldhash::HashSet;

use crate::grow::Soil;
use crate::hypothesis::Hypothesis;
use crate::scout::Scout;
use crate::surface::Kind;
use crate::tried::Tried;

/// Radii that differ by no more than this share are those of one tube.
const SAME_RADIUS: f64 = 0.02;
/// Cosine of the angle up to which two axes are one (a tenth of a degree).
const ONE_AXIS: f64 = 0.999_998_5;
/// Strips a torus is fitted to: two, then more, since how two narrow ones lean against each other is less than their
/// vertices were rounded by.
const STRIPS: [usize; 2] = [2, 16];

/// Tori tried on strong cylinders of one radius that meet smoothly and have different axes.
pub(crate) fn tori(
    soil: &mut Soil,
    before: &Tried,
    turn: usize,
    found: &[Hypothesis],
) -> Vec<Hypothesis> {
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
    let mut bent: Vec<([usize; 2], [u32; 2])> = Vec::new();
    let mut beside: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let mut known = HashSet::default();
    for link in view.pieces.links.iter().filter(|link| !link.wall) {
        if let [Some(a), Some(b)] = link.pieces.map(|p| holder[p as usize])
            && a != b
            && bend(&found[a], &found[b])
            && known.insert([a.min(b), a.max(b)])
        {
            bent.push(([a, b], link.pieces));
            beside.entry(a).or_default().push(b);
            beside.entry(b).or_default().push(a);
        }
    }
    let mut tori: Vec<Hypothesis> = Vec::new();
    for (pair, meet) in bent {
        for most in STRIPS {
            if meet.iter().all(|&piece| on_torus[piece as usize]) {
                break;
            }
            let strips = chain(&beside, pair, most);
            if most > STRIPS[0] && strips.len() == STRIPS[0] {
                break;
            }
            let mut pieces: Vec<u32> = strips
                .iter()
                .flat_map(|&strip| found[strip].pieces.iter().copied())
                .collect();
            pieces.sort_unstable();
            pieces.dedup();
            let scout = Scout::new(soil, meet[0], before, turn);
            let Some(torus) = scout.of_kind(Kind::Torus, &pieces) else {
                continue;
            };
            for &piece in torus.pieces.iter().filter(|_| torus.strong && torus.exact) {
                on_torus[piece as usize] = true;
            }
            tori.push(torus);
        }
    }
    tori
}

/// Two strips and those beside them, `most` at most.
fn chain(beside: &BTreeMap<usize, Vec<usize>>, pair: [usize; 2], most: usize) -> Vec<usize> {
    let mut strips = pair.to_vec();
    let mut at = 0;
    while at < strips.len() && strips.len() < most {
        for &next in &beside[&strips[at]] {
            if strips.len() < most && !strips.contains(&next) {
                strips.push(next);
            }
        }
        at += 1;
    }
    strips
}

/// Are two cylinders of one radius about different axes?
fn bend(a: &Hypothesis, b: &Hypothesis) -> bool {
    let [a, b] = [a.surface, b.surface];
    (a.a - b.a).abs() <= SAME_RADIUS * a.a && a.axis.dot(b.axis).abs() < ONE_AXIS
}
