//! A classifier that asks how curvature varies: a mixture of Gaussians by expectation and maximisation, with
//! full covariances, and as many of them as the Bayesian information criterion finds worth their price.
//!
//! The paper leaves "variance" of curvature to later work (section 6). Here a cluster has one of its own: a
//! plane, whose curvature is nothing at all, and the noisy side of a cone each get the width they have.
//!
//! Mixtures grow by splitting: the one with a component more begins as the one before, with the component that
//! spreads most of the samples farthest cut across its longest axis. So there is no seed, and the same
//! samples give the same answer. `linfa-clustering`, the crate there is for mixtures, starts from random
//! seeds, knows no weights and no criterion, and would bring `ndarray` and its linear algebra for matrices of
//! two by two.

mod gaussian;
mod mixture;

use schemars::JsonSchema;
use seamline_ecs::components::SampleCluster;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Classifier, Clusters, CurvatureSamples, StepError};
use serde::{Deserialize, Serialize};

pub use gaussian::Gaussian;
pub use mixture::{Mixture, WeightedPoint};

/// The plugin, and its `[gmm]` table.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GmmSettings {
    /// Components there are at most; the criterion mostly stops before. Over the bench (`plugins/COMPARISON.md`) the mean of
    /// ARI, boundary F1 and exact is .853 with 8, .860 with 16 and with 32.
    pub max_components: u32,
    /// Curvature that counts as barely curved, over the part's size: what is compared is `ln(1 + c / this)`. Over
    /// the bench .862 with 0.2, .860 with 0.4, .845 with 0.8.
    pub barely_curved: f64,
    /// No component is narrower than this in any direction, as a standard deviation of what is compared. Many
    /// samples are exactly equal, and what is exactly equal would be a component of its own. Over the bench: .857 with 0.1,
    /// .860 with 0.2, .827 with 0.4.
    pub least_spread: f64,
    /// Rounds of expectation and maximisation for each number of components at most. Not critical: over the bench .863
    /// with 10, .860 with 20, .859 with 40.
    pub max_rounds: u32,
}

impl StepSettings for GmmSettings {
    const TABLE: &'static str = "gmm";

    fn defaults(_: Profile) -> Self {
        Self {
            max_components: 16,
            barely_curved: 0.4,
            least_spread: 0.2,
            max_rounds: 20,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (1..=100).contains(&self.max_components),
            "max_components",
            "a number from 1 to 100",
        )?;
        OutOfRange::unless(
            self.barely_curved > 0.0,
            "barely_curved",
            "a curvature above 0",
        )?;
        OutOfRange::unless(
            self.least_spread >= 1e-6,
            "least_spread",
            "a standard deviation of 0.000001 or more",
        )?;
        OutOfRange::unless(
            (1..=10_000).contains(&self.max_rounds),
            "max_rounds",
            "a number from 1 to 10000",
        )
    }
}

impl Classifier for GmmSettings {
    const SUMMARY: &'static str =
        "Gaussian mixture with full covariances, as many components as the BIC asks for";

    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        let points = samples.log_curvatures(self.barely_curved);
        let (of_sample, fitted) = classify(&points, self);
        let clusters = 1 + of_sample.iter().map(|c| c.0 as usize).max().unwrap_or(0);
        Ok(Clusters {
            counts: vec![
                ("clusters", clusters.min(of_sample.len())),
                ("components", fitted.components.len()),
                ("components_tried", fitted.tried),
            ],
            of_sample,
        })
    }
}

/// Clusters points by the component most likely to have made each, numbered from 0 without gaps. Gives the
/// mixture as well.
pub fn classify(points: &[[f64; 2]], settings: &GmmSettings) -> (Vec<SampleCluster>, Mixture) {
    let cells = gather(points, settings.least_spread / 4.0);
    let mixture = Mixture::best(
        &cells,
        settings.max_components as usize,
        settings.least_spread,
        settings.max_rounds as usize,
    );
    let mut numbers = vec![u32::MAX; mixture.components.len()];
    let mut count = 0;
    let number = |point: &[f64; 2]| {
        let number = &mut numbers[mixture.likeliest(*point)];
        if *number == u32::MAX {
            *number = count;
            count += 1;
        }
        SampleCluster(*number)
    };
    (points.iter().map(number).collect(), mixture)
}

/// Points that share a cell of a square grid, as one point at their mean: a mixture no narrower than four cells
/// does not see the difference, and a million samples are a few hundred cells.
fn gather(points: &[[f64; 2]], cell: f64) -> Vec<WeightedPoint> {
    let mut cells: Vec<([i64; 2], [f64; 2])> = points
        .iter()
        .map(|&point| (point.map(|x| (x / cell).floor() as i64), point))
        .collect();
    cells.sort_by_key(|&(cell, _)| cell);
    cells
        .chunk_by(|a, b| a.0 == b.0)
        .map(|alike| {
            let weight = alike.len() as f64;
            let mean = [0, 1].map(|k| alike.iter().map(|(_, p)| p[k]).sum::<f64>() / weight);
            WeightedPoint { at: mean, weight }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings() -> GmmSettings {
        GmmSettings::defaults(Profile::Cad)
    }

    #[test]
    fn planes_and_two_radii_are_three_clusters() {
        let points: Vec<[f64; 2]> = (0..300)
            .map(|i| [0.0, f64::from(i % 3) * 2.0 + f64::from(i) * 1e-4])
            .collect();
        let (of_sample, mixture) = classify(&points, &settings());
        assert_eq!(mixture.components.len(), 3);
        for (i, cluster) in of_sample.iter().enumerate() {
            assert_eq!(*cluster, of_sample[i % 3]);
        }
    }

    #[test]
    fn a_narrow_and_a_wide_heap_each_keep_their_own_spread() {
        // Between the two, the middle belongs to the wide one: it is where the narrow one never is.
        let narrow = (0..200).map(|i| [0.0, 0.001 * f64::from(i % 10)]);
        let wide = (0..200).map(|i| [0.0, 3.0 + 0.01 * f64::from(i - 100)]);
        let points: Vec<_> = narrow.chain(wide).chain([[0.0, 1.2]]).collect();
        let narrow = GmmSettings {
            max_components: 2,
            ..settings()
        };
        let (of_sample, _) = classify(&points, &narrow);
        assert_eq!(of_sample[400], of_sample[300]);
        assert_ne!(of_sample[400], of_sample[0]);
    }

    #[test]
    fn no_samples_are_no_clusters_and_equal_ones_are_one() {
        assert!(classify(&[], &settings()).0.is_empty());
        let (of_sample, _) = classify(&[[1.0, 2.0]; 50], &settings());
        assert_eq!(of_sample, [SampleCluster(0); 50]);
    }
}
