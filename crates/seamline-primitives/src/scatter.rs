//! Whether vertices scatter about the surface as noise makes them.
//!
//! Where every vertex is moved at random, none is left with all those about it on one smooth surface: what a dozen
//! vertices and more are off the quadric through them is the noise, hardly ever less than half of it. A free form is off
//! its quadrics, too, by what it bends more than they do, but here ten times less than there.

use glam::DVec3;
use rayon::prelude::*;

use crate::ground::Ground;
use crate::quadric;

/// Most vertices that are asked.
const MOST_ASKED: usize = 2000;
/// Fewest that say something.
const FEWEST_ASKED: usize = 50;
/// Fewest vertices a quadric goes through: of the degrees of freedom six are its own.
const FEWEST_ABOUT: usize = 14;
/// Most edges at the neighbours of a vertex, all told: those of a hub are a whole fan, and so are theirs.
const MOST_ABOUT: usize = 200;
/// Share of the vertices, the nearest to their quadrics, among which these leave the noise and nothing else: on a mesh
/// of sharp edges few vertices have all those about them on one face.
const NEAREST: f64 = 0.25;
/// What the last of those is off its quadric, in standard deviations of noise.
const OFF_BY: f64 = 0.85;
/// Share of the noise below which vertices are hardly ever off their quadrics.
const HARDLY_OFF: f64 = 0.5;
/// Share of the vertices that are hardly off from which they are not noisy. Of bench meshes with noise .008 at most are,
/// .05 where it is taken for 1.6 times what it is; of an egg of a spline .11.
const TOO_MANY: f64 = 0.07;

/// Do vertices scatter as noise of the ground's size would make them? Too few to tell do.
pub(crate) fn is_noise(ground: Ground) -> bool {
    let count = ground.positions.len();
    let step = count.div_ceil(MOST_ASKED).max(1);
    let asked: Vec<u32> = (0..count as u32).step_by(step).collect();
    let off = asked.into_par_iter().filter_map(|v| off_quadric(ground, v));
    let mut off: Vec<f64> = off.collect();
    if off.len() < FEWEST_ASKED {
        return true;
    }
    off.sort_unstable_by(f64::total_cmp);
    let nearest = off[(NEAREST * off.len() as f64) as usize];
    let noise = ground.noise.min(nearest / OFF_BY);
    let hardly = off.partition_point(|&off| off < HARDLY_OFF * noise);
    (hardly as f64) < TOO_MANY * off.len() as f64
}

/// Standard deviation of a vertex, its neighbours and theirs from the quadric nearest to them; `None` of
/// too few or many, and where nothing can be solved.
fn off_quadric(ground: Ground, vertex: u32) -> Option<f64> {
    let topology = ground.topology;
    let around = |v: u32| {
        let edges = topology.vertex_edges.row(v as usize).iter();
        edges.map(move |&edge| topology.far_end(edge, v))
    };
    let valence = |v: u32| topology.vertex_edges.row(v as usize).len();
    if around(vertex).map(valence).sum::<usize>() > MOST_ABOUT {
        return None;
    }
    let mut about: Vec<u32> = around(vertex)
        .flat_map(around)
        .chain(around(vertex))
        .collect();
    about.push(vertex);
    about.sort_unstable();
    about.dedup();
    if about.len() < FEWEST_ABOUT {
        return None;
    }
    let corners = topology.vertex_faces.row(vertex as usize).iter();
    let z = corners
        .map(|&face| ground.triangles.normals[face as usize])
        .sum::<DVec3>();
    let z = z.try_normalize()?;
    let (x, y) = z.any_orthonormal_pair();
    let origin = ground.positions[vertex as usize];
    let away = |v: &u32| ground.positions[*v as usize] - origin;
    let radius = about.iter().map(|v| away(v).length()).fold(0.0, f64::max);
    let local = about.iter().map(|v| {
        let away = away(v) / radius;
        DVec3::new(away.dot(x), away.dot(y), away.dot(z))
    });
    let local: Vec<DVec3> = local.collect();
    let quadric = quadric::fit(local.iter().copied(), |_| 1.0)?;
    let squares = local.iter().map(|&x| quadric::above(&quadric, x).powi(2));
    Some(radius * (squares.sum::<f64>() / (local.len() - quadric.len()) as f64).sqrt())
}
