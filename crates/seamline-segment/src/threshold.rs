//! The threshold of merging, given or found (paper 6: "the automation of the merging threshold").

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, Visitor};
use serde::ser::Serializer;
use serde::{Deserialize, Serialize};

use crate::merge::RegionDistance;

/// Where merging stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// At this distance.
    Fixed(f64),
    /// In the widest gap between the distances at which the part's own regions merge ([`widest_gap`]).
    Auto,
}

const AUTO: &str = "auto";

impl Threshold {
    /// Is it a distance that can be?
    pub(crate) fn is_right(self) -> bool {
        match self {
            Self::Fixed(distance) => distance >= 0.0,
            Self::Auto => true,
        }
    }
}

/// The range in which the gap is looked for, and what is usual: the best fixed thresholds of the bench.
fn range(distance: RegionDistance) -> [f64; 3] {
    match distance {
        RegionDistance::Relative => [0.4, 0.65, 1.0],
        RegionDistance::Boundary => [1.0, 5.0, 50.0],
    }
}

/// How far from the usual a gap may be if it is to count e times less, in widths of the range, by ratio; twice as far,
/// it counts e^4 times less.
const FARTHER: f64 = 0.11;

/// The threshold in the middle of the widest gap between the distances at which regions merge, by ratio; a gap
/// counts the less the farther it is from the usual threshold, as a Gaussian falls off.
///
/// `merged_at` is in the order of the merges. What counts is the greatest distance so far: a threshold below it
/// would have stopped before. Where nothing merges in the whole range, that is the gap.
///
/// Measured on the bench (`plugins/COMPARISON.md`): by the mean of ARI, boundary F1 and exact over all meshes .001 above
/// the best fixed threshold for relative distances. Any usual one from .64 to .66 does as well. An exponential in
/// place of the Gaussian leaves the far gaps too much weight and gives what the default gives; gaps alone, however far,
/// lose .003 to .005 of ARI on coarse meshes: between .4 and 1 a part of many fillets has its widest gap anywhere.
pub fn widest_gap(merged_at: &[f64], distance: RegionDistance) -> f64 {
    let [low, usual, high] = range(distance);
    let mut best = (0.0, usual);
    let mut at = low;
    for &next in merged_at.iter().chain([&f64::INFINITY]) {
        if next <= at {
            continue;
        }
        let end = next.min(high);
        let middle = (at * end).sqrt();
        let farther = (middle / usual).ln() / (FARTHER * (high / low).ln());
        let counts = (end / at).ln() * (-farther * farther).exp();
        if counts > best.0 {
            best = (counts, middle);
        }
        if next >= high {
            break;
        }
        at = next;
    }
    best.1
}

impl Serialize for Threshold {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Fixed(distance) => distance.serialize(serializer),
            Self::Auto => AUTO.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Threshold {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrAuto;

        impl Visitor<'_> for NumberOrAuto {
            type Value = Threshold;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a distance of 0 or more, or \"auto\"")
            }

            fn visit_f64<E>(self, distance: f64) -> Result<Threshold, E> {
                Ok(Threshold::Fixed(distance))
            }

            fn visit_i64<E>(self, distance: i64) -> Result<Threshold, E> {
                Ok(Threshold::Fixed(distance as f64))
            }

            fn visit_u64<E>(self, distance: u64) -> Result<Threshold, E> {
                Ok(Threshold::Fixed(distance as f64))
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<Threshold, E> {
                match word {
                    AUTO => Ok(Threshold::Auto),
                    _ => Err(E::invalid_value(serde::de::Unexpected::Str(word), &self)),
                }
            }
        }

        deserializer.deserialize_any(NumberOrAuto)
    }
}

impl JsonSchema for Threshold {
    fn schema_name() -> Cow<'static, str> {
        "Threshold".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "number" }, { "const": AUTO }] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn near(found: f64, right: f64) -> bool {
        (found - right).abs() < 1e-12
    }

    #[test]
    fn the_threshold_lies_in_the_middle_of_the_widest_gap_by_ratio() {
        let merged_at = [0.1, 0.2, 0.59, 0.6, 0.7, 0.72, 0.95, 2.0];
        let found = widest_gap(&merged_at, RegionDistance::Relative);
        assert!(near(found, (0.6f64 * 0.7).sqrt()), "{found}");
    }

    #[test]
    fn a_merge_shorter_than_one_before_it_makes_no_gap_smaller() {
        let [with, without] = [&[0.55, 0.6, 0.3, 0.58, 0.72][..], &[0.55, 0.6, 0.72]];
        let found = |merged_at| widest_gap(merged_at, RegionDistance::Relative);
        assert_eq!(found(with), found(without));
    }

    #[test]
    fn of_equal_gaps_the_one_nearer_to_the_usual_counts() {
        // Both by a ratio of 1.2.
        let merged_at = [
            0.4, 0.48, 0.5, 0.52, 0.54, 0.56, 0.58, 0.6, 0.72, 0.74, 0.76, 0.78, 0.8, 0.82, 0.98,
        ];
        let found = widest_gap(&merged_at, RegionDistance::Relative);
        assert!(near(found, (0.6f64 * 0.72).sqrt()), "{found}");
    }

    #[test]
    fn without_merges_in_the_range_the_whole_range_is_the_gap() {
        for merged_at in [&[][..], &[0.1], &[0.1, 7.0]] {
            let found = widest_gap(merged_at, RegionDistance::Relative);
            assert!(near(found, 0.4f64.sqrt()), "{found}");
        }
    }

    #[test]
    fn a_threshold_is_a_number_or_a_word() {
        let read = |text: &str| Threshold::deserialize(text.parse::<toml::Value>().unwrap());
        assert_eq!(read("5"), Ok(Threshold::Fixed(5.0)));
        assert_eq!(read("0.5"), Ok(Threshold::Fixed(0.5)));
        assert_eq!(read("'auto'"), Ok(Threshold::Auto));
        let refused = read("'otto'").unwrap_err().to_string();
        assert!(refused.contains("or \"auto\""), "{refused}");
    }

    proptest! {
        #[test]
        fn it_lies_in_the_range_and_not_on_a_merge(
            merged_at in prop::collection::vec(0.0f64..60.0, 0..50),
            boundary in prop::bool::ANY,
        ) {
            let distance = if boundary { RegionDistance::Boundary } else { RegionDistance::Relative };
            let found = widest_gap(&merged_at, distance);
            let [low, _, high] = range(distance);
            prop_assert!(low <= found && found <= high);
            prop_assert!(!merged_at.contains(&found));
        }
    }
}
