//! Are defaults good for the parts they were chosen on only? Each plugin's setting is chosen on half of the parts and
//! scored on the other half, beside the default.

use seamline_tests::score::Agreement;

use crate::row::{Compared, cells};

/// The default, and what else could have been chosen, each as settings.
pub struct Choice {
    /// May the default itself be chosen? If not, it is held against the best of the others.
    pub default_takes_part: bool,
    pub of: String,
    pub default: Vec<String>,
    pub others: Vec<(String, Vec<String>)>,
}

/// What settings are chosen by: the mean of the three measures.
fn worth(mean: &Agreement) -> f64 {
    (mean.ari + mean.boundary_f1 + mean.exact) / 3.0
}

/// Prints one line for each choice and half.
pub fn print(compared: &mut Compared, choices: &[Choice]) {
    println!("| | chosen on one half | it on the other | the default there |\n|---|---|---|---|");
    let mut parts: Vec<String> = compared
        .models
        .iter()
        .map(|model| model.part().to_owned())
        .collect();
    parts.dedup();
    let half_of = |part: &str| parts.iter().position(|known| known == part).expect("known") % 2;
    let half: Vec<usize> = compared
        .models
        .iter()
        .map(|model| half_of(model.part()))
        .collect();
    for choice in choices {
        let default = compared.row(&choice.default);
        let others: Vec<_> = choice
            .others
            .iter()
            .map(|(name, settings)| (name.as_str(), compared.row(settings)))
            .collect();
        for chosen_on in [0, 1] {
            let here = |model: usize| half[model] == chosen_on;
            // Of equals the first, so that the default stays where it is one of them.
            let mut best = if choice.default_takes_part {
                ("the default", &default)
            } else {
                (others[0].0, &others[0].1)
            };
            for (name, row) in &others {
                if worth(&row.mean(here)) > worth(&best.1.mean(here)) {
                    best = (name, row);
                }
            }
            let there = |model: usize| half[model] != chosen_on;
            println!(
                "| {} | {} | {} | {} |",
                choice.of,
                best.0,
                cells(&best.1.mean(there)),
                cells(&default.mean(there))
            );
        }
    }
}
