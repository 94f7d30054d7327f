//! The paper's classifier: k-means on principal curvatures, then regularisation (paper 4.2.2).
//!
//! Seeds are not drawn at random but chosen: first the sample nearest to no curvature at all, then always
//! the sample farthest from all chosen. Random seeds fall mostly on the planes; these give the same final
//! counts as the paper without a seed to set, and the same answer every time.

mod cluster;
mod regularise;
mod seeds;

use schemars::JsonSchema;
use seamline_ecs::components::{SampleCluster, SampleFeature};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Classifier, Clusters, CurvatureSamples, StepError};
use serde::{Deserialize, Serialize};

pub use cluster::{Clustering, cluster};
pub use regularise::regularise;
pub use seeds::seeds;

/// The plugin, and its `[kmeans]` table.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KMeansSettings {
    /// How many clusters to begin with: `K` of the paper. Not critical: merging evens it out. From 12 to 24
    /// the means over the bench move by .02 at most.
    pub clusters: u32,
    /// A cluster with less than this share of the samples joins the nearest one. In
    /// `cad` 0, since one facet may be a whole fillet.
    pub min_cluster_share: f64,
    /// Two clusters join if their centres are nearer than this share of the diagonal of all centres'
    /// bounding box.
    pub merge_share: f64,
    /// Rounds of assigning and averaging at most.
    pub max_rounds: u32,
}

impl StepSettings for KMeansSettings {
    const TABLE: &'static str = "kmeans";

    fn defaults(profile: Profile) -> Self {
        match profile {
            Profile::Cad => Self {
                clusters: 16,
                min_cluster_share: 0.0,
                merge_share: 0.04,
                max_rounds: 200,
            },
            Profile::Lavoue2005 => Self {
                clusters: 10,
                min_cluster_share: 0.002,
                merge_share: 0.02,
                max_rounds: 200,
            },
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (1..=1000).contains(&self.clusters),
            "clusters",
            "a number from 1 to 1000",
        )?;
        OutOfRange::unless(
            (1..=10_000).contains(&self.max_rounds),
            "max_rounds",
            "a number from 1 to 10000",
        )?;
        let share = |value: f64| (0.0..=1.0).contains(&value);
        OutOfRange::unless(
            share(self.min_cluster_share),
            "min_cluster_share",
            "a share from 0 to 1",
        )?;
        OutOfRange::unless(
            share(self.merge_share),
            "merge_share",
            "a share from 0 to 1",
        )
    }
}

impl Classifier for KMeansSettings {
    const SUMMARY: &'static str =
        "k-means on principal curvatures with regularisation (the paper's)";

    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        let found = classify(samples.features, self);
        Ok(Clusters {
            of_sample: found.of_sample,
            counts: vec![
                ("clusters", found.before),
                ("clusters_regularised", found.after),
                ("rounds", found.rounds),
            ],
        })
    }
}

/// The clusters of samples, and how they came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Classified {
    /// One a sample.
    pub of_sample: Vec<SampleCluster>,
    /// Clusters with members before regularisation.
    pub before: usize,
    /// Clusters after it: `K'` of the paper.
    pub after: usize,
    /// Rounds until nothing changed.
    pub rounds: usize,
}

/// Clusters samples and regularises the clusters. Clusters are numbered from 0 without gaps.
pub fn classify(features: &[SampleFeature], settings: &KMeansSettings) -> Classified {
    let seeds = seeds(features, settings.clusters as usize);
    let clustering = cluster(features, seeds, settings.max_rounds as usize);
    let before = clustering.sizes.iter().filter(|&&size| size > 0).count();
    let rounds = clustering.rounds;
    let (of_sample, after) = regularise(
        features,
        clustering,
        settings.min_cluster_share,
        settings.merge_share,
    );
    Classified {
        of_sample,
        before,
        after,
        rounds,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn features(points: &[[f64; 2]]) -> Vec<SampleFeature> {
        points.iter().map(|&p| SampleFeature(p)).collect()
    }

    fn settings(clusters: u32) -> KMeansSettings {
        KMeansSettings {
            clusters,
            min_cluster_share: 0.0,
            merge_share: 0.0,
            max_rounds: 200,
        }
    }

    #[test]
    fn three_heaps_apart_are_three_clusters() {
        let points: Vec<_> = (0..30)
            .map(|i| {
                [
                    f64::from(i % 3) * 10.0 + f64::from(i) * 1e-3,
                    f64::from(i % 3),
                ]
            })
            .collect();
        let found = classify(&features(&points), &settings(3));
        assert_eq!(found.after, 3);
        for (i, cluster) in found.of_sample.iter().enumerate() {
            assert_eq!(*cluster, found.of_sample[i % 3]);
        }
    }

    #[test]
    fn there_are_no_more_clusters_than_distinct_samples() {
        let found = classify(&features(&[[1.0, 1.0]; 50]), &settings(10));
        assert_eq!((found.before, found.after), (1, 1));
    }

    #[test]
    fn no_samples_are_no_clusters() {
        assert_eq!(classify(&[], &settings(10)).after, 0);
    }

    #[test]
    fn a_cluster_of_one_in_a_thousand_joins_its_neighbour() {
        let mut points = vec![[0.0, 0.0]; 999];
        points.extend(vec![[1.0, 1.0]; 999]);
        points.push([1.5, 1.5]);
        let strict = KMeansSettings {
            min_cluster_share: 0.002,
            ..settings(3)
        };
        let found = classify(&features(&points), &strict);
        assert_eq!((found.before, found.after), (3, 2));
        assert_eq!(found.of_sample[1998], found.of_sample[1000]);
    }

    proptest! {
        #[test]
        fn every_sample_is_in_the_cluster_whose_mean_is_nearest(
            points in prop::collection::vec(prop::array::uniform2(0.0f64..5.0), 1..200),
            clusters in 1u32..9,
        ) {
            let features = features(&points);
            let found = classify(&features, &settings(clusters));
            let mean = |cluster: u32| {
                let members: Vec<_> = (0..points.len()).filter(|&i| found.of_sample[i].0 == cluster).collect();
                let sum = |k: usize| members.iter().map(|&i| points[i][k]).sum::<f64>() / members.len() as f64;
                [sum(0), sum(1)]
            };
            let means: Vec<_> = (0..found.after as u32).map(mean).collect();
            let squared = |p: [f64; 2], m: [f64; 2]| (p[0] - m[0]).powi(2) + (p[1] - m[1]).powi(2);
            for (point, cluster) in points.iter().zip(&found.of_sample) {
                let own = squared(*point, means[cluster.0 as usize]);
                prop_assert!(means.iter().all(|&m| own <= squared(*point, m) + 1e-9));
            }
        }
    }
}
