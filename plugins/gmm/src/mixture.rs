//! Mixtures of Gaussians, and how many Gaussians are worth having.

use crate::gaussian::Gaussian;

/// A point that stands for so many samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedPoint {
    /// Where it lies.
    pub at: [f64; 2],
    /// How many samples it stands for.
    pub weight: f64,
}

/// A mixture of Gaussians.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mixture {
    /// Its components; their shares add up to one.
    pub components: Vec<Gaussian>,
    /// Logarithm of the likelihood of the samples it was fitted to.
    pub log_likelihood: f64,
    /// The most components that were tried before it was found the best.
    pub tried: usize,
}

/// Numbers that make up a component: share, mean, covariance. One share follows from the others.
const NUMBERS_A_COMPONENT: usize = 6;

/// Mixtures this much larger without a better criterion end the search.
const GIVE_UP_AFTER: usize = 4;

/// Fitting ends when a round gains less than this in log-likelihood a sample.
const GAIN_A_SAMPLE: f64 = 1e-5;

impl Mixture {
    /// The mixture of the least Bayesian information criterion (Schwarz 1978), of `most` components at most.
    /// Without points, no component.
    ///
    /// Cost: points x components x rounds for each number of components tried.
    pub fn best(
        points: &[WeightedPoint],
        most: usize,
        least_spread: f64,
        max_rounds: usize,
    ) -> Self {
        let samples: f64 = points.iter().map(|point| point.weight).sum();
        let Some(one) = Gaussian::behind(points, |_| 1.0, samples, least_spread) else {
            return Self::default();
        };
        let mut mixture = Self {
            components: vec![one],
            ..Self::default()
        };
        mixture.fit(points, least_spread, max_rounds);
        let mut best = mixture.clone();
        let mut tried = 1;
        while tried < most && tried < best.components.len() + GIVE_UP_AFTER {
            mixture.split(least_spread);
            mixture.fit(points, least_spread, max_rounds);
            tried += 1;
            if mixture.information_criterion(samples) < best.information_criterion(samples) {
                best = mixture.clone();
            }
        }
        best.tried = tried;
        best
    }

    /// `p ln n - 2 ln L` with `p` free numbers and `n` samples: less is better.
    pub fn information_criterion(&self, samples: f64) -> f64 {
        let free = (NUMBERS_A_COMPONENT * self.components.len() - 1) as f64;
        free * samples.ln() - 2.0 * self.log_likelihood
    }

    /// Rounds of expectation and maximisation until the likelihood no longer rises. A component that loses all
    /// its samples is dropped.
    pub fn fit(&mut self, points: &[WeightedPoint], least_spread: f64, max_rounds: usize) {
        let samples: f64 = points.iter().map(|point| point.weight).sum();
        let mut parts = Vec::new();
        self.log_likelihood = self.expect(points, &mut parts);
        for _ in 0..max_rounds {
            let count = self.components.len();
            let component = |c: usize| {
                Gaussian::behind(points, |i| parts[i * count + c], samples, least_spread)
            };
            self.components = (0..count).filter_map(component).collect();
            let before = self.log_likelihood;
            self.log_likelihood = self.expect(points, &mut parts);
            if self.log_likelihood - before < GAIN_A_SAMPLE * samples {
                break;
            }
        }
    }

    /// The component likeliest to have made a point; of equals, the lower.
    ///
    /// # Panics
    ///
    /// If there is no component.
    pub fn likeliest(&self, at: [f64; 2]) -> usize {
        let densities = self.components.iter().map(|c| c.log_weighted_density(at));
        let best = densities
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        best.expect("a mixture of samples has a component").0
    }

    /// How far each component answers for each point, and the log-likelihood of all.
    fn expect(&self, points: &[WeightedPoint], parts: &mut Vec<f64>) -> f64 {
        let count = self.components.len();
        parts.clear();
        parts.reserve(count * points.len());
        let mut log_likelihood = 0.0;
        for point in points {
            let start = parts.len();
            let densities = self.components.iter();
            parts.extend(densities.map(|c| c.log_weighted_density(point.at)));
            let row = &mut parts[start..];
            let greatest = row.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let mut sum = 0.0;
            for part in row.iter_mut() {
                *part = (*part - greatest).exp();
                sum += *part;
            }
            for part in row {
                *part /= sum;
            }
            log_likelihood += point.weight * (greatest + sum.ln());
        }
        log_likelihood
    }

