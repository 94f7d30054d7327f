//! A classifier that climbs: every sample goes uphill on the density of all, and those that end on the same
//! summit are one cluster (mean shift: Fukunaga and Hostetler 1975, Comaniciu and Meer 2002).
//!
//! The density lives on a square grid in the plane of both curvatures, so that a summit that only the two
//! together have is seen, which the histograms of each alone would miss; and the climb is from cell to cell,
//! so that it costs a pass over the grid however many samples there are.

mod density;

use schemars::JsonSchema;
use seamline_ecs::components::SampleCluster;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Classifier, Clusters, CurvatureSamples, StepError};
use serde::{Deserialize, Serialize};

pub use density::Density;

/// The plugin, and its `[mean-shift]` table.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeanShiftSettings {
    /// Curvature that counts as barely curved, over the part's size: samples are compared by `ln(1 + c / this)`. Over
    /// the bench .864 with 0.2 and with 0.4, .862 with 0.8.
    pub barely_curved: f64,
    /// Standard deviation of the Gaussian each sample adds to the density, in what is compared. Two heaps
    /// nearer than about twice this are one. The mean of ARI, boundary F1 and exact over the bench
    /// (`plugins/COMPARISON.md`) is .861 with 0.06, .864 with 0.12, .859 with 0.24.
    pub bandwidth: f64,
}

impl StepSettings for MeanShiftSettings {
    const TABLE: &'static str = "mean-shift";

    fn defaults(_: Profile) -> Self {
        Self {
            barely_curved: 0.4,
            bandwidth: 0.12,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.barely_curved > 0.0,
            "barely_curved",
            "a curvature above 0",
        )?;
        OutOfRange::unless(
            (0.01..=10.0).contains(&self.bandwidth),
            "bandwidth",
            "a standard deviation from 0.01 to 10",
        )
    }
}

impl Classifier for MeanShiftSettings {
    const SUMMARY: &'static str =
        "samples climb the density of curvature; those of one summit are one cluster";

    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        let points = samples.log_curvatures(self.barely_curved);
        let of_sample = classify(&points, self);
        let clusters = of_sample.iter().map(|c| c.0 as usize + 1).max();
        Ok(Clusters {
            of_sample,
            counts: vec![("clusters", clusters.unwrap_or(0))],
        })
    }
}

/// Clusters points, none of them negative, by the summit each climbs to. Clusters are numbered from 0 without
/// gaps.
pub fn classify(points: &[[f64; 2]], settings: &MeanShiftSettings) -> Vec<SampleCluster> {
    let density = Density::of(points, settings.bandwidth);
    let summits = density.summits();
    let mut numbers = vec![u32::MAX; summits.len()];
    let mut count = 0;
    let number = |point: &[f64; 2]| {
        let number = &mut numbers[summits[density.cell(*point)]];
        if *number == u32::MAX {
            *number = count;
            count += 1;
        }
        SampleCluster(*number)
    };
    points.iter().map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings() -> MeanShiftSettings {
        MeanShiftSettings::defaults(Profile::Cad)
    }

    #[test]
    fn planes_and_two_radii_are_three_clusters() {
        let points: Vec<[f64; 2]> = (0..300).map(|i| [0.0, f64::from(i % 3)]).collect();
        for (i, cluster) in classify(&points, &settings()).iter().enumerate() {
            assert_eq!(cluster.0, i as u32 % 3);
        }
    }

    #[test]
    fn two_heaps_nearer_than_twice_the_bandwidth_are_one_and_farther_are_two() {
        // The sum of two equal Gaussians has one summit up to two deviations between them.
        for (apart, clusters) in [(1.6, 1), (2.6, 2)] {
            let apart = apart * settings().bandwidth;
            let points: Vec<[f64; 2]> = (0..40)
                .map(|i| [0.5, 1.0 + apart * f64::from(i % 2)])
                .collect();
            let found = classify(&points, &settings());
            assert_eq!(
                found.iter().map(|c| c.0 + 1).max(),
                Some(clusters),
                "{apart}"
            );
        }
    }

    #[test]
    fn no_samples_are_no_clusters_and_equal_ones_are_one() {
        assert!(classify(&[], &settings()).is_empty());
        assert_eq!(
            classify(&[[1.0, 2.0]; 9], &settings()),
            [SampleCluster(0); 9]
        );
    }
}
