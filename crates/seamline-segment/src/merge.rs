//! Region merging (paper 4.4): the graph's shortest link goes first, until the
//! shortest is longer than a threshold or few enough regions are left.

use bevy_ecs::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::*;
use seamline_ecs::rows::{self, Regions};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{
    Column, ColumnMut, Counts, Measures, MeshTopology, Settled, Stage, StageSystems,
};
use serde::{Deserialize, Serialize};

use crate::facets::FacetSettings;
use crate::reduction::reduce;
use crate::region_graph::{Link, RegionGraph};
use crate::rounding::to_eight_digits;
use crate::threshold::Threshold;

/// How different two neighbouring regions are, `DC` in `D = DC N S`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RegionDistance {
    /// `|c_i - c_ij| + |c_j - c_ij|` with the curvature `c_ij` of the common border (paper 4.4.3). In units
    /// of curvature.
    Boundary,
    /// `|c_i - c_j| / (|c_i| + |c_j| + barely_curved)`, from 0 to 1: the same for large radii and small
    /// ones.
    Relative,
}

/// The `[merge]` table.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MergeSettings {
    /// How different two regions are: `boundary` (paper) or `relative`.
    pub distance: RegionDistance,
    /// Merging stops when the smallest distance is above this. With `boundary` in curvature of the scaled
    /// mesh (5 in the paper's Fig. 10 and 12); with `relative` without unit (.6 to .7 measure alike). `"auto"`: from
    /// the distances of the part itself.
    pub threshold: Threshold,
    /// Merging stops at this number of regions instead; 0: the threshold decides.
    pub regions: u32,
    /// A region below this share of the whole area is small: `A_min` of the paper. From 0.0005 to
    /// 0.01 the paper's tables come out alike.
    pub min_area_share: f64,
    /// Distances of small regions are multiplied by this: `epsilon` of the paper, 1e-5
    /// there. At 0.2 small tangent fillets survive.
    pub small_factor: f64,
    /// Regions whose whole common border is sharp never merge: the tensor at a sharp edge is
    /// small where triangles are large, and a coarse cylinder would become one region.
    pub sharp_block: bool,
}

impl StepSettings for MergeSettings {
    const TABLE: &'static str = "merge";
    const SEVERAL_KINDS: &'static [&'static str] = &["threshold"];

    fn defaults(profile: Profile) -> Self {
        let common = Self {
            distance: RegionDistance::Relative,
            threshold: Threshold::Fixed(0.65),
            regions: 0,
            min_area_share: 0.002,
            small_factor: 0.2,
            sharp_block: true,
        };
        match profile {
            Profile::Cad => common,
            Profile::Lavoue2005 => Self {
                distance: RegionDistance::Boundary,
                threshold: Threshold::Fixed(5.0),
                small_factor: 1e-5,
                ..common
            },
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.threshold.is_right(),
            "threshold",
            "a distance of 0 or more, or \"auto\"",
        )?;
        OutOfRange::unless(
            (0.0..=1.0).contains(&self.min_area_share),
            "min_area_share",
            "a share of the whole area from 0 to 1",
        )?;
        OutOfRange::unless(
            self.small_factor >= 0.0,
            "small_factor",
            "a factor of 0 or more",
        )
    }
}

pub(crate) fn systems() -> StageSystems {
    merge_regions.pipe(make_rows).in_set(Stage::Merge)
}

fn merge_regions(
    settings: Res<MergeSettings>,
    facets: Res<FacetSettings>,
    settled: Res<Settled>,
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    shapes: Column<FaceShape>,
    sharp: Column<SharpEdge>,
    curvatures: Column<VertexCurvature>,
    regions: Column<Region>,
    mut labels: ColumnMut<FaceLabel>,
    mut measures: ResMut<Measures>,
) -> Vec<Region> {
    // What surfaces have settled is not merged.
    if settled.0.is_some() {
        return regions.to_vec();
    }
    let border = (settings.distance == RegionDistance::Boundary).then_some(&curvatures[..]);
    let graph = RegionGraph::build(
        &topology.0,
        &positions,
        &shapes,
        &sharp,
        &labels,
        regions.to_vec(),
        border,
    );
    let reduced = reduce(graph, &settings, facets.barely_curved, border);
    for label in labels.iter_mut() {
        label.0 = reduced.number[label.0 as usize];
    }
    if let Some(threshold) = reduced.threshold {
        measures.note(Stage::Merge, "threshold", threshold);
    }
    reduced.regions
}

fn make_rows(In(regions): In<Vec<Region>>, world: &mut World) {
    rows::resize::<Regions>(world, regions.len());
    rows::column_mut(world).copy_from_slice(&regions);
    world
        .resource_mut::<Counts>()
        .note(Stage::Merge, "regions", regions.len());
}

/// `D = DC N S`: curvature distance, nesting, and the favour for small regions. `None` where the two never
/// merge.
pub(crate) fn region_distance(
    settings: &MergeSettings,
    barely_curved: f64,
    small_below: f64,
    [a, b]: [&Region; 2],
    link: &Link,
) -> Option<f64> {
    let all_sharp = link.smooth_length == 0.0;
    let shorter = a.perimeter.min(b.perimeter);
    let (curvature, nesting) = match settings.distance {
        RegionDistance::Boundary => {
            if all_sharp && settings.sharp_block {
                return None;
            }
            let between = link.border.mean();
            let apart = norm(minus(a.curvature, between)) + norm(minus(b.curvature, between));
            (apart, shorter / link.length)
        }
        RegionDistance::Relative => {
            if all_sharp {
                return None;
            }
            let apart = norm(minus(a.curvature, b.curvature));
            let size = norm(a.curvature) + norm(b.curvature) + barely_curved;
            (apart / size, (shorter / link.smooth_length).max(1.0))
        }
    };
    let small = a.area.min(b.area) < small_below;
    let favour = if small { settings.small_factor } else { 1.0 };
    Some(to_eight_digits(curvature * nesting * favour))
}

pub(crate) fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}
