//! A classifier that cuts where nothing is: at the valleys of the histogram of curvature, weighted by area.
//!
//! The paper leaves the "histogram distribution" of curvature to later work (section 6). A part of planes and
//! three radii has four peaks in its histogram, and the valleys between them say how many clusters there are;
//! no number has to be given. Each of the two curvatures has a histogram of its own; a cluster is what lies
//! between the same valleys in both.

mod valleys;

use schemars::JsonSchema;
use seamline_ecs::components::SampleCluster;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Classifier, Clusters, CurvatureSamples, StepError};
use serde::{Deserialize, Serialize};

pub use valleys::{smooth, valleys};

/// The plugin, and its `[histogram]` table.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HistogramSettings {
    /// Curvature that counts as barely curved, over the part's size: what is counted is `ln(1 + c / this)`. Over the
    /// bench .867 with 0.2, .865 with 0.4, .863 with 0.8.
    pub barely_curved: f64,
    /// Width of a bin, in what is counted: at large curvature, a share of the radius. The mean of ARI,
    /// boundary F1 and exact over the bench (`plugins/COMPARISON.md`) is .865 with 0.01 and with 0.02, .860 with 0.04.
    pub bin: f64,
    /// The histogram is smoothed by a Gaussian of this standard deviation, in what is counted. Over the bench: .866 with
    /// 0.01, .865 with 0.02, .854 with 0.04.
    pub smoothing: f64,
    /// A dip is a valley if it is lower than this share of the lower of the two peaks beside it. Over the bench:
    /// .856 with 0.25, .865 with 0.5, .861 with 0.75.
    pub valley_below_share: f64,
}

impl StepSettings for HistogramSettings {
    const TABLE: &'static str = "histogram";

    fn defaults(_: Profile) -> Self {
        Self {
            barely_curved: 0.4,
            bin: 0.02,
            smoothing: 0.02,
            valley_below_share: 0.5,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.barely_curved > 0.0,
            "barely_curved",
            "a curvature above 0",
        )?;
        OutOfRange::unless(
            (1e-3..=10.0).contains(&self.bin),
            "bin",
            "a width from 0.001 to 10",
        )?;
        OutOfRange::unless(
            (0.0..=10.0).contains(&self.smoothing),
            "smoothing",
            "a standard deviation from 0 to 10",
        )?;
        OutOfRange::unless(
            (0.0..=1.0).contains(&self.valley_below_share),
            "valley_below_share",
            "a share from 0 to 1",
        )
    }
}

impl Classifier for HistogramSettings {
    const SUMMARY: &'static str =
        "valleys of the area-weighted histograms of curvature; finds the number of clusters itself";

    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        let values = samples.log_curvatures(self.barely_curved);
        let (of_sample, [low, high]) = classify(&values, &samples.areas(), self);
        let clusters = of_sample.iter().map(|c| c.0 as usize + 1).max();
        Ok(Clusters {
            of_sample,
            counts: vec![
                ("clusters", clusters.unwrap_or(0)),
                ("valleys_k_min", low),
                ("valleys_k_max", high),
            ],
        })
    }
}

/// Clusters values, each with its weight, by the valleys of their histograms. Gives the cluster of each,
/// numbered from 0 without gaps, and how many valleys each of the two histograms has.
pub fn classify(
    values: &[[f64; 2]],
    weights: &[f64],
    settings: &HistogramSettings,
) -> (Vec<SampleCluster>, [usize; 2]) {
    let parts = [0, 1].map(|k| {
        let bins: Vec<usize> = values
            .iter()
            .map(|value| (value[k] / settings.bin) as usize)
            .collect();
        let mut heights = vec![0.0; bins.iter().max().map_or(0, |last| last + 1)];
        for (&bin, weight) in bins.iter().zip(weights) {
            heights[bin] += weight;
        }
        let heights = smooth(&heights, settings.smoothing / settings.bin);
        let cuts = valleys(&heights, settings.valley_below_share);
        let part = |&bin: &usize| cuts.partition_point(|&cut| cut <= bin) as u32;
        (bins.iter().map(part).collect::<Vec<_>>(), cuts.len())
    });
    let [(low, low_cuts), (high, high_cuts)] = parts;

    let mut numbers = vec![u32::MAX; (low_cuts + 1) * (high_cuts + 1)];
    let mut count = 0;
    let pairs = low.into_iter().zip(high);
    let of_sample = pairs.map(|(low, high)| {
        let number = &mut numbers[low as usize * (high_cuts + 1) + high as usize];
        if *number == u32::MAX {
            *number = count;
            count += 1;
        }
        SampleCluster(*number)
    });
    (of_sample.collect(), [low_cuts, high_cuts])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn settings() -> HistogramSettings {
        HistogramSettings::defaults(Profile::Cad)
    }

    #[test]
    fn planes_and_two_radii_are_three_clusters() {
        let values: Vec<[f64; 2]> = (0..300).map(|i| [0.0, f64::from(i % 3)]).collect();
        let (of_sample, cuts) = classify(&values, &[1.0; 300], &settings());
        assert_eq!(cuts, [0, 2]);
        for (i, cluster) in of_sample.iter().enumerate() {
            assert_eq!(cluster.0, i as u32 % 3);
        }
    }

    #[test]
    fn a_cylinder_and_a_sphere_of_one_radius_differ_in_the_other_curvature() {
        let values: Vec<[f64; 2]> = (0..20).map(|i| [f64::from(i % 2), 1.0]).collect();
        let (of_sample, cuts) = classify(&values, &[1.0; 20], &settings());
        assert_eq!(cuts, [1, 0]);
        assert_ne!(of_sample[0], of_sample[1]);
    }

    #[test]
    fn no_samples_are_no_clusters_and_samples_without_area_are_one() {
        assert!(classify(&[], &[], &settings()).0.is_empty());
        let (of_sample, _) = classify(&[[0.0, 1.0], [0.0, 9.0]], &[0.0; 2], &settings());
        assert_eq!(of_sample, [SampleCluster(0); 2]);
    }

    proptest! {
        #[test]
        fn what_lies_between_two_values_of_one_cluster_is_in_it_too(
            values in prop::collection::vec(0.0f64..5.0, 3..100),
        ) {
            let mut values = values;
            values.sort_by(f64::total_cmp);
            let pairs: Vec<_> = values.iter().map(|&value| [0.0, value]).collect();
            let (of_sample, [_, cuts]) = classify(&pairs, &vec![1.0; pairs.len()], &settings());
            prop_assert!(of_sample.is_sorted_by_key(|cluster| cluster.0));
            prop_assert!(of_sample.last().unwrap().0 as usize <= cuts);
        }
    }
}
