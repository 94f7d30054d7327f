//! Whether vertices lie on smooth surfaces, though on none of the five kinds.
//!
//! Vertices a modeller computed are on a surface that has all derivatives: what those about one of them are off the
//! quadric through them is its next derivatives, and a quartic takes nearly all of that away, the more the finer the
//! mesh. Of a natural shape, and of noise, it leaves more.

use crate::ground::Ground;
use crate::heights::{quadric, quartic};
use crate::neighbourhoods::of_some;

/// Rings of a neighbourhood: two have hardly more vertices than a quartic has terms.
const RINGS: usize = 3;
/// What the quartic leaves of what the quadric does, at half of the vertices, at most. Of pebbles, eggs and rings of one
/// free form .03 to .06 on fine meshes, .18 to .21 on coarse ones; of the rocker arm of the paper .34, of noise .9. Too
/// coarse a mesh of a smooth form is not told from a natural shape: an ellipsoid of 320 triangles has .26 to .7.
const LEFT: f64 = 0.27;
/// Least cosine (26 degrees) between the normals at a vertex and those of its triangles: across a sharp edge there is no
/// height field. The rims of a cylinder of 206 vertices, along which quartics leave little of noise, have .7.
const LEAST_COS: f64 = 0.9;

/// Do vertices lie on smooth surfaces? Too few to tell do not. Half of all vertices decides, also of several bodies in one
/// mesh.
pub(crate) fn is_smooth(ground: Ground) -> bool {
    let left = of_some(ground, RINGS, |about| {
        if about.turn_cos < LEAST_COS {
            return None;
        }
        let off = about.off(quadric)?;
        Some(about.off(quartic)? / off).filter(|left| left.is_finite())
    });
    left.is_some_and(|mut left| {
        let middle = left.len() / 2;
        *left.select_nth_unstable_by(middle, f64::total_cmp).1 <= LEFT
    })
}
