//! The contract of plugins as a test: any plugin, a stranger's included, on shapes known in closed form.
//!
//! Each shape passes a whole pipeline in which the plugin fills its stage, in both profiles, and one of them so that
//! there is no sample at all. A plugin keeps the contract if it gives an answer to all of them, in length and in
//! range; the same answer when asked again, on one thread and on four, first and after other meshes; and if its
//! settings say what they are.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;
use seamline_mesh::{Format, Mesh, PolygonMesh, shapes, weld};
use serde_json::Value as Json;
use toml::{Table, Value};

use crate::components::SampleCluster;
use crate::pipeline::{BuiltinSteps, Pipeline};
use crate::plugin::{PluginChoice, PluginEntry, Registry, SwappableStage};
use crate::rows::column_mut;
use crate::settings::{Profile, SettingsError};
use crate::worker::Worker;

/// What came of one part of the test.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// What was tried: `a cylinder, cad`.
    pub of: String,
    /// What the plugin breaks; nothing if it keeps the contract.
    pub breaks: Vec<String>,
    /// The longest it took, by the clock.
    pub took: Duration,
}

/// Puts a plugin to the test.
///
/// # Errors
///
/// A plugin there is not, or a command that no program can be.
pub fn check(
    builtin: &BuiltinSteps,
    registry: &Registry,
    stage: SwappableStage,
    choice: &PluginChoice,
) -> Result<Vec<Trial>, SettingsError> {
    let mut trials = Vec::new();
    if let PluginChoice::Named(name) = choice {
        let entry = registry.find(stage, name)?;
        trials.push(Trial {
            of: "what it says of itself".to_owned(),
            breaks: description(entry),
            took: Duration::ZERO,
        });
    }
    for way in WAYS {
        let assemble = |threads| {
            let given = way.given(stage, choice, threads);
            Pipeline::assemble(builtin, registry, &given).map(Arc::new)
        };
        let mut trial = MeshTrial {
            stage,
            on_one_thread: assemble(1)?,
            kept: Worker::new(assemble(4)?),
            on_four_threads: assemble(4)?,
        };
        for (shape, mesh) in (way.meshes)() {
            let begun = Instant::now();
            let breaks = trial.breaks(&Arc::new(mesh));
            trials.push(Trial {
                of: format!("{shape}, {}", way.name),
                breaks,
                took: begun.elapsed() / 3,
            });
        }
    }
    Ok(trials)
}

/// A pipeline, and the meshes that pass it.
struct Way {
    name: &'static str,
    profile: Profile,
    /// Settings of the built-in steps, as in a configuration.
    steps: &'static str,
    meshes: fn() -> Vec<(&'static str, Mesh)>,
}

/// Surfaces are not looked for: where they explain a mesh no plugin has anything to say.
const WAYS: [Way; 3] = [
    Way {
        name: "cad",
        profile: Profile::Cad,
        steps: "surfaces.enabled = false",
        meshes,
    },
    Way {
        name: "lavoue2005",
        profile: Profile::Lavoue2005,
        steps: "surfaces.enabled = false",
        meshes,
    },
    Way {
        name: "lavoue2005 without enrichment",
        profile: Profile::Lavoue2005,
        steps: "surfaces.enabled = false\nsharp.enrich = false",
        meshes: meshes_without_samples,
    },
];

impl Way {
    fn given(&self, stage: SwappableStage, choice: &PluginChoice, threads: i64) -> Table {
        let value = |what: Result<Value, toml::ser::Error>| what.expect("plain values");
        let mut pipeline = Table::from_iter([
            ("profile".to_owned(), value(Value::try_from(self.profile))),
            ("threads".to_owned(), Value::Integer(threads)),
            (stage.key().to_owned(), value(Value::try_from(choice))),
        ]);
        if stage == SwappableStage::Classify {
            // No other plugin is to be tested with it.
            let none = Value::String("none".to_owned());
            pipeline.insert(SwappableStage::Rectify.key().to_owned(), none);
        }
        let mut given: Table = self.steps.parse().expect("settings as they are written");
        given.insert("pipeline".to_owned(), Value::Table(pipeline));
        given
    }
}

struct MeshTrial {
    stage: SwappableStage,
    on_one_thread: Arc<Pipeline>,
    on_four_threads: Arc<Pipeline>,
    /// The worker that has seen all meshes before.
    kept: Worker,
}

impl MeshTrial {
    fn breaks(&mut self, mesh: &Arc<Mesh>) -> Vec<String> {
        let fresh = self.answer(&mut Worker::new(Arc::clone(&self.on_one_thread)), mesh);
        let first = match fresh {
            Ok(patches) => patches,
            Err(broken) => {
                // The worker that is kept goes on with the next mesh, and is none the worse for it.
                return vec![broken];
            }
        };
        let mut kept = std::mem::replace(
            &mut self.kept,
            Worker::new(Arc::clone(&self.on_four_threads)),
        );
        let mut breaks = Vec::new();
        for circumstance in [
            "on four threads and after other meshes",
            "when asked a second time",
        ] {
            match self.answer(&mut kept, mesh) {
                Ok(again) if again == first => {}
                Ok(_) => breaks.push(format!("gives another answer {circumstance}")),
                Err(broken) => breaks.push(format!("{broken}, {circumstance}")),
            }
        }
        if breaks.is_empty() {
            self.kept = kept;
        }
        breaks
    }

