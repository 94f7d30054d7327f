//! Polynomial height fields through points.

use glam::DVec3;

use crate::linear::solve;

/// What is added to the diagonal of the normal equations, as a share of their trace, so that points on two lines have a
/// fit, too.
const RIDGE: f64 = 1e-9;

/// Terms of a height field at `x` and `y`.
pub(crate) type Terms<const N: usize> = fn(DVec3) -> [f64; N];

/// 1, x, y, x², xy and y².
pub(crate) fn quadric(DVec3 { x, y, .. }: DVec3) -> [f64; 6] {
    [1.0, x, y, x * x, x * y, y * y]
}

/// All products of at most four x and y.
pub(crate) fn quartic(at: DVec3) -> [f64; 15] {
    let DVec3 { x, y, .. } = at;
    let [one, _, _, xx, xy, yy] = quadric(at);
    let [xxx, xxy, xyy, yyy] = [xx * x, xx * y, x * yy, yy * y];
    [
        one,
        x,
        y,
        xx,
        xy,
        yy,
        xxx,
        xxy,
        xyy,
        yyy,
        xx * xx,
        xxx * y,
        xx * yy,
        x * yyy,
        yy * yy,
    ]
}

/// Factors of the terms whose sum is nearest in height (z) to points whose x and y are within a unit, each counted by
/// its weight.
pub(crate) fn fit<const N: usize>(
    terms: Terms<N>,
    points: impl Iterator<Item = DVec3>,
    weight: impl Fn(DVec3) -> f64,
) -> Option<[f64; N]> {
    let mut m = [[0.0; N]; N];
    let mut right = [0.0; N];
    for x in points {
        let weight = weight(x);
        let row = terms(x);
        for i in 0..N {
            right[i] += weight * row[i] * x.z;
            for j in 0..=i {
                m[i][j] += weight * row[i] * row[j];
            }
        }
    }
    let trace: f64 = (0..N).map(|i| m[i][i]).sum();
    for (i, row) in m.iter_mut().enumerate() {
        row[i] += RIDGE * trace;
    }
    solve(m, right)
}

/// How far a point is above a height field.
pub(crate) fn above<const N: usize>(terms: Terms<N>, factors: &[f64; N], x: DVec3) -> f64 {
    let heights = factors.iter().zip(terms(x)).map(|(f, t)| f * t);
    x.z - heights.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What points of a height field of degree four are off the nearest of some terms, at most.
    fn most_off<const N: usize>(terms: Terms<N>) -> f64 {
        let at = |i: i32| f64::from(i) / 3.0;
        let grid = (-3..=3).flat_map(|i| (-3..=3).map(move |j| [at(i), at(j)]));
        let height = |[x, y]: [f64; 2]| 0.3 + x - x * y + 0.5 * y * y * y + 0.2 * x * x * y * y;
        let points: Vec<DVec3> = grid
            .map(|[x, y]| DVec3::new(x, y, height([x, y])))
            .collect();
        let factors = fit(terms, points.iter().copied(), |_| 1.0).expect("there is one");
        let off = points.iter().map(|&x| above(terms, &factors, x).abs());
        off.fold(0.0, f64::max)
    }

    #[test]
    fn a_quartic_goes_through_a_field_of_degree_four_and_a_quadric_does_not() {
        assert!(most_off(quartic) < 1e-6);
        assert!(most_off(quadric) > 0.1);
    }
}
