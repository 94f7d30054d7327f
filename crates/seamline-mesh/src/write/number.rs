//! Numbers as text.

use std::fmt;

/// The fewest digits that read back as the same number, with an exponent where zeros would pile up.
pub(super) struct Shortest(pub(super) f64);

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 {
            f.write_str("0")
        } else if (1e-5..1e16).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn texts_are_short() {
        let texts = [0.1, -0.0, 1.0, 1e-12, 2.5e300].map(|x| Shortest(x).to_string());
        assert_eq!(texts, ["0.1", "0", "1", "1e-12", "2.5e300"]);
    }

    proptest! {
        #[test]
        fn every_number_reads_back(x in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
            prop_assert_eq!(Shortest(x).to_string().parse::<f64>().unwrap(), x);
        }
    }
}
