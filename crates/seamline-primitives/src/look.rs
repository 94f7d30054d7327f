//! A neighbourhood as all kinds of surfaces look at it.

use std::hash::{DefaultHasher, Hash, Hasher};

use glam::DVec3;

use crate::around::STRIP;
use crate::few::a_few;
use crate::grow::MOST_POINTS;
use crate::guess::{Facets, guesses};
use crate::hypothesis::View;
use crate::refine::Cloud;
use crate::surface::{Kind, Surface};

/// A neighbourhood: some pieces, and what a surface is fitted to there.
pub(crate) struct Look<'p> {
    pub pieces: &'p [u32],
    pub hash: u64,
    /// Its distinct vertices.
    vertices: Vec<u32>,
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
        let mut hasher = DefaultHasher::new();
        pieces.hash(&mut hasher);
        Self {
            pieces,
            hash: hasher.finish(),
            vertices: view.vertices_of(pieces),
            sample: None,
        }
    }

    /// Has it more vertices than determine a surface of a kind?
    pub fn can_tell(&self, kind: Kind) -> bool {
        self.vertices.len() >= kind.degrees_of_freedom() + 2
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
                is_strip: self.pieces.len() == STRIP,
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
