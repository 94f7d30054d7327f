//! How many patches are found for each true one, on parts with free forms: there a smooth patch is most easily cut up,
//! or taken together with its neighbour.

use seamline_tests::models::VARIANTS;

use crate::cut::Cut;
use crate::text::of;

pub fn print(cuts: &[Cut]) {
    println!(
        "\n### Patches found for each true one, parts with free forms\n\n\
        | meshes | median | least | greatest | from .9 to 1.1 |\n|---|---|---|---|---|"
    );
    for (variant, name) in VARIANTS.iter().enumerate() {
        let mut ratios: Vec<f64> = cuts
            .iter()
            .filter(|cut| cut.model.variant == variant && cut.truth.has_free_forms())
            .map(|cut| cut.surfaces.len() as f64 / cut.partners.len() as f64)
            .collect();
        ratios.sort_by(f64::total_cmp);
        let (Some(least), Some(greatest)) = (ratios.first(), ratios.last()) else {
            continue;
        };
        let near = ratios.iter().filter(|ratio| (0.9..=1.1).contains(*ratio));
        println!(
            "| {name} ({}) | {:.3} | {least:.3} | {greatest:.3} | {} |",
            ratios.len(),
            median(&ratios),
            of(near.count(), ratios.len())
        );
    }
}

/// Of sorted values, one at least.
fn median(sorted: &[f64]) -> f64 {
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 {
        sorted[middle]
    } else {
        (sorted[middle - 1] + sorted[middle]) / 2.0
    }
}
