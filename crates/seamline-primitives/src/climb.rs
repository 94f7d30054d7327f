//! Regions of surfaces, rung by rung of a ladder of tolerances.

use crate::ground::Ground;
use crate::hypothesis::{Hypothesis, View};
use crate::pieces::{NONE, Pieces};
use crate::regions::Regions;
use crate::search::search;
use crate::select::{borders_speak_for, free_part, select};
use crate::surface::Kind;
use crate::tried::Tried;
use crate::{HARDLY_ANYTHING, absorb, exact_share, tiles, trust};

/// How flat a piece is, as a share of the tolerance.
const FLATNESS: f64 = 0.3;

/// Fewest vertices of a flat piece that is a plane whatever lies beside it: at the precision of an export,
/// and farther out, where a gently curved free form has flat pieces too.
pub(crate) const PLANE_VERTICES: [usize; 3] = [7, 25, 25];

/// Evidence from which a surface keeps its pieces on the next rung although it does not end as surfaces do (`trust`).
const STANDS: i64 = 120;

/// How often weak surfaces are gone through: one that is believed speaks for those beside it.
const TURNS: usize = 3;

/// Regions of surfaces, rung by rung of the ladder of tolerances. What one rung settles the next leaves alone;
/// what is left is cut into flatter or less flat pieces anew.
pub(crate) fn climb(ground: Ground, ladder: [f64; 3]) -> (Pieces, Regions) {
    let mut pieces = Pieces::default();
    let mut regions = Regions::default();
    let tried = Tried::default();
    for (rung, &tolerance) in ladder.iter().enumerate() {
        if rung > 0 && is_done(&pieces, &regions) {
            break;
        }
        let flat = FLATNESS * tolerance;
        let fewest = PLANE_VERTICES[rung];
        pieces = recut(ground, flat, fewest, pieces, &mut regions);
        // Noisy curved surfaces have flat pieces, too: planes compete with them.
        let planes = if ground.noise > 0.0 {
            let planes = certain_planes(ground.seen(&pieces), &regions, tolerance);
            pieces.certain.fill(false);
            planes
        } else {
            let view = ground.seen(&pieces);
            for piece in accept_planes(view, &mut regions, rung == 0, tolerance) {
                pieces.certain[piece as usize] = false;
            }
            Vec::new()
        };
        let view = ground.seen(&pieces);
        step(view, &mut regions, planes, &tried, rung, tolerance);
        absorb::absorb(view, &mut regions, tolerance);
        if ground.noise > 0.0 {
            tiles::dissolve(view, &mut regions);
        }
        if exact_share(view, &regions) < HARDLY_ANYTHING {
            break;
        }
    }
    (pieces, regions)
}

/// Cuts what no region owns into pieces anew.
pub(crate) fn recut(
    ground: Ground,
    flat: f64,
    fewest: usize,
    pieces: Pieces,
    regions: &mut Regions,
) -> Pieces {
    let owned = |&piece: &u32| {
        let taken = regions.owner[piece as usize] != NONE;
        if taken { piece } else { NONE }
    };
    let mut settled: Vec<u32> = pieces.of_face.iter().map(owned).collect();
    settled.resize(ground.topology.triangles.len(), NONE);
    let next = Pieces::find(ground, flat, &settled, fewest);
    regions.move_to(&pieces, &next);
    next
}

/// Is nothing left that a surface could be looked for in: no two pieces beside each other that nobody owns?
fn is_done(pieces: &Pieces, regions: &Regions) -> bool {
    let free = |p: u32| regions.owner[p as usize] == NONE && !pieces.certain[p as usize];
    let mut smooth = pieces.links.iter().filter(|link| !link.wall);
    !smooth.any(|link| link.pieces.into_iter().all(free))
}

/// A hypothesis for each piece nobody owns that is a plane whatever lies beside it.
fn certain_planes(view: View, regions: &Regions, tolerance: f64) -> Vec<Hypothesis> {
    (0..view.pieces.count() as u32)
        .filter(|&p| view.pieces.certain[p as usize] && regions.owner[p as usize] == NONE)
        .map(|piece| view.weigh(view.plane_of(piece), 1.0, vec![piece], tolerance))
        .collect()
}

/// Accepts the pieces that are planes whatever lies beside them, and gives those that are none after all: their
/// vertices do not lie in a plane `exactly`.
fn accept_planes(view: View, regions: &mut Regions, exactly: bool, tolerance: f64) -> Vec<u32> {
    let mut bent = Vec::new();
    for piece in 0..view.pieces.count() as u32 {
        if view.pieces.certain[piece as usize] && regions.owner[piece as usize] == NONE {
            // A dense curved surface has flat pieces of many vertices, too: they only come near their planes.
            let plane = view.plane_of(piece);
            let found = view.weigh(plane, 1.0, vec![piece], tolerance);
            if found.exact || !exactly {
                regions.accept(found);
            } else {
                bent.push(piece);
            }
        }
    }
    bent
}

/// Evidence from which a strong surface is believed whatever its borders say. Exactly on it, one vertex more than it
/// has freedoms is proof. Where vertices only come near, a free form comes near too, the longer the farther they may
/// be off; a cylinder, which is straight one way, is the last it does.
pub(crate) fn least_evidence(rung: usize, kind: Kind) -> i64 {
    match (rung, kind) {
        (0, _) => 1,
        (1, Kind::Cylinder) => 8,
        (1, _) => 40,
        _ => 100,
    }
}

/// One rung of the ladder of tolerances.
fn step(
    view: View,
    regions: &mut Regions,
    planes: Vec<Hypothesis>,
    tried: &Tried,
    rung: usize,
    tolerance: f64,
) {
    let freed = if rung == 0 {
        Vec::new()
    } else {
        let trusted = trust::trusted(view, regions);
        let doubtful: Vec<u32> = regions
            .alive()
            .filter(|&r| !trusted[r as usize] && regions.all[r as usize].evidence < STANDS)
            .collect();
        doubtful.into_iter().map(|r| regions.dissolve(r)).collect()
    };
    let open: Vec<bool> = (0..view.pieces.count())
        .map(|p| regions.owner[p] == NONE)
        .collect();
    let mut found = search(view, &open, tried, rung, tolerance);
    found.extend(planes);
    let enough = |h: &Hypothesis| {
        let least = least_evidence(rung, h.surface.kind);
        h.strong && (rung > 0 || h.exact) && h.evidence >= least
    };
    let mut rest = select(view, regions, found, tolerance, |_, h| enough(h));
    if rung == 0 {
        for _ in 0..TURNS {
            let before = regions.all.len();
            rest = select(view, regions, rest, tolerance, |regions, h| {
                borders_speak_for(view, regions, h)
            });
            if regions.all.len() == before {
                break;
            }
        }
    }
    // What nothing better has taken goes back to where it was.
    for hypothesis in freed {
        let left = free_part(view, regions, &hypothesis, tolerance);
        if let Some(back) = left
            && 2 * back.pieces.len() > hypothesis.pieces.len()
        {
            regions.accept(back);
        }
    }
}
