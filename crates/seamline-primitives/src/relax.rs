//! Where vertices are noisy: patches that compete for the faces between them.
//!
//! A surface found through noise has taken in what comes near it, of its neighbours too. Here surfaces are fitted to
//! their patches anew, patches that lie on one surface become one, and a face goes to that neighbour which explains
//! it best: its vertices by their distance from the surface, its normal by what it is turned, each in deviations of
//! the noise, against the length of boundary it makes.

use std::collections::BTreeMap;

use glam::DVec3;
use seamline_mesh::{Sets, Topology};

use crate::Fitted;
use crate::pieces::Triangles;
use crate::refine::refine_patiently;
use crate::surface::Kind;

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
/// How far a facet is turned from the surface it is a chord of, radians: not by noise.
const CHORD: f64 = 0.035;
/// Root mean square distance, in deviations of the noise, up to which points lie on a surface.
const LIES: f64 = crate::EXACT_DEVIATIONS;
/// A facet turned farther than this, 40 degrees, and than noise turns it, is not of a surface its corners lie on, as
/// the caps of a cylinder are not of it; radians.
const TURNED: f64 = 0.7;
/// Share of a patch's area that may be.
const MOST_TURNED: f64 = 0.1;
/// How much farther from a surface fitted to two patches each may lie than from its own.
const WORSE: f64 = 1.2;
/// Most vertices a fit looks at.
const MOST_POINTS: usize = 400;
/// Most faces of a free form that costs its faces as much as can be: what is so small is a leftover.
const FEW: usize = 6;

/// A mesh with its noise.
#[derive(Clone, Copy)]
pub(crate) struct Noisy<'a> {
    pub positions: &'a [DVec3],
    pub topology: &'a Topology,
    pub triangles: &'a Triangles,
    /// Standard deviation of each coordinate.
    pub noise: f64,
}

/// Patches, one number a face, and the surface of each.
pub(crate) struct Patches {
    pub of_face: Vec<u32>,
    pub surfaces: Vec<Option<Fitted>>,
}

