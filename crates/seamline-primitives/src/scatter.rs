//! Whether vertices scatter about the surface as noise makes them.
//!
//! Where every vertex is moved at random, none is left with all those about it on one smooth surface: what a dozen
//! vertices and more are off the quadric through them is the noise, hardly ever less than half of it. A free form is off
//! its quadrics, too, by what it bends more than they do, but here ten times less than there.

use crate::ground::Ground;
use crate::heights::quadric;
use crate::neighbourhoods::of_some;

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

/// Rings of a neighbourhood.
const RINGS: usize = 2;

/// Do vertices scatter as noise of the ground's size would make them? Too few to tell do.
pub(crate) fn is_noise(ground: Ground) -> bool {
    let Some(mut off) = of_some(ground, RINGS, |about| about.off(quadric)) else {
        return true;
    };
    off.sort_unstable_by(f64::total_cmp);
    let nearest = off[(NEAREST * off.len() as f64) as usize];
    let noise = ground.noise.min(nearest / OFF_BY);
    let hardly = off.partition_point(|&off| off <= HARDLY_OFF * noise);
    (hardly as f64) < TOO_MANY * off.len() as f64
}
