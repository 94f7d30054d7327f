//! What the JSON beside a mesh says of its patches.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use serde::Deserialize;

/// As the file has it, as far as it is used here.
#[derive(Deserialize)]
pub struct Truth {
    /// Number of patches of each type.
    pub types: BTreeMap<String, usize>,
    pub patches: Vec<TruePatch>,
    adjacency: Vec<Adjacent>,
}

#[derive(Deserialize)]
pub struct TruePatch {
    pub label: u32,
    /// `plane`, `cylinder`, `cone`, `sphere`, `torus`, `bspline` or `other`.
    #[serde(rename = "type")]
    pub kind: String,
    pub parameters: Sizes,
    /// Of all analytic types but planes.
    pub concave: Option<bool>,
}

/// Those of the parameters that are sizes; in the file's unit and in radians.
#[derive(Deserialize)]
pub struct Sizes {
    pub radius: Option<f64>,
    pub half_angle: Option<f64>,
    pub major_radius: Option<f64>,
    pub minor_radius: Option<f64>,
}

#[derive(Deserialize)]
struct Adjacent {
    patches: [u32; 2],
    /// `None` where it is not known.
    smooth: Option<bool>,
}

impl Truth {
    /// # Panics
    ///
    /// If the file is not there or of another form.
    pub fn read(path: &Path) -> Self {
        let text =
            fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// Has the part a patch that is no plane, cylinder, cone, sphere or torus?
    pub fn has_free_forms(&self) -> bool {
        ["bspline", "other"]
            .iter()
            .any(|&kind| self.types.get(kind).is_some_and(|&count| count > 0))
    }

    /// The pairs of patches that meet without an edge, lower label first.
    pub fn tangent(&self) -> BTreeSet<[u32; 2]> {
        let smooth = self.adjacency.iter().filter(|row| row.smooth == Some(true));
        smooth
            .map(|row| {
                let [a, b] = row.patches;
                [a.min(b), a.max(b)]
            })
            .collect()
    }
}
