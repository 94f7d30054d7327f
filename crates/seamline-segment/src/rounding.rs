//! Ties that are ties.

/// A number that is not negative, to about eight digits.
///
/// On symmetric parts many lengths and distances are equal but for their last bits. Compared like this
/// they are equal, and the lower number decides and not rounding: moving or scaling a part leaves its
/// partition as it is.
pub(crate) fn to_eight_digits(value: f64) -> f64 {
    const DROPPED_BITS: u32 = 24;
    let half = 1u64 << (DROPPED_BITS - 1);
    f64::from_bits((value.to_bits() + half) >> DROPPED_BITS << DROPPED_BITS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_in_the_last_bits_is_equal_and_what_differs_in_the_eighth_digit_is_not() {
        assert_eq!(to_eight_digits(0.1 + 0.2), to_eight_digits(0.3));
        assert_ne!(to_eight_digits(1.0000001), to_eight_digits(1.0));
        assert_eq!(to_eight_digits(0.0), 0.0);
        assert!((to_eight_digits(12345.678) - 12345.678).abs() < 1e-4);
    }
}
