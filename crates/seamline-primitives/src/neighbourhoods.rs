//! Vertices and those about them, as seen along the normal there.

use glam::DVec3;
use rayon::prelude::*;

use crate::ground::Ground;
use crate::heights::{self, Terms};

/// Most vertices that are asked.
const MOST_ASKED: usize = 2000;
/// Fewest that say something.
const FEWEST_ASKED: usize = 50;
/// Vertices a height field goes through, more than it has terms.
const LEAST_REST: usize = 8;
/// Most edges at the vertices reached before the next ring, all told; two rings of a regular mesh have 114. Those of a hub
/// are a whole fan.
const MOST_EDGES: usize = 200;

/// A vertex with those about it.
pub(crate) struct Neighbourhood {
    /// In a frame whose z is the normal, the farthest a unit away.
    local: Vec<DVec3>,
    radius: f64,
    /// Least cosine between the normal and those of the triangles round the vertex.
    pub turn_cos: f64,
}

/// What is said of vertices from all over the mesh, each with those about it up to so many `rings`. `None` if too few
/// say something.
pub(crate) fn of_some(
    ground: Ground,
    rings: usize,
    say: impl Fn(Neighbourhood) -> Option<f64> + Sync,
) -> Option<Vec<f64>> {
    let count = ground.positions.len();
    let step = count.div_ceil(MOST_ASKED).max(1);
    let asked: Vec<u32> = (0..count as u32).step_by(step).collect();
    let said = asked.into_par_iter();
    let said = said.filter_map(|v| say(Neighbourhood::of(ground, v, rings)?));
    let said: Vec<f64> = said.collect();
    (said.len() >= FEWEST_ASKED).then_some(said)
}

impl Neighbourhood {
    /// `None` at hubs, and where there is no normal.
    fn of(ground: Ground, vertex: u32, rings: usize) -> Option<Self> {
        let topology = ground.topology;
        let around = |v: u32| {
            let edges = topology.vertex_edges.row(v as usize).iter();
            edges.map(move |&edge| topology.far_end(edge, v))
        };
        let valence = |v: u32| topology.vertex_edges.row(v as usize).len();
        let mut about = vec![vertex];
        for _ in 0..rings {
            if about.iter().map(|&v| valence(v)).sum::<usize>() > MOST_EDGES {
                return None;
            }
            let next: Vec<u32> = about.iter().copied().flat_map(around).collect();
            about.extend(next);
            about.sort_unstable();
            about.dedup();
        }
        let faces = topology.vertex_faces.row(vertex as usize).iter();
        let normals = faces.map(|&face| ground.triangles.normals[face as usize]);
        let z = normals.clone().sum::<DVec3>().try_normalize()?;
        let (x, y) = z.any_orthonormal_pair();
        let origin = ground.positions[vertex as usize];
        let away = |v: &u32| ground.positions[*v as usize] - origin;
        let radius = about.iter().map(|v| away(v).length()).fold(0.0, f64::max);
        let local = about.iter().map(|v| {
            let away = away(v) / radius;
            DVec3::new(away.dot(x), away.dot(y), away.dot(z))
        });
        Some(Self {
            local: local.collect(),
            radius,
            turn_cos: normals.map(|normal| normal.dot(z)).fold(1.0, f64::min),
        })
    }

    /// Standard deviation of the vertices from the height field nearest to them. `None` if they are hardly more than
    /// its terms, and where nothing can be solved.
    pub fn off<const N: usize>(&self, terms: Terms<N>) -> Option<f64> {
        let freedom = self.local.len().checked_sub(N)?;
        if freedom < LEAST_REST {
            return None;
        }
        let field = heights::fit(terms, self.local.iter().copied(), |_| 1.0)?;
        let above = |&x: &DVec3| heights::above(terms, &field, x);
        let squares: f64 = self.local.iter().map(|x| above(x).powi(2)).sum();
        Some(self.radius * (squares / freedom as f64).sqrt())
    }
}
