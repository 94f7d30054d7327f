//! Quadratic height fields through points.

use glam::DVec3;

use crate::linear::solve;

/// What is added to the diagonal of the normal equations, as a share of their trace, so that points on two lines have a
/// fit, too.
const RIDGE: f64 = 1e-9;

/// Coefficients of 1, x, y, x², xy and y².
pub(crate) type Quadric = [f64; 6];

fn monomials(x: DVec3) -> Quadric {
    [1.0, x.x, x.y, x.x * x.x, x.x * x.y, x.y * x.y]
}

/// The quadric nearest in height (z) to points whose x and y are within a unit, each counted by its weight.
pub(crate) fn fit(
    points: impl Iterator<Item = DVec3>,
    weight: impl Fn(DVec3) -> f64,
) -> Option<Quadric> {
    let mut m = [[0.0; 6]; 6];
    let mut right = [0.0; 6];
    for x in points {
        let weight = weight(x);
        let row = monomials(x);
        for i in 0..6 {
            right[i] += weight * row[i] * x.z;
            for j in 0..=i {
                m[i][j] += weight * row[i] * row[j];
            }
        }
    }
    let trace: f64 = (0..6).map(|i| m[i][i]).sum();
    for (i, row) in m.iter_mut().enumerate() {
        row[i] += RIDGE * trace;
    }
    solve(m, right)
}

/// How far a point is above a quadric.
pub(crate) fn above(quadric: &Quadric, x: DVec3) -> f64 {
    let heights = quadric.iter().zip(monomials(x)).map(|(q, m)| q * m);
    x.z - heights.sum::<f64>()
}