    /// What the plugin answered: clusters, as they still stand in their column, or patches.
    fn answer(&self, worker: &mut Worker, mesh: &Arc<Mesh>) -> Result<Vec<u32>, String> {
        let ran = catch_unwind(AssertUnwindSafe(|| worker.segment(Arc::clone(mesh))));
        match ran {
            Ok(Ok(cut)) => Ok(match self.stage {
                SwappableStage::Classify => {
                    let clusters = column_mut::<SampleCluster>(worker.world_mut());
                    clusters.iter().map(|cluster| cluster.0).collect()
                }
                SwappableStage::Rectify => cut.face_patches,
            }),
            Ok(Err(error)) if error.stage == self.stage.stage() => {
                Err(format!("fails: {}; {}", error.message, error.hint))
            }
            Ok(Err(error)) if error.stage > self.stage.stage() => {
                Err(format!("its answer makes a later stage fail: {error}"))
            }
            Ok(Err(error)) => Err(format!(
                "was not asked, because an earlier stage fails: {error}"
            )),
            Err(panicked) => {
                let text = panicked
                    .downcast_ref::<String>()
                    .map(String::as_str)
                    .or_else(|| panicked.downcast_ref::<&str>().copied());
                Err(format!("panics: {}", text.unwrap_or("without a word")))
            }
        }
    }
}

/// What is wrong with what a plugin says of itself.
fn description(entry: &PluginEntry) -> Vec<String> {
    let mut breaks = Vec::new();
    let mut unless = |holds: bool, what: String| {
        if !holds {
            breaks.push(what);
        }
    };
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    unless(
        !entry.name.is_empty() && entry.name.chars().all(is_plain),
        format!(
            "its name `{}` is not of small letters, digits and dashes",
            entry.name
        ),
    );
    unless(
        !entry.summary.is_empty() && !entry.summary.contains('\n'),
        "what it does is not told in one line".to_owned(),
    );
    let schema = (entry.settings.schema)().to_value();
    unless(
        schema["additionalProperties"] == Json::Bool(false),
        "unknown keys are not refused: `#[serde(deny_unknown_fields)]`".to_owned(),
    );
    let defaults =
        [Profile::Cad, Profile::Lavoue2005].map(|profile| (entry.settings.defaults)(profile));
    for key in defaults[0].keys() {
        let told = schema["properties"][key]["description"].as_str();
        unless(
            told.is_some_and(|told| !told.is_empty()),
            format!("`{}.{key}` is not documented", entry.name),
        );
        unless(
            defaults[1].contains_key(key),
            format!("`{}.{key}` has no default in lavoue2005", entry.name),
        );
    }
    for (defaults, profile) in defaults.into_iter().zip(["cad", "lavoue2005"]) {
        let in_force = Table::from_iter([(entry.name.to_owned(), Value::Table(defaults))]);
        if let Err(error) = (entry.systems)(&in_force) {
            unless(
                false,
                format!("its defaults in {profile} are refused: {error}"),
            );
        }
    }
    breaks
}

/// Every vertex is sharp, and only enrichment would put others between them.
fn meshes_without_samples() -> Vec<(&'static str, Mesh)> {
    let cube = shapes::cuboid(DVec3::ONE);
    vec![("a cube without samples", weld(cube.polygons(), 0.0))]
}

/// Shapes that hold what a plugin may meet: a single sample, samples that are all equal, flat and round
/// ones, thousands of them, borders, loose parts, edges of three faces.
fn meshes() -> Vec<(&'static str, Mesh)> {
    let solid = |shape: shapes::Shape| weld(shape.polygons(), 0.0);
    let cube = || shapes::cuboid(DVec3::ONE);
    let beside = |x: f64| cube().map(|p| p + DVec3::new(x, 0.0, 0.0));
    let fins = [DVec3::X, DVec3::Y, DVec3::new(-1.0, -1.0, 0.0)];
    let three_fins = PolygonMesh::from_triangles(
        Format::Memory,
        [&[DVec3::ZERO, DVec3::Z][..], &fins].concat(),
        &[[0, 1, 2], [0, 1, 3], [0, 1, 4]],
    );
    let one = [DVec3::ZERO, DVec3::X, DVec3::Y];
    vec![
        (
            "one triangle",
            weld(
                PolygonMesh::from_triangles(Format::Memory, one.to_vec(), &[[0, 1, 2]]),
                0.0,
            ),
        ),
        ("a cube", solid(cube())),
        ("a smooth cube", solid(shapes::smooth_cube(0.2, 4, 6))),
        ("a sphere", solid(shapes::icosphere(3))),
        ("a cone", solid(shapes::cone(1.0, 2.0, 32))),
        (
            "a torus of 20,000 triangles",
            solid(shapes::torus(2.0, 0.5, 200, 50)),
        ),
        ("a bracket", solid(shapes::bracket(5))),
        ("a shaft", solid(shapes::shaft(24, 4))),
        ("two loose cubes", solid(cube().and(&beside(3.0)))),
        ("three fins on one edge", weld(three_fins, 0.0)),
        (
            "a small cube after large meshes",
            solid(cube().map(|p| p * 1e-3)),
        ),
    ]
}
