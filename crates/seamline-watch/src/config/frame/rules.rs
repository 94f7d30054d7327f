//! `[[rules]]`: files that are cut in another way than the rest.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use seamline_ecs::PluginChoice;
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use serde::{Deserialize, Serialize};
use toml::Table;

use crate::include;

/// One `[[rules]]`: the way certain files are cut. The first rule that takes a file holds for it; files that none
/// takes are cut as `[pipeline]` and the tables of the steps say. Rules are the daemon's: `segment` goes by
/// `[pipeline]` alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RuleTable {
    /// Patterns of the files it holds for, of the same form as `include`: `["castings/**", "*_scan.ply"]`.
    pub files: Vec<String>,
    /// `segment`, or `rectify`: each mesh comes with labels or edges of another tool, `part.stl` with `part.seg` or
    /// `part.edges.txt`, whose boundaries are closed and cleaned. With `hard-edges.strong_deg` set it needs none. Empty:
    /// as `kind` of `[pipeline]` says.
    pub pipeline: String,
    /// The set of defaults; empty: that of `[pipeline]`.
    pub profile: String,
    /// The plugin that gives each curvature sample a cluster; empty: that of `[pipeline]`.
    pub classifier: PluginChoice,
    /// The plugin that cleans the boundaries, or `none`; empty: that of `[pipeline]`.
    pub rectifier: PluginChoice,
    /// Tables of steps and plugins, laid over those of the file: `[rules.settings.merge]`.
    #[schemars(with = "BTreeMap<String, BTreeMap<String, serde_json::Value>>")]
    pub settings: Table,
}

impl StepSettings for RuleTable {
    const TABLE: &'static str = "rules";
    const SEVERAL_KINDS: &'static [&'static str] = &["classifier", "rectifier", "settings"];

    fn defaults(_: Profile) -> Self {
        Self {
            files: Vec::new(),
            pipeline: String::new(),
            profile: String::new(),
            classifier: PluginChoice::DEFAULT,
            rectifier: PluginChoice::DEFAULT,
            settings: Table::new(),
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            !self.files.is_empty() && include::Patterns::new(&self.files).is_ok(),
            "files",
            "one pattern at least, as in `files = [\"castings/**\"]`",
        )?;
        OutOfRange::unless(
            ["", "segment", "rectify"].contains(&self.pipeline.as_str()),
            "pipeline",
            "`segment` or `rectify`",
        )
    }
}