    /// One component more: that which spreads most of the samples farthest becomes two.
    fn split(&mut self, least_spread: f64) {
        let spread = |gaussian: &Gaussian| gaussian.share * gaussian.longest_axis().0;
        let widest = self
            .components
            .iter()
            .enumerate()
            .max_by(|a, b| spread(a.1).total_cmp(&spread(b.1)).then(b.0.cmp(&a.0)));
        if let Some((at, &gaussian)) = widest {
            let [a, b] = gaussian.halves(least_spread);
            self.components[at] = a;
            self.components.push(b);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use proptest::prelude::*;

    fn points(at: &[[f64; 2]]) -> Vec<WeightedPoint> {
        let weighted = |&at: &[f64; 2]| WeightedPoint { at, weight: 1.0 };
        at.iter().map(weighted).collect()
    }

    /// Two heaps of four points, the corners of squares of side 2 round the origin and round (`apart`, 0).
    fn two_heaps(apart: f64) -> Vec<WeightedPoint> {
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let other = square.map(|[x, y]| [x + apart, y]);
        points(&[square, other].concat())
    }

    #[test]
    fn one_component_has_the_likelihood_of_the_closed_form() {
        // ln L = -n/2 (2 ln 2 pi + ln det + 2): at its own covariance every sample costs one a dimension.
        let points = points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]]);
        let found = Mixture::best(&points, 1, 1e-3, 100);
        let right = -2.0 * (2.0 * (2.0 * PI).ln() + 4f64.ln() + 2.0);
        assert!((found.log_likelihood - right).abs() < 1e-9);
        let criterion = found.information_criterion(4.0);
        assert!((criterion - (5.0 * 4f64.ln() - 2.0 * right)).abs() < 1e-9);
    }

    #[test]
    fn two_heaps_far_apart_are_two_components_at_their_means_with_their_variances() {
        let heavy: Vec<_> = two_heaps(100.0)
            .into_iter()
            .map(|point| WeightedPoint {
                weight: 50.0,
                ..point
            })
            .collect();
        let found = Mixture::best(&heavy, 2, 1e-3, 100);
        assert_eq!(found.components.len(), 2);
        for (component, mean) in found.components.iter().zip([0.0, 100.0]) {
            assert!((component.share - 0.5).abs() < 1e-9);
            assert!((component.mean[0] - mean).abs() < 1e-6);
            assert!((component.covariance[0] - 1.0).abs() < 1e-6);
            assert!((component.covariance[2] - 1.0).abs() < 1e-6);
        }
        // Each sample costs one a dimension and the choice of its half: ln L in closed form.
        let right = -400.0 * ((2.0 * PI).ln() + 1.0 + 2f64.ln());
        assert!((found.log_likelihood - right).abs() < 1e-3);
    }

    #[test]
    fn the_criterion_takes_one_component_for_one_heap() {
        let mut heap = Vec::new();
        for i in 0..20 {
            for j in 0..20 {
                // Quantiles of a normal distribution, near enough: logit over 1.702.
                let quantile = |k: i32| {
                    let p = (f64::from(k) + 0.5) / 20.0;
                    (p / (1.0 - p)).ln() / 1.702
                };
                heap.push([quantile(i), quantile(j)]);
            }
        }
        assert_eq!(
            Mixture::best(&points(&heap), 8, 1e-3, 100).components.len(),
            1
        );
    }

    proptest! {
        #[test]
        fn no_round_makes_the_samples_less_likely(
            at in prop::collection::vec(prop::array::uniform2(0.0f64..5.0), 5..80),
            splits in 1usize..5,
        ) {
            let points = points(&at);
            let mut mixture = Mixture::best(&points, 1, 1e-3, 10);
            for _ in 0..splits {
                mixture.split(1e-3);
            }
            mixture.fit(&points, 1e-3, 0);
            for _ in 0..20 {
                let (before, count) = (mixture.log_likelihood, mixture.components.len());
                mixture.fit(&points, 1e-3, 1);
                prop_assume!(mixture.components.len() == count);
                prop_assert!(mixture.log_likelihood >= before - 1e-6 * (1.0 + before.abs()));
            }
        }

        #[test]
        fn shares_add_up_to_one(
            at in prop::collection::vec(prop::array::uniform2(0.0f64..5.0), 2..80),
        ) {
            let found = Mixture::best(&points(&at), 6, 0.1, 50);
            let sum: f64 = found.components.iter().map(|c| c.share).sum();
            prop_assert!((sum - 1.0).abs() < 1e-6, "{sum}");
        }
    }
}
