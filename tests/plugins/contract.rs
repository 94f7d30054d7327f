//! The contract holds for all plugins there are, and what breaks it is told.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::DVec3;
use schemars::JsonSchema;
use seamline_ecs::components::{FaceLabel, SampleCluster};
use seamline_ecs::contract::{Trial, check};
use seamline_ecs::settings::{Profile, SettingsError, StepSettings};
use seamline_ecs::{
    BuiltinSteps, Classifier, Clusters, CurvatureSamples, InstallStep, LabelledMesh, Labels,
    PluginChoice, Rectifier, Registry, Stage, StepError, SwappableStage, fallible,
};
use seamline_mesh::shapes;
use seamline_segment::builtin_steps;
use seamline_tests::{count, run, seamline, segment};
use serde::{Deserialize, Serialize};
use toml::Table;

fn trials(registry: &Registry, stage: SwappableStage, name: &str) -> Vec<Trial> {
    let choice = PluginChoice::Named(name.to_owned());
    check(&builtin_steps(), registry, stage, &choice).expect("there is such a plugin")
}

/// All that a plugin breaks, each as `on what: what`.
fn broken(registry: &Registry, stage: SwappableStage, name: &str) -> Vec<String> {
    let trials = trials(registry, stage, name).into_iter();
    let told = |trial: Trial| {
        let of = trial.of;
        trial
            .breaks
            .into_iter()
            .map(move |what| format!("{of}: {what}"))
    };
    trials.flat_map(told).collect()
}

#[test]
fn every_registered_plugin_keeps_the_contract() {
    let registry = seamline_plugins::registry();
    for entry in registry.entries() {
        let broken = broken(&registry, entry.stage, entry.name);
        assert!(broken.is_empty(), "{}: {broken:#?}", entry.name);
    }
}

#[test]
fn one_shape_of_the_contract_has_no_samples() {
    let all = trials(
        &seamline_plugins::registry(),
        SwappableStage::Classify,
        "kmeans",
    );
    let without = all
        .iter()
        .find(|trial| trial.of.starts_with("a cube without samples"));
    assert!(without.is_some_and(|trial| trial.breaks.is_empty()));

    let cube = shapes::cuboid(DVec3::ONE).polygons();
    let settings = ["pipeline.profile=lavoue2005", "sharp.enrich=false"];
    let cut = segment(cube, &settings);
    assert_eq!(count(&cut, "curvature", "samples"), 0);
    assert_eq!(cut.patches.len(), 6);
}

/// The built-in steps with one more, in the stage of curvature, that fails.
fn fails_early(in_force: &Table) -> Result<InstallStep, SettingsError> {
    with_a_failure(in_force, Stage::Curvature)
}

/// As [`fails_early`], after all plugins.
fn fails_late(in_force: &Table) -> Result<InstallStep, SettingsError> {
    with_a_failure(in_force, Stage::Export)
}

fn with_a_failure(in_force: &Table, stage: Stage) -> Result<InstallStep, SettingsError> {
    let steps = (builtin_steps().install)(in_force)?;
    let fail = || Err(StepError::new("it rains", "wait"));
    Ok(Arc::new(
        move |world: &mut World, schedule: &mut Schedule| {
            steps(world, schedule);
            schedule.add_systems(fallible(fail).in_set(stage));
        },
    ))
}

#[test]
fn a_failure_of_another_stage_is_told_as_one_before_or_after_the_plugin() {
    type Install = fn(&Table) -> Result<InstallStep, SettingsError>;
    for (install, said) in [
        (
            fails_early as Install,
            "was not asked, because an earlier stage fails: curvature: it rains",
        ),
        (
            fails_late as Install,
            "its answer makes a later stage fail: export: it rains",
        ),
    ] {
        let steps = BuiltinSteps {
            install,
            ..builtin_steps()
        };
        for (stage, name) in [
            (SwappableStage::Classify, "kmeans"),
            (SwappableStage::Rectify, "graph-cut"),
        ] {
            let choice = PluginChoice::Named(name.to_owned());
            let trials = check(&steps, &seamline_plugins::registry(), stage, &choice).unwrap();
            let of_meshes = &trials[1..];
            assert!(!of_meshes.is_empty());
            for trial in of_meshes {
                assert_eq!(trial.breaks, [said], "{name}: {}", trial.of);
            }
        }
    }
}

#[test]
fn no_rectifier_at_all_keeps_the_contract_of_the_pipeline() {
    let given = "[pipeline]\nrectifier = 'none'".parse().unwrap();
    let registry = seamline_plugins::registry();
    assert!(seamline_ecs::Pipeline::assemble(&builtin_steps(), &registry, &given).is_ok());
}

