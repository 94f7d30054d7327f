//! Compares plugins and settings on the bench of CAD meshes whose patches are known.
//!
//! `cargo run --release -p seamline-tests --example compare_plugins -- SETTINGS...`: one row of the table for each
//! argument, which is settings with `;` between them, as `pipeline.classifier=gmm;gmm.least_spread=0.2`.
//! Without arguments the tables of `plugins/COMPARISON.md`.

mod models;
mod tables;

use std::env;

use models::{Row, models};

fn main() {
    let Some(models) = models() else { return };
    let rows: Vec<String> = env::args().skip(1).collect();
    if rows.is_empty() {
        tables::print(&models);
        return;
    }
    println!("{}", Row::HEAD);
    for settings in rows {
        let split: Vec<&str> = settings.split(';').filter(|s| !s.is_empty()).collect();
        println!("{}", Row::of(&models, &settings, &split));
    }
}
