//! Solids whose surfaces are known in closed form, with the patch each face belongs to.
//!
//! For tests, benchmarks and the project's own sample parts. All are closed, oriented outward, and made of
//! faces that share no vertices until welded: equal corners are equal to the last bit.

mod basic;
mod parts;
mod profile;
mod smooth_cube;

use glam::DVec3;

pub use basic::{cone, cuboid, cylinder, icosphere, torus};
pub use parts::{bracket, rounded_box, rounded_prism, shaft, stadium};
pub use profile::{ProfilePiece, arc, extrude, line, profile, revolve};
pub use smooth_cube::smooth_cube;

use crate::{Format, PolygonMesh};

/// A surface made of polygons, each with the number of its patch.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    faces: Vec<Vec<DVec3>>,
    /// The patch of each face, in face order.
    pub patches: Vec<u32>,
}

impl Shape {
    fn push(&mut self, patch: u32, corners: impl Into<Vec<DVec3>>) {
        self.faces.push(corners.into());
        self.patches.push(patch);
    }

    /// A quad `[a, b, c, d]`, cut along `a c` or along `b d`.
    fn push_cut_quad(&mut self, patch: u32, [a, b, c, d]: [DVec3; 4], along_ac: bool) {
        let halves = if along_ac {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, b, d], [b, c, d]]
        };
        for half in halves {
            self.push(patch, half);
        }
    }

    /// The faces with every corner moved.
    pub fn map(&self, moved: impl Fn(DVec3) -> DVec3) -> Self {
        let faces = self
            .faces
            .iter()
            .map(|face| face.iter().map(|&p| moved(p)).collect())
            .collect();
        Self {
            faces,
            patches: self.patches.clone(),
        }
    }

    /// The faces turned inside out.
    pub fn reversed(&self) -> Self {
        let faces = self
            .faces
            .iter()
            .map(|face| face.iter().rev().copied().collect())
            .collect();
        Self {
            faces,
            patches: self.patches.clone(),
        }
    }

    /// The faces in another order: face `i` is the `order[i]`-th of this shape.
    pub fn reordered(&self, order: &[usize]) -> Self {
        Self {
            faces: order.iter().map(|&i| self.faces[i].clone()).collect(),
            patches: order.iter().map(|&i| self.patches[i]).collect(),
        }
    }

    /// Both shapes side by side; the patches of `other` are numbered on.
    pub fn and(mut self, other: &Self) -> Self {
        let first = self.patch_count() as u32;
        self.faces.extend_from_slice(&other.faces);
        self.patches
            .extend(other.patches.iter().map(|patch| first + patch));
        self
    }

    /// How many patches it was made of.
    pub fn patch_count(&self) -> usize {
        self.patches
            .iter()
            .max()
            .map_or(0, |&last| last as usize + 1)
    }

    /// How many faces.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The faces as a file would hold them: no vertex shared.
    pub fn polygons(&self) -> PolygonMesh {
        let mut starts = vec![0u32];
        for face in &self.faces {
            starts.push(starts[starts.len() - 1] + face.len() as u32);
        }
        let positions = self.faces.concat();
        let corners = (0..positions.len() as u32).collect();
        PolygonMesh {
            format: Format::Memory,
            positions,
            starts,
            corners,
        }
    }
}

/// How the quads of a strip are cut into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diagonals {
    /// Not at all: the faces stay quads.
    None,
    /// All in the same direction.
    Uniform,
    /// In turn.
    Alternating,
}

fn push_quad(shape: &mut Shape, patch: u32, quad: [DVec3; 4], turn: usize, diagonals: Diagonals) {
    match diagonals {
        Diagonals::None => shape.push(patch, quad),
        Diagonals::Uniform => shape.push_cut_quad(patch, quad, true),
        Diagonals::Alternating => shape.push_cut_quad(patch, quad, turn.is_multiple_of(2)),
    }
}
