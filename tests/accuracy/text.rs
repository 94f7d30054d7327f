//! Numbers as cells of a table.

use seamline_tests::score::Agreement;

/// Four digits, without the zero before the point.
pub fn digits(value: f64) -> String {
    let text = format!("{value:.4}");
    text.strip_prefix('0').unwrap_or(&text).to_owned()
}

/// `12 / 13`.
pub fn of(some: usize, all: usize) -> String {
    format!("{some} / {all}")
}

/// ARI, boundary F1 and exact: the means, one cell each.
pub fn means(of: &[Agreement]) -> String {
    let values: [fn(&Agreement) -> f64; 3] = [|a| a.ari, |a| a.boundary_f1, |a| a.exact];
    values
        .map(|value| digits(mean(of.iter().map(value)).unwrap_or(f64::NAN)))
        .join(" | ")
}

/// `None` if there are none.
pub fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let values: Vec<f64> = values.collect();
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}
