//! What comes of all models under some settings, and the rows of tables made of it.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use seamline_ecs::{Segmentation, Worker};
use seamline_tests::models::{Model, VARIANTS, models};
use seamline_tests::score::{Agreement, agreement};
use seamline_tests::{bench, pipeline};

use crate::score_py::ScorePy;

/// The models, and the rows there are already: tables have some in common.
pub struct Compared {
    pub models: Vec<Model>,
    score_py: ScorePy,
    rows: BTreeMap<String, Rc<Row>>,
}

impl Compared {
    /// `None`, and a word on standard error, where there is no bench. Labels are written to `folder`, if there is one.
    pub fn open(folder: Option<PathBuf>) -> Option<Self> {
        let path = bench("models")?;
        Some(Self {
            models: models(&path),
            score_py: ScorePy::new(path, folder),
            rows: BTreeMap::new(),
        })
    }

    /// All models under `settings`, scored.
    pub fn row(&mut self, settings: &[String]) -> Rc<Row> {
        let name = settings.join(";");
        if let Some(known) = self.rows.get(&name) {
            return Rc::clone(known);
        }
        let row = Rc::new(Row::of(&self.models, settings, |labels, found| {
            self.score_py.check(&name, &self.models, labels, found);
        }));
        self.rows.insert(name, Rc::clone(&row));
        row
    }

    /// Says on standard error how far the two scorers agreed.
    pub fn tell_scorers(&self) {
        self.score_py.tell();
    }
}

/// How well each model was cut under some settings.
pub struct Row {
    /// One a model.
    pub found: Vec<Agreement>,
    variants: Vec<usize>,
    /// Mean number over all models.
    patches: f64,
    seconds: [f64; 2],
}

impl Row {
    pub const HEAD: &str = "\
| | coarse | fine | uniform | all | patches | classify s | rectify s |
|---|---|---|---|---|---|---|---|";

    fn of(
        models: &[Model],
        settings: &[String],
        check: impl FnOnce(&[Vec<u32>], &[Agreement]),
    ) -> Self {
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let mut worker = Worker::new(pipeline(&settings));
        let mut row = Self {
            found: Vec::new(),
            variants: models.iter().map(|model| model.variant).collect(),
            patches: 0.0,
            seconds: [0.0; 2],
        };
        let mut labels = Vec::new();
        for model in models {
            let cut = worker.segment(Arc::clone(&model.mesh)).expect("it is cut");
            let found = agreement(&model.mesh, &model.truth, &cut.face_patches);
            row.found.push(found);
            row.patches += cut.patches.len() as f64 / models.len() as f64;
            for (sum, seconds) in row.seconds.iter_mut().zip(plugin_seconds(&cut)) {
                *sum += seconds;
            }
            labels.push(cut.face_patches);
        }
        check(&labels, &row.found);
        row
    }

    /// The mean over the models that `counts` by their place.
    pub fn mean(&self, counts: impl Fn(usize) -> bool) -> Agreement {
        let of: Vec<_> = (0..self.found.len()).filter(|&at| counts(at)).collect();
        let mean = |of_one: fn(&Agreement) -> f64| {
            of.iter().map(|&at| of_one(&self.found[at])).sum::<f64>() / of.len() as f64
        };
        Agreement {
            ari: mean(|a| a.ari),
            boundary_f1: mean(|a| a.boundary_f1),
            exact: mean(|a| a.exact),
        }
    }

    /// A line of the table.
    pub fn line(&self, name: &str) -> String {
        let of_variant =
            |variant: usize| cells(&self.mean(|model| self.variants[model] == variant));
        let means: Vec<_> = (0..VARIANTS.len())
            .map(of_variant)
            .chain([cells(&self.mean(|_| true))])
            .collect();
        let [classify, rectify] = self.seconds;
        let patches = self.patches;
        format!(
            "| {name} | {} | {patches:.1} | {classify:.2} | {rectify:.2} |",
            means.join(" | ")
        )
    }
}

/// By the clock, in the two stages that plugins fill.
pub fn plugin_seconds(cut: &Segmentation) -> [f64; 2] {
    ["classify", "rectify"].map(|name| {
        let record = cut.stages.iter().find(|record| record.stage.name() == name);
        record.expect("all stages are told").seconds
    })
}

/// ARI, boundary F1 and exact, without the zero before the point.
pub fn cells(mean: &Agreement) -> String {
    let cells = [mean.ari, mean.boundary_f1, mean.exact].map(|value| {
        let text = format!("{value:.3}");
        text.strip_prefix('0').unwrap_or(&text).to_owned()
    });
    cells.join(" ")
}
