//! How well patches agree with the truth, by tessellation and by what the parts are made of.

use seamline_tests::models::VARIANTS;

use crate::cut::Cut;
use crate::text::{digits, mean, means, of};

pub fn print(cuts: &[Cut]) {
    println!(
        "\n### Patches\n\n\
        | meshes | ARI | F1 | exact | tangent | patches found / true |\n|---|---|---|---|---|---|"
    );
    for (variant, name) in VARIANTS.iter().enumerate() {
        row(name, cuts, |cut| cut.model.variant == variant);
    }
    row("parts with free forms", cuts, |cut| {
        cut.truth.has_free_forms()
    });
    row(
        "parts of planes, cylinders, cones, spheres and tori",
        cuts,
        |cut| !cut.truth.has_free_forms(),
    );
    row("all", cuts, |_| true);
}

/// Where nothing counts there is no row.
fn row(name: &str, cuts: &[Cut], counts: impl Fn(&Cut) -> bool) {
    let cuts: Vec<_> = cuts.iter().filter(|cut| counts(cut)).collect();
    if cuts.is_empty() {
        return;
    }
    let agreements: Vec<_> = cuts.iter().map(|cut| cut.agreement).collect();
    let tangent = mean(cuts.iter().filter_map(|cut| cut.tangent_recall));
    let found = cuts.iter().map(|cut| cut.surfaces.len()).sum();
    let there = cuts.iter().map(|cut| cut.partners.len()).sum();
    println!(
        "| {name} ({}) | {} | {} | {} |",
        cuts.len(),
        means(&agreements),
        tangent.map_or("-".to_owned(), digits),
        of(found, there)
    );
}
