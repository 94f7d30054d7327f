//! The contract of plugins.
//!
//! A plugin fills one of two stages. A [`Classifier`] is shown samples of curvature and gives each a cluster; a
//! [`Rectifier`] is shown a labelled mesh and gives each face a label. Both are values of a settings struct
//! with one method: what a plugin needs it is lent as slices, what it has found it returns. It never holds
//! the world, so that it cannot add rows, keep something of one mesh for the next, or write what is not its
//! own.
//!
//! | | classifier | rectifier |
//! |---|---|---|
//! | stage | [`SwappableStage::Classify`] | [`SwappableStage::Rectify`] |
//! | reads | [`CurvatureSamples`] | [`LabelledMesh`] |
//! | writes | a cluster for every sample ([`Clusters`]) | a label for every face ([`Labels`]) |
//! | range | clusters below the number of samples | labels below the number of faces |
//!
//! Where boundaries were given, a rectifier may ask for [`Evidence`] piece by piece instead ([`Rectifier::rectify_asking`]).
//!
//! **Name and settings.** The settings struct is [`StepSettings`]: its table of the configuration bears the
//! plugin's name, every key is documented and has a default in each profile, unknown keys are refused
//! (`#[serde(deny_unknown_fields)]`), and `schemars` makes the schema of it.
//!
//! **Determinism.** The same columns and settings give the same answer, on any number of threads: sums in a
//! fixed order, no clock, no address, no order of a hash map, a seed that is a setting.
//!
//! **Errors.** A plugin that cannot do its work on this mesh returns a [`StepError`] with a hint. An answer of
//! the wrong length or out of range is one too, made here and named. It ends the job, not the worker; in
//! the daemon so do a panic and a plugin that does not come back (`limits.job_timeout_s`).
//!
//! **Degenerate meshes.** There may be no samples at all (every vertex of a cube is sharp, where nothing is
//! enriched), all may be equal, and areas may be zero. Columns hold finite numbers only.
//!
//! `seamline plugins check NAME` puts a plugin to the test of all this ([`crate::contract`]).

mod choice;
mod classifier;
mod rectifier;
mod registry;

use serde::Serialize;

use crate::settings::StepSettings;
use crate::stage::{Stage, StepError};

pub use choice::{CommandSettings, PluginChoice};
pub use classifier::{Classifier, Clusters, CurvatureSamples, classifier_systems};
pub use rectifier::{
    Answered, EndFate, Evidence, EvidenceOnDemand, LabelledMesh, Labels, MakeEvidence, OpenEnd,
    OpenEnds, Rectifier, boundary, rectifier_systems,
};
pub use registry::{MakeSystems, OutsideSystems, PluginEntry, Registry};

/// A stage that plugins fill.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SwappableStage {
    /// Gives every sample a cluster: [`Classifier`].
    Classify,
    /// Gives every face its final patch: [`Rectifier`].
    Rectify,
}

impl SwappableStage {
    /// Both of them, in the order a mesh meets them.
    pub const ALL: [Self; 2] = [Self::Classify, Self::Rectify];

    /// Where it stands among all stages.
    pub fn stage(self) -> Stage {
        match self {
            Self::Classify => Stage::Classify,
            Self::Rectify => Stage::Rectify,
        }
    }

    /// The key of `[pipeline]` that names its plugin.
    pub fn key(self) -> &'static str {
        match self {
            Self::Classify => "classifier",
            Self::Rectify => "rectifier",
        }
    }
}

/// Is there one answer for each question, and each below the number of questions?
fn check_answers(
    who: &str,
    what: &str,
    of_what: &str,
    answers: impl ExactSizeIterator<Item = u32>,
    wanted: usize,
) -> Result<(), StepError> {
    let given = answers.len();
    if given != wanted {
        return Err(StepError::new(
            format!("the {who} gave {given} {what}s for {wanted} {of_what}s"),
            format!("one {what} for every {of_what}, in the same order"),
        ));
    }
    match answers
        .enumerate()
        .find(|&(_, answer)| answer as usize >= wanted)
    {
        None => Ok(()),
        Some((at, answer)) => Err(StepError::new(
            format!("the {who} gave {of_what} {at} the {what} {answer}"),
            format!("{what}s are below the number of {of_what}s, {wanted}"),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_of_the_wrong_number_or_out_of_range_are_named() {
        let check = |answers: &[u32]| {
            check_answers(
                "classifier",
                "cluster",
                "sample",
                answers.iter().copied(),
                3,
            )
            .map_err(|error| error.message)
        };
        assert_eq!(check(&[0, 2, 1]), Ok(()));
        assert_eq!(
            check(&[0, 2]).unwrap_err(),
            "the classifier gave 2 clusters for 3 samples"
        );
        assert_eq!(
            check(&[0, 3, 7]).unwrap_err(),
            "the classifier gave sample 1 the cluster 3"
        );
    }
}
