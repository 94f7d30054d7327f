//! Patches found exactly, by the type of their surface.

use crate::cut::Cut;
use crate::text::{digits, of};

const TYPES: [&str; 7] = [
    "plane", "cylinder", "cone", "sphere", "torus", "bspline", "other",
];

pub fn print(cuts: &[Cut]) {
    println!(
        "\n### Patches found exactly, by surface\n\n\
        | surface | found / true | share |\n|---|---|---|"
    );
    for kind in TYPES {
        row(kind, cuts, |other| other == kind);
    }
    row("all", cuts, |_| true);
}

fn row(name: &str, cuts: &[Cut], counts: impl Fn(&str) -> bool) {
    let exact: Vec<bool> = cuts
        .iter()
        .flat_map(|cut| {
            let patches = cut.truth.patches.iter();
            patches
                .filter(|patch| counts(&patch.kind))
                .map(|patch| cut.partners[&patch.label].exact)
        })
        .collect();
    let found = exact.iter().filter(|&&exact| exact).count();
    if !exact.is_empty() {
        let share = digits(found as f64 / exact.len() as f64);
        println!("| {name} | {} | {share} |", of(found, exact.len()));
    }
}
