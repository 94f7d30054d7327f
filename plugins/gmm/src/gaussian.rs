//! One Gaussian in the plane.

use std::f64::consts::PI;

use crate::WeightedPoint;

/// A normal distribution of two numbers, with its share of the mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaussian {
    /// Its share of all samples.
    pub share: f64,
    /// Mean.
    pub mean: [f64; 2],
    /// Covariance: `xx, xy, yy`.
    pub covariance: [f64; 3],
}

impl Gaussian {
    /// The likeliest Gaussian behind weighted points: their mean and covariance, each weight being that of the
    /// point times its responsibility. `whole` is the weight of all points. Nothing where the weights are zero.
    ///
    /// No direction is narrower than a standard deviation of `least_spread`.
    pub fn behind(
        points: &[WeightedPoint],
        responsibility: impl Fn(usize) -> f64,
        whole: f64,
        least_spread: f64,
    ) -> Option<Self> {
        let weights = || (0..points.len()).map(|i| points[i].weight * responsibility(i));
        let weight: f64 = weights().sum();
        if weight <= 1e-9 * whole {
            return None;
        }
        let mean = [0, 1].map(|k| {
            let sum: f64 = points.iter().zip(weights()).map(|(p, w)| w * p.at[k]).sum();
            sum / weight
        });
        let mut covariance = [0.0; 3];
        for (point, w) in points.iter().zip(weights()) {
            let [x, y] = [point.at[0] - mean[0], point.at[1] - mean[1]];
            covariance[0] += w * x * x;
            covariance[1] += w * x * y;
            covariance[2] += w * y * y;
        }
        let mut gaussian = Self {
            share: weight / whole,
            mean,
            covariance: covariance.map(|sum| sum / weight),
        };
        gaussian.widen(least_spread * least_spread);
        Some(gaussian)
    }

    /// Logarithm of share times density at a point.
    pub fn log_weighted_density(&self, at: [f64; 2]) -> f64 {
        let [xx, xy, yy] = self.covariance;
        let determinant = xx * yy - xy * xy;
        let [x, y] = [at[0] - self.mean[0], at[1] - self.mean[1]];
        let mahalanobis = (yy * x * x - 2.0 * xy * x * y + xx * y * y) / determinant;
        self.share.ln() - (2.0 * PI).ln() - 0.5 * determinant.ln() - 0.5 * mahalanobis
    }

    /// Variance along the longest axis, and its unit direction.
    pub fn longest_axis(&self) -> (f64, [f64; 2]) {
        let [xx, xy, yy] = self.covariance;
        let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
        let half = ((xx - yy) / 2.0).hypot(xy);
        ((xx + yy) / 2.0 + half, [angle.cos(), angle.sin()])
    }

    /// Two halves, cut across the longest axis: what the two sides of one Gaussian look like.
    pub fn halves(&self, least_spread: f64) -> [Self; 2] {
        let (variance, [x, y]) = self.longest_axis();
        // The mean of half a normal distribution lies sqrt(2 / pi) deviations out; the rest is its variance.
        let out = (variance * 2.0 / PI).sqrt();
        let lost = variance * 2.0 / PI;
        [-1.0, 1.0].map(|side| {
            let mut half = Self {
                share: self.share / 2.0,
                mean: [self.mean[0] + side * out * x, self.mean[1] + side * out * y],
                covariance: [
                    self.covariance[0] - lost * x * x,
                    self.covariance[1] - lost * x * y,
                    self.covariance[2] - lost * y * y,
                ],
            };
            half.widen(least_spread * least_spread);
            half
        })
    }

    /// Lifts both principal variances to `least` at least.
    fn widen(&mut self, least: f64) {
        let (longest, [x, y]) = self.longest_axis();
        let shortest = self.covariance[0] + self.covariance[2] - longest;
        let (long, short) = (longest.max(least), shortest.max(least));
        self.covariance = [
            long * x * x + short * y * y,
            (long - short) * x * y,
            long * y * y + short * x * x,
        ];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12
    }

    fn points(at: &[[f64; 2]]) -> Vec<WeightedPoint> {
        let weighted = |&at: &[f64; 2]| WeightedPoint { at, weight: 1.0 };
        at.iter().map(weighted).collect()
    }

    #[test]
    fn four_corners_of_a_rectangle_have_the_variance_of_its_half_sides() {
        let corners = points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]]);
        let found = Gaussian::behind(&corners, |_| 1.0, 4.0, 1e-3).unwrap();
        assert!(near(found.share, 1.0));
        assert_eq!(found.mean, [2.0, 1.0]);
        let [xx, xy, yy] = found.covariance;
        assert!(near(xx, 4.0) && near(xy, 0.0) && near(yy, 1.0));
        assert!(near(found.longest_axis().0, 4.0));
    }

    #[test]
    fn points_on_a_slanting_line_have_a_correlation_and_the_least_spread_across() {
        let line = points(&[[-1.0, -1.0], [0.0, 0.0], [1.0, 1.0]]);
        let found = Gaussian::behind(&line, |_| 1.0, 3.0, 0.1).unwrap();
        let [xx, xy, yy] = found.covariance;
        // Variance 4/3 along the line, 0.01 across.
        assert!(near(xx, (4.0 / 3.0 + 0.01) / 2.0) && near(yy, xx));
        assert!(near(xy, (4.0 / 3.0 - 0.01) / 2.0));
    }

    #[test]
    fn the_density_at_the_mean_of_a_round_gaussian_is_one_over_two_pi_variances() {
        let round = Gaussian {
            share: 1.0,
            mean: [3.0, 5.0],
            covariance: [0.25, 0.0, 0.25],
        };
        let density = round.log_weighted_density([3.0, 5.0]).exp();
        assert!(near(density, 1.0 / (2.0 * PI * 0.25)));
        let one_deviation_out = round.log_weighted_density([3.5, 5.0]).exp();
        assert!(near(one_deviation_out, density * (-0.5f64).exp()));
    }

    #[test]
    fn two_halves_have_together_the_mean_and_the_variance_of_the_whole() {
        let whole = Gaussian {
            share: 0.5,
            mean: [1.0, 2.0],
            covariance: [2.0, 0.5, 1.0],
        };
        let [a, b] = whole.halves(1e-3);
        for k in 0..2 {
            assert!(near((a.mean[k] + b.mean[k]) / 2.0, whole.mean[k]));
        }
        let between =
            |j: usize, k: usize| (a.mean[j] - whole.mean[j]) * (a.mean[k] - whole.mean[k]);
        for (at, (j, k)) in [(0, 0), (0, 1), (1, 1)].into_iter().enumerate() {
            assert!(near(a.covariance[at] + between(j, k), whole.covariance[at]));
        }
    }
}
