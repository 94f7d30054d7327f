//! Where vertices are noisy: neighbours that lie on one surface become one patch.

use std::collections::BTreeMap;

use glam::DVec3;
use seamline_mesh::Sets;

use crate::Fitted;
use crate::few::a_few;
use crate::ground::Ground;
use crate::patches::{MOST_POINTS, Patches};
use crate::refine::refine_patiently;
use crate::relax::turned;
use crate::surface::Kind;

/// A facet turned farther than this, 40 degrees, and than noise turns it, is not of a surface its corners lie on, as
/// the caps of a cylinder are not of it; radians.
const TURNED: f64 = 0.7;
/// Share of a patch's area that may be.
const MOST_TURNED: f64 = 0.1;
/// How much farther from a surface fitted to two patches each may lie than from its own.
const WORSE: f64 = 1.2;
/// Root mean square distance, in deviations of the noise, that a patch is taken to have from its own surface at
/// least: one of few vertices is fitted to their noise.
const LEAST_OWN: f64 = 0.8;

/// Unites neighbours that lie on one surface, those of the longest common boundary first. `points` are some vertices
/// of each patch.
pub(crate) fn unite(ground: Ground, patches: &mut Patches, mut points: Vec<Vec<DVec3>>) {
    let mut faces = vec![Vec::new(); patches.surfaces.len()];
    for (face, &patch) in patches.of_face.iter().enumerate() {
        faces[patch as usize].push(face as u32);
    }
    let mut sets = Sets::new(points.len());
    for pair in beside(ground, patches) {
        let [a, b] = pair.map(|patch| sets.first(patch));
        if a == b {
            continue;
        }
        let (large, small) = if faces[a as usize].len() >= faces[b as usize].len() {
            (a, b)
        } else {
            (b, a)
        };
        let [Some(first), Some(second)] = [large, small].map(|p| patches.surfaces[p as usize])
        else {
            continue;
        };
        let [of_large, of_small] = [large, small].map(|p| &points[p as usize]);
        let Some(surface) = of_both(ground, [&first, &second], [of_large, of_small]) else {
            continue;
        };
        if turned_share(ground, &surface, &faces[small as usize]) > MOST_TURNED {
            continue;
        }
        sets.unite(large, small);
        let both = [of_large.as_slice(), of_small.as_slice()].concat();
        let kept = sets.first(large);
        let less = std::mem::take(&mut faces[small as usize]);
        faces[large as usize].extend(less);
        faces.swap(kept as usize, large as usize);
        points[kept as usize] = a_few(&both, MOST_POINTS).copied().collect();
        patches.surfaces[kept as usize] = Some(surface);
    }
    for patch in &mut patches.of_face {
        *patch = sets.first(*patch);
    }
}

/// Patches with a boundary in common, the longest boundary first.
fn beside(ground: Ground, patches: &Patches) -> Vec<[u32; 2]> {
    let mut lengths: BTreeMap<[u32; 2], f64> = BTreeMap::new();
    for edge in 0..ground.topology.edge_faces.len() {
        if let Some(faces) = ground.topology.face_pair(edge) {
            let [a, b] = faces.map(|f| patches.of_face[f as usize]);
            if a != b {
                *lengths.entry([a.min(b), a.max(b)]).or_default() +=
                    ground.edge_length(edge as u32);
            }
        }
    }
    let mut pairs: Vec<([u32; 2], f64)> = lengths.into_iter().collect();
    pairs.sort_by(|a, b| b.1.total_cmp(&a.1));
    pairs.into_iter().map(|(pair, _)| pair).collect()
}

/// The surface both of two patches lie on, if there is one: that of the larger, or one fitted to both. Surfaces and
/// points are the larger's first.
fn of_both(ground: Ground, own: [&Fitted; 2], points: [&[DVec3]; 2]) -> Option<Fitted> {
    let [large, small] = own;
    let curved = own.iter().all(|it| it.surface.kind != Kind::Plane);
    if curved && large.convex != small.convex {
        return None;
    }
    if large.surface.rms(points[1]) <= ground.precision {
        return Some(*large);
    }
    let both = points.concat();
    own.into_iter().find_map(|from| {
        let surface = refine_patiently(from.surface, &both, 0.0)?.surface;
        let lies = |points: &[DVec3], own: f64| {
            let own = own.max(LEAST_OWN * ground.noise);
            surface.rms(points) <= ground.precision.min(WORSE * own)
        };
        (lies(points[0], large.residual) && lies(points[1], small.residual))
            .then_some(Fitted { surface, ..*from })
    })
}

/// Share of the area of faces that is turned from a surface by more than noise could.
fn turned_share(ground: Ground, surface: &Fitted, faces: &[u32]) -> f64 {
    let [mut away, mut whole] = [0.0; 2];
    for &face in faces {
        let area = ground.triangles.areas[face as usize];
        whole += area;
        if turned(ground, surface, face) > TURNED + ground.lean(face) {
            away += area;
        }
    }
    if whole > 0.0 { away / whole } else { 0.0 }
}