macro_rules! settings {
    ($name:ident, $table:literal) => {
        /// Settings without keys.
        #[derive(Clone, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        struct $name {}

        impl StepSettings for $name {
            const TABLE: &'static str = $table;
            fn defaults(_: Profile) -> Self {
                Self {}
            }
        }
    };
}

settings!(Short, "short");
settings!(Wild, "wild");
settings!(Moody, "moody");
settings!(Panicky, "panicky");
settings!(Far, "far");

/// Clusters of all samples, made by `of`.
fn clusters(
    samples: &CurvatureSamples<'_>,
    of: impl Fn(usize) -> u32,
) -> Result<Clusters, StepError> {
    Ok(Clusters {
        of_sample: (0..samples.samples.len())
            .map(|i| SampleCluster(of(i)))
            .collect(),
        ..Clusters::default()
    })
}

impl Classifier for Short {
    const SUMMARY: &'static str = "forgets the last sample";
    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        let mut answer = clusters(samples, |_| 0)?;
        answer.of_sample.pop();
        Ok(answer)
    }
}

impl Classifier for Wild {
    const SUMMARY: &'static str = "counts from 1";
    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        clusters(samples, |i| i as u32 + 1)
    }
}

impl Classifier for Moody {
    const SUMMARY: &'static str = "counts how often it is asked\nand goes by that";
    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        use std::sync::atomic::{AtomicUsize, Ordering};
        static ASKED: AtomicUsize = AtomicUsize::new(0);
        let turn = ASKED.fetch_add(1, Ordering::Relaxed);
        clusters(samples, |i| (i + turn).is_multiple_of(2).into())
    }
}

impl Classifier for Panicky {
    const SUMMARY: &'static str = "wants a second sample";
    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        let second = samples.samples[1].vertex;
        clusters(samples, |_| u32::from(second == 77))
    }
}

impl Rectifier for Far {
    const SUMMARY: &'static str = "labels beyond all faces";
    fn rectify(&self, mesh: &LabelledMesh<'_>) -> Result<Labels, StepError> {
        let beyond = FaceLabel(mesh.labels.len() as u32);
        Ok(Labels {
            of_face: vec![beyond; mesh.labels.len()],
            ..Labels::default()
        })
    }
}

#[test]
fn whatever_breaks_the_contract_is_told() {
    let registry = Registry::default()
        .with_classifier::<seamline_kmeans::KMeansSettings>()
        .with_classifier::<Short>()
        .with_classifier::<Wild>()
        .with_classifier::<Moody>()
        .with_classifier::<Panicky>()
        .with_rectifier::<Far>();
    let classify = SwappableStage::Classify;
    for (stage, name, what) in [
        (classify, "short", "gave 0 clusters for 1 samples"),
        (classify, "wild", "the cluster 1"),
        (classify, "moody", "gives another answer"),
        (classify, "moody", "is not told in one line"),
        (classify, "panicky", "panics: index out of bounds"),
        (SwappableStage::Rectify, "far", "gave face 0 the label 1"),
    ] {
        let broken = broken(&registry, stage, name);
        assert!(
            broken.iter().any(|line| line.contains(what)),
            "{name}: {broken:#?}"
        );
    }
}

#[test]
fn the_command_says_what_a_plugin_keeps_and_what_a_stranger_breaks() {
    let check = |line: &[&str]| run(seamline().args(["plugins", "check"]).args(line));
    let kept = check(&["graph-cut"]).ended(0);
    assert!(kept.out.ends_with("keeps the contract\n"), "{}", kept.out);
    let stranger = env!("CARGO_BIN_EXE_fickle_plugin");
    let kept = check(&[stranger, "good"]).ended(0);
    assert!(kept.out.ends_with("keeps the contract\n"), "{}", kept.out);
    let kept = check(&["--stage", "rectify", stranger, "all"]).ended(0);
    assert!(kept.out.ends_with("keeps the contract\n"), "{}", kept.out);
    let broken = check(&[stranger, "forgetful"]).ended(1);
    assert!(
        broken.out.contains("gives another answer"),
        "{}",
        broken.out
    );
    let broken = check(&[stranger, "short"]).ended(1);
    assert!(broken.out.contains("clusters for"), "{}", broken.out);
    let unknown = check(&["kmean"]).ended(2);
    assert!(
        unknown.err.contains("did you mean `kmeans`?"),
        "{}",
        unknown.err
    );
    let unknown = check(&["--stage", "grow", "./x"]).ended(2);
    assert!(
        unknown.err.contains("classify or rectify"),
        "{}",
        unknown.err
    );
}
