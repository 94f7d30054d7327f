//! A neighbourhood as all kinds of surfaces look at it.

use glam::DVec3;

use crate::few::a_few;
use crate::grow::MOST_POINTS;
use crate::guess::{Facets, guesses};
use crate::hypothesis::View;
use crate::refine::Cloud;
use crate::surface::{Kind, Surface};
use crate::tried::mixed;

/// Vertices a neighbourhood has at least, more than determine a surface.
pub(crate) const MORE_THAN_FREE: usize = 2;

/// A neighbourhood: some pieces, and what a surface is fitted to there.
pub(crate) struct Look<'p> {
    pub pieces: &'p [u32],
    /// Tells it from other neighbourhoods, also when pieces are cut anew.
    pub key: u64,
    /// Its distinct vertices.
    vertices: Vec<u32>,
    /// Does each piece follow the one before?
    is_strip: bool,
    sample: Option<Sample>,
}

/// What a surface is fitted to.
pub(crate) struct Sample {
    points: Vec<DVec3>,
    pub cloud: Cloud,
    facets: Facets,
    is_strip: bool,
}

impl<'p> Look<'p> {
    pub fn at(view: View, pieces: &'p [u32]) -> Self {
        let keys = pieces.iter().map(|&p| view.pieces.keys[p as usize]);
        Self {
            pieces,
            key: keys.fold(0, mixed),
            vertices: view.vertices_of(pieces),
            is_strip: false,
            sample: None,
        }
    }

    /// Pieces of which each follows the one before.
    pub fn along(view: View, strip: &'p [u32]) -> Self {
        Self {
            is_strip: true,
            ..Self::at(view, strip)
        }
    }

    /// Has it more vertices than determine a surface of a kind?
    pub fn can_tell(&self, kind: Kind) -> bool {
        self.vertices.len() >= kind.degrees_of_freedom() + MORE_THAN_FREE
    }

    /// `None` if all points are one.
    pub fn sample(&mut self, view: View) -> Option<&Sample> {
        if self.sample.is_none() {
            let some = a_few(&self.vertices, MOST_POINTS);
            let points: Vec<DVec3> = some.map(|&v| view.ground.positions[v as usize]).collect();
            self.sample = Some(Sample {
                cloud: Cloud::of(&points)?,
                facets: view.facets(self.pieces),
                points,
                is_strip: self.is_strip,
            });
        }
        self.sample.as_ref()
    }
}

impl Sample {
    /// First guesses of surfaces of one kind.
    pub fn guesses(&self, kind: Kind) -> Vec<Surface> {
        let mut found = guesses(kind, &self.facets.between(&self.points));
        if matches!(kind, Kind::Cylinder | Kind::Cone) && self.is_strip {
            found.extend(guesses(kind, &self.facets.paired().between(&self.points)));
        }
        found
    }
}