impl Noisy<'_> {
    pub fn relax(self, patches: &mut Patches) {
        for _ in 0..ROUNDS {
            self.fit(patches);
            self.unite(patches);
            self.fit(patches);
            if self.sweep(patches) == 0 {
                break;
            }
        }
    }

    /// Some vertices of each patch.
    fn points(self, patches: &Patches) -> Vec<Vec<DVec3>> {
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(3 * patches.of_face.len());
        for (face, &patch) in patches.of_face.iter().enumerate() {
            pairs.extend(self.topology.triangles[face].map(|v| (patch, v)));
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut points = vec![Vec::new(); patches.surfaces.len()];
        for of_one in pairs.chunk_by(|a, b| a.0 == b.0) {
            let few = of_one.iter().step_by(of_one.len().div_ceil(MOST_POINTS));
            points[of_one[0].0 as usize] = few.map(|&(_, v)| self.positions[v as usize]).collect();
        }
        points
    }

    fn fit(self, patches: &mut Patches) {
        let points = self.points(patches);
        for (fitted, points) in patches.surfaces.iter_mut().zip(&points) {
            let Some(own) = fitted else { continue };
            if points.is_empty() {
                *fitted = None;
                continue;
            }
            let now = own.surface.rms(points);
            if points.len() > own.surface.kind.degrees_of_freedom()
                && let Some(fit) = refine_patiently(own.surface, points, 0.0)
                && fit.rms < now
            {
                own.surface = fit.surface;
            }
            own.residual = own.surface.rms(points);
            own.exact = own.residual <= LIES * self.noise;
            own.evidence = points
                .len()
                .saturating_sub(own.surface.kind.degrees_of_freedom())
                as u32;
        }
    }

    /// Unites neighbours that lie on one surface.
    fn unite(self, patches: &mut Patches) {
        let mut points = self.points(patches);
        let mut beside: BTreeMap<[u32; 2], f64> = BTreeMap::new();
        for edge in 0..self.topology.edge_faces.len() {
            if let Some(faces) = self.topology.face_pair(edge) {
                let [a, b] = faces.map(|f| patches.of_face[f as usize]);
                if a != b {
                    let ends = self.topology.edge_vertices[edge];
                    let [p, q] = ends.map(|v| self.positions[v as usize]);
                    *beside.entry([a.min(b), a.max(b)]).or_default() += p.distance(q);
                }
            }
        }
        let mut pairs: Vec<([u32; 2], f64)> = beside.into_iter().collect();
        pairs.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut sets = Sets::new(points.len());
        let mut faces = vec![Vec::new(); patches.surfaces.len()];
        for (face, &patch) in patches.of_face.iter().enumerate() {
            faces[patch as usize].push(face as u32);
        }
        for (pair, _) in pairs {
            let [a, b] = pair.map(|p| sets.first(p));
            if a == b {
                continue;
            }
            let (large, small) = if points[a as usize].len() >= points[b as usize].len() {
                (a, b)
            } else {
                (b, a)
            };
            let [Some(first), Some(second)] = [large, small].map(|p| patches.surfaces[p as usize])
            else {
                continue;
            };
            let [of_large, of_small] = [large, small].map(|p| &points[p as usize]);
            let Some(surface) = self.of_both(&first, of_large, &second, of_small) else {
                continue;
            };
            if self.turned_share(&surface, &faces[small as usize]) > MOST_TURNED {
                continue;
            }
            sets.unite(large, small);
            let both = [of_large.as_slice(), of_small.as_slice()].concat();
            let kept = sets.first(large) as usize;
            patches.surfaces[kept] = Some(surface);
            let other = if kept == large as usize { small } else { large } as usize;
            let mut more = std::mem::take(&mut faces[other]);
            faces[kept].append(&mut more);
            points[kept] = both
                .iter()
                .copied()
                .step_by(both.len().div_ceil(MOST_POINTS))
                .collect();
        }
        for patch in &mut patches.of_face {
            *patch = sets.first(*patch);
        }
    }

    /// Share of the area of faces that is turned from a surface by more than noise could.
    fn turned_share(self, surface: &Fitted, faces: &[u32]) -> f64 {
        let [mut turned, mut whole] = [0.0; 2];
        for &face in faces {
            let area = self.triangles.areas[face as usize];
            whole += area;
            if self.turned(surface, face) > TURNED + self.triangles.leans[face as usize] {
                turned += area;
            }
        }
        if whole > 0.0 { turned / whole } else { 0.0 }
    }

    fn turned(self, fitted: &Fitted, face: u32) -> f64 {
        let at = self.triangles.centroids[face as usize];
        let normal = self.triangles.normals[face as usize];
        let sign = if fitted.convex || fitted.surface.kind == Kind::Plane {
            1.0
        } else {
            -1.0
        };
        (sign * fitted.surface.gradient(at)).angle_between(normal)
    }

    /// The surface both of two patches lie on, if there is one.
    fn of_both(
        self,
        large: &Fitted,
        of_large: &[DVec3],
        small: &Fitted,
        of_small: &[DVec3],
    ) -> Option<Fitted> {
        let curved = large.surface.kind != Kind::Plane && small.surface.kind != Kind::Plane;
        if curved && large.convex != small.convex {
            return None;
        }
        if large.surface.rms(of_small) <= LIES * self.noise {
            return Some(*large);
        }
        let both = [of_large, of_small].concat();
        [large, small].into_iter().find_map(|from| {
            let fit = refine_patiently(from.surface, &both, 0.0)?;
            let lies = |points: &[DVec3], own: f64| {
                fit.surface.rms(points)
                    <= (LIES * self.noise).min(WORSE * own.max(0.8 * self.noise))
            };
            (lies(of_large, large.residual) && lies(of_small, small.residual)).then_some(Fitted {
                surface: fit.surface,
                ..*from
            })
        })
    }

    /// Lets faces go to their neighbours' patches. How many did.
    fn sweep(self, patches: &mut Patches) -> usize {
        let mut sizes = vec![0usize; patches.surfaces.len()];
        for &patch in &patches.of_face {
            sizes[patch as usize] += 1;
        }
        let mut gone = 0;
        for _ in 0..SWEEPS {
            let mut moved = 0;
            for face in 0..patches.of_face.len() as u32 {
                let own = patches.of_face[face as usize];
                if self.is_inside(face, patches) {
                    continue;
                }
                let around = self.around(face, patches);
                let cost = |patch: u32| {
                    let cut: f64 = around
                        .iter()
                        .filter(|&&(across, _)| across != patch)
                        .map(|&(_, share)| share)
                        .sum();
                    BOUNDARY * cut
                        + self.misfit(
                            face,
                            &patches.surfaces[patch as usize],
                            sizes[patch as usize],
                        )
                };
                let mut best = (cost(own) - 1e-9, own);
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
    fn is_inside(self, face: u32, patches: &Patches) -> bool {
        let own = patches.of_face[face as usize];
        let edges = self.topology.face_edges[face as usize].into_iter();
        edges
            .filter_map(|edge| self.topology.neighbour(face, edge))
            .all(|across| patches.of_face[across as usize] == own)
    }

    /// The patches across the edges of a face, each with the edge's share of the perimeter.
    fn around(self, face: u32, patches: &Patches) -> Vec<(u32, f64)> {
        let edges = self.topology.face_edges[face as usize];
        let length = |edge: u32| {
            let [p, q] =
                self.topology.edge_vertices[edge as usize].map(|v| self.positions[v as usize]);
            p.distance(q)
        };
        let perimeter: f64 = edges.iter().map(|&e| length(e)).sum();
        edges
            .into_iter()
            .filter_map(|edge| {
                let across = self.topology.neighbour(face, edge)?;
                Some((patches.of_face[across as usize], length(edge) / perimeter))
            })
            .collect()
    }

    fn misfit(self, face: u32, surface: &Option<Fitted>, size: usize) -> f64 {
        let squares = match surface {
            None if size <= FEW => 2.0 * CAPPED,
            None => FREE,
            Some(fitted) => {
                let vertices = self.topology.triangles[face as usize].into_iter();
                let squares: f64 = vertices
                    .map(|v| {
                        let away = fitted.surface.distance(self.positions[v as usize]) / self.noise;
                        (away * away).min(CAPPED)
                    })
                    .sum();
                let turned = self.turned(fitted, face);
                let deviation = CHORD.hypot(self.triangles.leans[face as usize] / 2.0);
                squares / 3.0 + (turned / deviation).powi(2).min(CAPPED)
            }
        };
        squares / 2.0
    }
}
