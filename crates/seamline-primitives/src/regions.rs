//! Regions: surfaces accepted, and which pieces they own.

use std::f64::consts::PI;

use crate::hypothesis::{Hypothesis, View};
use crate::links::Link;
use crate::pieces::{NONE, Pieces};

/// Normals this near are one direction, where two accepted surfaces meet.
const TANGENT: f64 = 2.0 / 180.0 * PI;
/// The same, for a flat piece in the tangent plane of a surface.
const IN_TANGENT_PLANE: f64 = 1.0 / 180.0 * PI;

/// Accepted surfaces, and the owner of each piece.
#[derive(Clone, Debug, Default)]
pub(crate) struct Regions {
    /// The regions; without pieces once dissolved.
    pub all: Vec<Hypothesis>,
    /// The region of each piece.
    pub owner: Vec<u32>,
}

/// How a region ends along a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// At a wall.
    Wall,
    /// Tangent to an accepted surface or a certain plane, or to a flat piece in its tangent plane.
    Tangent,
    /// At a crease against an accepted surface or a certain plane.
    Creased,
    /// Against something unexplained.
    Unexplained,
}

/// Lengths of a region's border by how it ends there.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Border {
    pub wall: f64,
    pub tangent: f64,
    pub creased: f64,
    pub unexplained: f64,
}

impl Border {
    pub fn smooth(&self) -> f64 {
        self.tangent + self.creased + self.unexplained
    }
}

impl Regions {
    pub fn accept(&mut self, hypothesis: Hypothesis) {
        for &piece in &hypothesis.pieces {
            self.owner[piece as usize] = self.all.len() as u32;
        }
        self.all.push(hypothesis);
    }

    /// Sets the pieces of a region free, and gives it back.
    pub fn dissolve(&mut self, region: u32) -> Hypothesis {
        let gone = &mut self.all[region as usize];
        let pieces = std::mem::take(&mut gone.pieces);
        for &piece in &pieces {
            self.owner[piece as usize] = NONE;
        }
        Hypothesis {
            pieces,
            ..gone.clone()
        }
    }

    /// Moves regions to other pieces, of which each lies in one of the old ones.
    pub fn move_to(&mut self, old: &Pieces, new: &Pieces) {
        self.owner = vec![NONE; new.count()];
        for (number, region) in self.all.iter_mut().enumerate() {
            let faces = region.pieces.iter().flat_map(|&p| old.faces.row(p));
            let mut pieces: Vec<u32> = faces.map(|&f| new.of_face[f as usize]).collect();
            pieces.sort_unstable();
            pieces.dedup();
            for &piece in &pieces {
                self.owner[piece as usize] = number as u32;
            }
            region.pieces = pieces;
        }
    }

    /// Numbers of the regions that have pieces.
    pub fn alive(&self) -> impl Iterator<Item = u32> {
        let all = self.all.iter().enumerate();
        all.filter(|(_, r)| !r.pieces.is_empty())
            .map(|(i, _)| i as u32)
    }

    /// How a hypothesis ends along a link that leaves it over `piece`.
    pub fn ending(&self, view: View, of: &Hypothesis, piece: u32, link: u32) -> Ending {
        let pieces = view.pieces;
        let Link {
            wall, pieces: pair, ..
        } = pieces.links[link as usize];
        if wall {
            return Ending::Wall;
        }
        let across = pair[usize::from(pair[0] == piece)];
        let edges = pieces.link_edges.row(link).iter();
        let mut vertices = edges
            .flat_map(|&edge| view.ground.topology.edge_vertices[edge as usize])
            .map(|v| view.ground.positions[v as usize]);
        let owner = self.owner[across as usize];
        if owner != NONE {
            let other = &self.all[owner as usize];
            let tangent = vertices.all(|x| {
                let (a, b) = (of.surface.gradient(x), other.surface.gradient(x));
                (of.sign * a).angle_between(other.sign * b) <= TANGENT
            });
            return if tangent {
                Ending::Tangent
            } else {
                Ending::Creased
            };
        }
        let normal = pieces.normals[across as usize];
        let certain = pieces.certain[across as usize];
        let within = if certain { TANGENT } else { IN_TANGENT_PLANE };
        let tangent =
            vertices.all(|x| (of.sign * of.surface.gradient(x)).angle_between(normal) <= within);
        match (tangent, certain) {
            (true, _) => Ending::Tangent,
            (false, true) => Ending::Creased,
            (false, false) => Ending::Unexplained,
        }
    }

    /// The border of a hypothesis: how it ends against what is not its own.
    pub fn border(&self, view: View, of: &Hypothesis, inside: impl Fn(u32) -> bool) -> Border {
        let mut border = Border::default();
        for &piece in &of.pieces {
            for &link in view.pieces.around.row(piece) {
                let Link { pieces, length, .. } = view.pieces.links[link as usize];
                if pieces.iter().all(|&p| inside(p)) {
                    continue;
                }
                match self.ending(view, of, piece, link) {
                    Ending::Wall => border.wall += length,
                    Ending::Tangent => border.tangent += length,
                    Ending::Creased => border.creased += length,
                    Ending::Unexplained => border.unexplained += length,
                }
            }
        }
        border
    }
}
