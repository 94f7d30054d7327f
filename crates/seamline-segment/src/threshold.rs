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

/// The range in which the gap is looked for, and the threshold where there is none.
fn range(distance: RegionDistance) -> [f64; 3] {
    match distance {
        RegionDistance::Relative => [0.5, 0.65, 0.8],
        RegionDistance::Boundary => [2.5, 5.0, 50.0],
    }
}

/// The threshold in the middle of the widest gap between the distances at which regions merge, by ratio.
///
/// `merged_at` is in the order of the merges. What counts is the greatest distance so far: a threshold below it
/// would have stopped before.
pub fn widest_gap(merged_at: &[f64], distance: RegionDistance) -> f64 {
    let [mut low, usual, mut high] = range(distance);
    let env = |n: &str, d: f64| std::env::var(n).ok().and_then(|t| t.parse().ok()).unwrap_or(d);
    low = env("DBG_LOW", low);
    high = env("DBG_HIGH", high);
    let s = env("DBG_S", 1e9);
    let mut best = (0.0, usual);
    let mut at = low;
    for &next in merged_at.iter().chain([&f64::INFINITY]) {
        if next <= at {
            continue;
        }
        let end = next.min(high);
        let gap = (end / at).ln() * (-((at * end).sqrt() / usual).ln().abs() / s).exp();
        if gap > best.0 {
            best = (gap, (at * end).sqrt());
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
