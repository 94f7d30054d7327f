//! The bench's own scorer, to which every row is put as well.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use seamline_tests::models::Model;
use seamline_tests::run;
use seamline_tests::score::Agreement;
use serde_json::Value;
use tempfile::TempDir;

/// Both add up the same areas and lengths, in another order.
const ROUNDING: f64 = 1e-6;

pub struct ScorePy {
    /// Models and their truth; the scorer lies beside the folder.
    models: PathBuf,
    keep: Option<PathBuf>,
    works: bool,
    rows: Cell<usize>,
    greatest: Cell<f64>,
}

impl ScorePy {
    /// A scorer for the models of a folder. `keep`: where labels are left.
    pub fn new(models: PathBuf, keep: Option<PathBuf>) -> Self {
        let mut asked = Command::new("python3");
        asked
            .args(["-c", "import numpy"])
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        let works = asked.status().is_ok_and(|status| status.success());
        if !works {
            eprintln!("SKIPPED: no python3 with numpy, so that score.py is not asked");
        }
        Self {
            models,
            keep,
            works,
            rows: Cell::new(0),
            greatest: Cell::new(0.0),
        }
    }

    /// Writes the labels of a row down and has them scored.
    ///
    /// # Panics
    ///
    /// Where the scorer finds something else than `found`, one a model.
    pub fn check(&self, row: &str, models: &[Model], labels: &[Vec<u32>], found: &[Agreement]) {
        let passing = TempDir::new().expect("a folder for labels");
        let folder = self
            .keep
            .as_ref()
            .map_or_else(|| passing.path().to_owned(), |keep| keep.join(plain(row)));
        write(&folder, models, labels);
        if !self.works {
            return;
        }
        let scores = self.scores(&folder);
        for (model, ours) in models.iter().zip(found) {
            let name = &model.name;
            for (measure, ours) in [
                ("ari", ours.ari),
                ("bnd_f1", ours.boundary_f1),
                ("exact", ours.exact),
            ] {
                let theirs = scores["models"][name][measure]
                    .as_f64()
                    .unwrap_or_else(|| panic!("score.py gave {name} no {measure}"));
                let apart = (theirs - ours).abs();
                assert!(
                    apart < ROUNDING,
                    "{row}: {name}: {measure} is {ours} here and {theirs} by score.py"
                );
                self.greatest.set(self.greatest.get().max(apart));
            }
        }
        self.rows.set(self.rows.get() + 1);
    }

    fn scores(&self, folder: &Path) -> Value {
        let scorer = self.models.with_file_name("score.py");
        let mut score = Command::new("python3");
        score.arg(scorer).arg("--json").arg("--truth");
        score.arg(&self.models).arg("--pred").arg(folder);
        run(&mut score).json()
    }

    /// Says on standard error what was compared.
    pub fn tell(&self) {
        let (rows, greatest) = (self.rows.get(), self.greatest.get());
        eprintln!("{rows} rows scored by score.py as well: {greatest:.0e} apart at most");
    }
}

fn write(folder: &Path, models: &[Model], labels: &[Vec<u32>]) {
    fs::create_dir_all(folder).expect("the folder can be made");
    for (model, labels) in models.iter().zip(labels) {
        let lines: String = labels.iter().map(|label| format!("{label}\n")).collect();
        let file = folder.join(&model.name).with_extension("seg");
        fs::write(file, lines).expect("labels can be written");
    }
}

/// The settings of a row as the name of a folder.
fn plain(row: &str) -> String {
    let row = if row.is_empty() { "defaults" } else { row };
    row.chars()
        .map(|c| match c {
            'a'..='z' | '0'..='9' | '.' | '-' | '_' | '=' => c,
            _ => ' ',
        })
        .collect()
}
