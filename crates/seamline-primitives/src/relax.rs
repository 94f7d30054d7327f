//! Where vertices are noisy: patches that compete for the faces between them.
//!
//! A surface found through noise has taken in what comes near it, of its neighbours too. Here surfaces are fitted to
//! their patches anew, patches that lie on one surface become one (`unite`), and a face goes to that neighbour which
//! explains it best: its vertices by their distance from the surface, its normal by what it is turned, each in
//! deviations of the noise, against the length of boundary it makes.

use glam::DVec3;
use rayon::prelude::*;

use crate::Fitted;
use crate::ground::Ground;
use crate::patches::Patches;
use crate::refine::refine_patiently;
use crate::surface::Kind;
use crate::unite::unite;

/// How often surfaces are fitted and faces go over.
const ROUNDS: usize = 4;
/// Sweeps over all faces at most in a round.
const SWEEPS: usize = 12;
/// Square, in deviations, above which a distance or a turning says no more.
const CAPPED: f64 = 25.0;
/// Squared deviations at which a face is as well in a free form.
const FREE: f64 = 9.0;
/// What a boundary of the length of a face's own perimeter costs.
const BOUNDARY: f64 = 2.0;
/// By how much another patch must be better: by more than rounding, or two that are as good would take turns.
const BETTER: f64 = 1e-9;
/// How far a facet is turned from the surface it is a chord of, radians: not by noise.
const CHORD: f64 = 0.035;
/// Most faces of a free form that costs its faces as much as can be: what is so small is a leftover.
const FEW: usize = 6;

/// Lets patches compete until no face goes over. A patch that has lost all its faces keeps its number.
pub(crate) fn relax(ground: Ground, patches: &mut Patches) {
    for _ in 0..ROUNDS {
        let points = fit(ground, patches);
        unite(ground, patches, points);
        fit(ground, patches);
        if sweep(ground, patches) == 0 {
            break;
        }
    }
}

/// Fits the surface of each patch to its vertices anew, where that brings them nearer. Gives these vertices.
fn fit(ground: Ground, patches: &mut Patches) -> Vec<Vec<DVec3>> {
    let points = patches.points(ground.positions, ground.topology);
    let all = patches.surfaces.par_iter_mut().zip(&points);
    all.for_each(|(fitted, points)| {
        let Some(own) = fitted else { return };
        if points.is_empty() {
            *fitted = None;
            return;
        }
        let now = own.surface.rms(points);
        if points.len() > own.surface.kind.degrees_of_freedom()
            && let Some(fit) = refine_patiently(own.surface, points, 0.0)
            && fit.rms < now
        {
            own.surface = fit.surface;
        }
        weigh(ground, own, points);
    });
    points
}

/// Tells how well the surface of each patch is proved by the vertices the patch has now.
pub(crate) fn weigh_all(ground: Ground, patches: &mut Patches) {
    let vertices = patches.vertices(ground.topology);
    for (fitted, vertices) in patches.surfaces.iter_mut().zip(&vertices) {
        if let Some(own) = fitted {
            let points = vertices.iter().map(|&v| ground.positions[v as usize]);
            weigh(ground, own, &points.collect::<Vec<DVec3>>());
        }
    }
}

fn weigh(ground: Ground, fitted: &mut Fitted, points: &[DVec3]) {
    let freedom = fitted.surface.kind.degrees_of_freedom();
    fitted.residual = fitted.surface.rms(points);
    fitted.exact = fitted.residual <= ground.precision;
    fitted.evidence = points.len().saturating_sub(freedom) as u32;
}

/// The angle between a face's normal and that of a surface beneath it, radians; 0 for a face without area.
pub(crate) fn turned(ground: Ground, fitted: &Fitted, face: u32) -> f64 {
    let at = ground.triangles.centroids[face as usize];
    let normal = ground.triangles.normals[face as usize];
    if normal == DVec3::ZERO {
        return 0.0;
    }
    let sign = if fitted.convex || fitted.surface.kind == Kind::Plane {
        1.0
    } else {
        -1.0
    };
    (sign * fitted.surface.gradient(at)).angle_between(normal)
}

/// Lets faces go to their neighbours' patches. How many did.
fn sweep(ground: Ground, patches: &mut Patches) -> usize {
    let mut sizes = vec![0usize; patches.surfaces.len()];
    for &patch in &patches.of_face {
        sizes[patch as usize] += 1;
    }
    let mut gone = 0;
    for _ in 0..SWEEPS {
        let mut moved = 0;
        for face in 0..patches.of_face.len() as u32 {
            let own = patches.of_face[face as usize];
            if is_inside(ground, face, patches) {
                continue;
            }
            let around = around(ground, face, patches);
            let cost = |patch: u32| {
                let cut: f64 = around
                    .iter()
                    .filter(|&&(across, _)| across != patch)
                    .map(|&(_, share)| share)
                    .sum();
                let surface = patches.surfaces[patch as usize].as_ref();
                BOUNDARY * cut + misfit(ground, face, surface, sizes[patch as usize])
            };
            let mut best = (cost(own) - BETTER, own);
            for &(patch, _) in &around {
                let cost = cost(patch);
                if cost < best.0 {
                    best = (cost, patch);
                }
            }
            if best.1 != own {
                patches.of_face[face as usize] = best.1;
                sizes[own as usize] -= 1;
                sizes[best.1 as usize] += 1;
                moved += 1;
            }
        }
        gone += moved;
        if moved == 0 {
            break;
        }
    }
    gone
}

/// Are all neighbours of a face in its own patch?
fn is_inside(ground: Ground, face: u32, patches: &Patches) -> bool {
    let own = patches.of_face[face as usize];
    let edges = ground.topology.face_edges[face as usize].into_iter();
    edges
        .filter_map(|edge| ground.topology.neighbour(face, edge))
        .all(|across| patches.of_face[across as usize] == own)
}

/// The patches across the edges of a face, each with the edge's share of the perimeter.
fn around(ground: Ground, face: u32, patches: &Patches) -> Vec<(u32, f64)> {
    let edges = ground.topology.face_edges[face as usize];
    let perimeter: f64 = edges.iter().map(|&e| ground.edge_length(e)).sum();
    edges
        .into_iter()
        .filter_map(|edge| {
            let across = ground.topology.neighbour(face, edge)?;
            let share = ground.edge_length(edge) / perimeter;
            Some((patches.of_face[across as usize], share))
        })
        .collect()
}

/// How badly a surface explains a face: half the squared deviations, as a likelihood's logarithm counts them. `size`
/// is the number of faces of its patch.
fn misfit(ground: Ground, face: u32, surface: Option<&Fitted>, size: usize) -> f64 {
    let squares = match surface {
        None if size <= FEW => 2.0 * CAPPED,
        None => FREE,
        Some(fitted) => {
            let vertices = ground.topology.triangles[face as usize].into_iter();
            let squares: f64 = vertices
                .map(|v| {
                    let away = fitted.surface.distance(ground.positions[v as usize]) / ground.noise;
                    (away * away).min(CAPPED)
                })
                .sum();
            let deviation = CHORD.hypot(ground.lean(face) / 2.0);
            let turned = turned(ground, fitted, face) / deviation;
            squares / 3.0 + turned.powi(2).min(CAPPED)
        }
    };
    squares / 2.0
}
