//! The models with their truth, and a row of means over them.

use std::fmt;
use std::fs;
use std::sync::Arc;

use seamline_ecs::Worker;
use seamline_mesh::{Mesh, read, weld};
use seamline_tests::score::{Agreement, agreement};
use seamline_tests::{bench, pipeline};

/// The tessellations there are, and what stands for each in the name of a file.
const VARIANTS: [&str; 3] = ["coarse", "fine", "uniform"];

pub struct Model {
    variant: usize,
    mesh: Arc<Mesh>,
    truth: Vec<u32>,
}

/// All models of the bench; `None`, and a word on standard error, where it is absent.
pub fn models() -> Option<Vec<Model>> {
    let folder = bench("models")?;
    let mut paths: Vec<_> = fs::read_dir(folder)
        .expect("the folder can be listed")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|end| end == "stl"))
        .collect();
    paths.sort();
    let load = |path: &std::path::PathBuf| {
        let name = path
            .file_stem()
            .and_then(|name| name.to_str())
            .unwrap_or_default();
        let variant = VARIANTS
            .iter()
            .position(|variant| name.ends_with(variant))?;
        let labels = fs::read_to_string(path.with_extension("seg")).expect("its truth");
        Some(Model {
            variant,
            mesh: Arc::new(weld(read(path).expect("the model reads"), 0.0)),
            truth: labels
                .lines()
                .map(|line| line.parse().expect("a label"))
                .collect(),
        })
    };
    Some(paths.iter().filter_map(load).collect())
}

/// Means over the models of each tessellation, under some settings.
pub struct Row {
    name: String,
    means: [Agreement; 3],
    /// Of all models, in patches.
    patches: f64,
    /// In the two stages of plugins, for all models.
    seconds: [f64; 2],
}

impl Row {
    pub const HEAD: &str = "\
| | coarse | fine | uniform | patches | classify s | rectify s |
|---|---|---|---|---|---|---|";

    pub fn of(models: &[Model], name: &str, settings: &[&str]) -> Self {
        let mut row = Self {
            name: name.to_owned(),
            means: [Agreement::default(); 3],
            patches: 0.0,
            seconds: [0.0; 2],
        };
        let mut worker = Worker::new(pipeline(settings));
        for model in models {
            let cut = worker.segment(Arc::clone(&model.mesh)).expect("it is cut");
            let found = agreement(&model.mesh, &model.truth, &cut.face_patches);
            let alike = models
                .iter()
                .filter(|other| other.variant == model.variant)
                .count() as f64;
            let mean = &mut row.means[model.variant];
            mean.ari += found.ari / alike;
            mean.boundary_f1 += found.boundary_f1 / alike;
            mean.exact += found.exact / alike;
            row.patches += cut.patches.len() as f64 / models.len() as f64;
            for (sum, stage) in row.seconds.iter_mut().zip(["classify", "rectify"]) {
                let record = cut
                    .stages
                    .iter()
                    .find(|record| record.stage.name() == stage);
                *sum += record.map_or(0.0, |record| record.seconds);
            }
        }
        row
    }
}

/// ARI, boundary F1 and exact of each tessellation, without the zero before the point.
impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "| {} |", self.name)?;
        for mean in &self.means {
            let cells = [mean.ari, mean.boundary_f1, mean.exact].map(|value| {
                let text = format!("{value:.3}");
                text.strip_prefix('0').unwrap_or(&text).to_owned()
            });
            write!(f, " {} |", cells.join(" "))?;
        }
        let [classify, rectify] = self.seconds;
        write!(f, " {:.1} | {classify:.2} | {rectify:.2} |", self.patches)
    }
}
