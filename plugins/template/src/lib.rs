//! A crate to copy: the least a classifier needs. It is not registered.
//!
//! Copy the folder, rename the crate and the table, write the kernel, and add a line to `plugins/builtin`;
//! `plugins/README.md` goes through it step by step. A rectifier differs in its trait alone
//! ([`seamline_ecs::Rectifier`]).

use schemars::JsonSchema;
use seamline_ecs::components::SampleCluster;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Classifier, Clusters, CurvatureSamples, StepError};
use serde::{Deserialize, Serialize};

/// The plugin, and its `[template]` table.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TemplateSettings {
    /// Greatest curvature that counts as flat, over the part's size.
    pub flat_below: f64,
}

impl StepSettings for TemplateSettings {
    const TABLE: &'static str = "template";

    fn defaults(_: Profile) -> Self {
        Self { flat_below: 0.1 }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.flat_below >= 0.0,
            "flat_below",
            "a curvature of 0 or more",
        )
    }
}

impl Classifier for TemplateSettings {
    const SUMMARY: &'static str = "one cluster for what is flat, one for the rest";

    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        let greatest: Vec<f64> = samples.samples.iter().map(|s| s.curvature[1]).collect();
        Ok(Clusters {
            of_sample: flat_or_not(&greatest, self.flat_below),
            ..Clusters::default()
        })
    }
}

/// The kernel: cluster 0 for the first sample and all that are like it, 1 for the others.
pub fn flat_or_not(curvatures: &[f64], flat_below: f64) -> Vec<SampleCluster> {
    let is_flat = |curvature: &f64| *curvature < flat_below;
    let first = curvatures.first().is_some_and(is_flat);
    curvatures
        .iter()
        .map(|curvature| SampleCluster(u32::from(is_flat(curvature) != first)))
        .collect()
}

#[cfg(test)]
mod tests {
    use seamline_ecs::contract::check;
    use seamline_ecs::{PluginChoice, Registry, SwappableStage};

    use super::*;

    #[test]
    fn flat_and_round_samples_are_two_clusters() {
        let [flat, round] = [0, 1].map(SampleCluster);
        assert_eq!(
            flat_or_not(&[0.0, 2.0, 0.05, 3.0], 0.1),
            [flat, round, flat, round]
        );
        assert_eq!(flat_or_not(&[2.0, 3.0], 0.1), [flat, flat]);
    }

    #[test]
    fn it_keeps_the_contract() {
        let registry = Registry::default().with_classifier::<TemplateSettings>();
        let name = PluginChoice::Named(TemplateSettings::TABLE.to_owned());
        let builtin = seamline_segment::builtin_steps();
        for trial in check(&builtin, &registry, SwappableStage::Classify, &name).unwrap() {
            assert!(trial.breaks.is_empty(), "{}: {:?}", trial.of, trial.breaks);
        }
    }
}
