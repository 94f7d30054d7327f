//! Compares plugins and settings on the bench of CAD meshes whose patches are known.
//!
//! `cargo run --release -p seamline-tests --example compare_plugins -- [--write FOLDER] [SETTINGS...]`: one row of the
//! table for each of the settings, which have `;` between them, as `pipeline.classifier=gmm;gmm.least_spread=0.2`.
//! Without any, all tables of `plugins/COMPARISON.md`. With `--write` the labels of each row stay in a folder of
//! their own, `FOLDER/ROW/MODEL.seg`, for the bench's scorer or any other.
//!
//! Every row is scored twice, here and by the bench's own scorer (`score.py`; needs python3 with numpy): where the
//! two differ, this ends with what differs.

mod leave_out;
mod row;
mod score_py;
mod tables;

use std::env;
use std::path::PathBuf;

use row::{Compared, Row};

fn main() {
    let mut rows: Vec<String> = env::args().skip(1).collect();
    let mut write = None;
    if rows.first().is_some_and(|first| first == "--write") {
        assert!(rows.len() > 1, "--write wants a folder");
        write = Some(PathBuf::from(rows.remove(1)));
        rows.remove(0);
    }
    let Some(mut compared) = Compared::open(write) else {
        return;
    };
    if rows.is_empty() {
        tables::print(&mut compared);
    } else {
        println!("{}", Row::HEAD);
        for settings in rows {
            let split: Vec<String> = settings
                .split(';')
                .filter(|setting| !setting.is_empty())
                .map(str::to_owned)
                .collect();
            println!("{}", compared.row(&split).line(&settings));
        }
    }
    compared.tell_scorers();
}
