//! Region merging (paper 4.4; algorithm steps 5 and 6.6): the graph's shortest link goes first, until the
//! shortest is longer than a threshold or few enough regions are left.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use bevy_ecs::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::*;
use seamline_ecs::rows::{self, Regions};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Column, ColumnMut, Counts, MeshTopology, Stage, StageSystems};
use serde::{Deserialize, Serialize};

use crate::facets::FacetSettings;
use crate::region_graph::{Link, RegionGraph};
use seamline_mesh::Sets;

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
    /// Merging stops when the smallest distance is above this. `lavoue2005`: 5, in curvature of the scaled
    /// mesh (paper Fig. 10 and 12); `cad`: 0.6, without unit (from .4 to 1 boundary F1 moves by .05).
    pub threshold: f64,
    /// Merging stops at this number of regions instead; 0: the threshold decides.
    pub regions: u32,
    /// A region below this share of the whole area is small: `A_min` of the paper. Default 0.002; from
    /// 0.0005 to 0.01 the paper's tables come out alike.
    pub min_area_share: f64,
    /// Distances of small regions are multiplied by this: `epsilon` of the paper. `lavoue2005`: 1e-5,
    /// `cad`: 0.2, so that small tangent fillets survive.
    pub small_factor: f64,
    /// Regions whose whole common border is sharp never merge. Default true: the tensor at a sharp edge is
    /// small where triangles are large, and a coarse cylinder would become one region.
    pub sharp_block: bool,
}

impl StepSettings for MergeSettings {
    const TABLE: &'static str = "merge";

    fn defaults(profile: Profile) -> Self {
        let common = Self {
            distance: RegionDistance::Relative,
            threshold: 0.6,
            regions: 0,
            min_area_share: 0.002,
            small_factor: 0.2,
            sharp_block: true,
        };
        match profile {
            Profile::Cad => common,
            Profile::Lavoue2005 => Self {
                distance: RegionDistance::Boundary,
                threshold: 5.0,
                small_factor: 1e-5,
                ..common
            },
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.threshold >= 0.0,
            "threshold",
            "a distance of 0 or more",
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
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    shapes: Column<FaceShape>,
    sharp: Column<SharpEdge>,
    curvatures: Column<VertexCurvature>,
    regions: Column<Region>,
    mut labels: ColumnMut<FaceLabel>,
) -> Vec<Region> {
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
    let (number, regions) = reduce(graph, &settings, facets.barely_curved, border);
    for label in labels.iter_mut() {
        label.0 = number[label.0 as usize];
    }
    regions
}

fn make_rows(In(regions): In<Vec<Region>>, world: &mut World) {
    rows::resize::<Regions>(world, regions.len());
    rows::column_mut(world).copy_from_slice(&regions);
    world
        .resource_mut::<Counts>()
        .note(Stage::Merge, "regions", regions.len());
}

/// A link on the heap, shortest first; of equals, the one with the lower regions.
#[derive(PartialEq)]
struct Candidate {
    distance: f64,
    regions: [u32; 2],
    /// The link's state when it was put here; it has changed since if its stamp has.
    stamp: u32,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = self.distance.total_cmp(&other.distance);
        order
            .then(self.regions.cmp(&other.regions))
            .then(self.stamp.cmp(&other.stamp))
            .reverse()
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Reduces the graph. Gives the new number of each region, counted by lowest old one, and what is left.
///
/// Cost: every merge puts the links of the merged region on the heap again.
pub fn reduce(
    mut graph: RegionGraph,
    settings: &MergeSettings,
    barely_curved: f64,
    border: Option<&[VertexCurvature]>,
) -> (Vec<u32>, Vec<Region>) {
    let total_area: f64 = graph.regions.iter().map(|region| region.area).sum();
    let small_below = settings.min_area_share * total_area;
    let distance = |graph: &RegionGraph, a: u32, b: u32, link: u32| {
        let pair = [&graph.regions[a as usize], &graph.regions[b as usize]];
        region_distance(
            settings,
            barely_curved,
            small_below,
            pair,
            &graph.links[link as usize],
        )
    };

    let mut stamps = vec![0u32; graph.links.len()];
    let mut heap = BinaryHeap::new();
    for a in 0..graph.regions.len() as u32 {
        for (&b, &link) in graph.neighbours[a as usize].range(a..) {
            if let Some(distance) = distance(&graph, a, b, link) {
                heap.push(Candidate {
                    distance,
                    regions: [a, b],
                    stamp: 0,
                });
            }
        }
    }

    let mut sets = Sets::new(graph.regions.len());
    let mut left = graph.regions.len();
    let wanted = settings.regions as usize;
    while let Some(Candidate {
        distance: shortest,
        regions: [kept, gone],
        stamp,
    }) = heap.pop()
    {
        if left <= wanted || (wanted == 0 && shortest > settings.threshold) {
            break;
        }
        let current = graph.neighbours[kept as usize].get(&gone);
        if current.is_none_or(|&link| stamps[link as usize] != stamp) {
            continue;
        }
        graph.merge(kept, gone, border);
        sets.unite(kept, gone);
        left -= 1;
        for (&other, &link) in &graph.neighbours[kept as usize] {
            stamps[link as usize] += 1;
            if let Some(distance) = distance(&graph, kept, other, link) {
                let regions = [kept.min(other), kept.max(other)];
                heap.push(Candidate {
                    distance,
                    regions,
                    stamp: stamps[link as usize],
                });
            }
        }
    }

    let roots: Vec<u32> = (0..graph.regions.len() as u32)
        .filter(|&r| sets.first(r) == r)
        .collect();
    let regions = roots
        .iter()
        .map(|&root| graph.regions[root as usize])
        .collect();
    (sets.numbered().0, regions)
}

/// `D = DC N S`: curvature distance, nesting, and the favour for small regions. `None` where the two never
/// merge.
fn region_distance(
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
    Some(curvature * nesting * if small { settings.small_factor } else { 1.0 })
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}
