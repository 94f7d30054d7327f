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
use crate::region_graph::{Link, Merged, RegionGraph};
use crate::rounding::to_eight_digits;
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
    /// Merging stops when the smallest distance is above this. With `boundary` in curvature of the scaled
    /// mesh (5 in the paper's Fig. 10 and 12); with `relative` without unit (.6 to .7 measure alike).
    pub threshold: f64,
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

    fn defaults(profile: Profile) -> Self {
        let common = Self {
            distance: RegionDistance::Relative,
            threshold: 0.65,
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
    /// By the lowest number of a region that is merged into each.
    names: [u32; 2],
    /// As the graph knows them.
    regions: [u32; 2],
    link: u32,
    /// The link's state when it was put here; it has changed since if its stamp has.
    stamp: u32,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = self
            .distance
            .total_cmp(&other.distance)
            .then(self.names.cmp(&other.names));
        order
            .then((self.link, self.stamp).cmp(&(other.link, other.stamp)))
            .reverse()
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// All links of a region are measured again once it has changed by this much, relatively, since they were
/// last. A region of ten thousand neighbours that takes them in one by one would else cost the square of
/// that: 7 s of 16 on a flange of 1.7 million triangles. A distance that has grown is noticed in any case; one that
/// has shrunk by less than about this is noticed late.
const MEASURE_AGAIN_AFTER: f64 = 0.01;

/// Reduces the graph. Gives the new number of each region, counted by lowest old one, and what is left.
///
/// Cost: n log n in the number of links, as long as regions do not change by much with each merge.
pub fn reduce(
    graph: RegionGraph,
    settings: &MergeSettings,
    barely_curved: f64,
    border: Option<&[VertexCurvature]>,
) -> (Vec<u32>, Vec<Region>) {
    let mut reduction = Reduction::of(graph, settings, barely_curved, border);
    let wanted = settings.regions as usize;
    while reduction.left > wanted {
        let tied = reduction.shortest();
        if tied.is_empty() || (wanted == 0 && tied[0].distance > settings.threshold) {
            break;
        }
        for candidate in tied {
            if reduction.left > wanted {
                reduction.merge(candidate.regions);
            }
        }
    }
    reduction.finish()
}

struct Reduction<'a> {
    graph: RegionGraph,
    settings: &'a MergeSettings,
    barely_curved: f64,
    border: Option<&'a [VertexCurvature]>,
    /// Area below which a region is small.
    small_below: f64,
    heap: BinaryHeap<Candidate>,
    /// One a link.
    stamps: Vec<u32>,
    /// The distance each link is on the heap with; infinite where it is not.
    on_heap: Vec<f64>,
    /// Which regions have become one; each set is named by its lowest.
    sets: Sets,
    /// The region of the graph that stands for each set.
    standing: Vec<u32>,
    /// Regions left.
    left: usize,
    /// How much each region has changed since all its links were measured.
    changed: Vec<f64>,
}

impl<'a> Reduction<'a> {
    fn of(
        graph: RegionGraph,
        settings: &'a MergeSettings,
        barely_curved: f64,
        border: Option<&'a [VertexCurvature]>,
    ) -> Self {
        let count = graph.regions.len();
        let total_area: f64 = graph.regions.iter().map(|region| region.area).sum();
        let mut reduction = Self {
            settings,
            barely_curved,
            border,
            small_below: settings.min_area_share * total_area,
            heap: BinaryHeap::new(),
            stamps: vec![0; graph.links.len()],
            on_heap: vec![f64::INFINITY; graph.links.len()],
            sets: Sets::new(count),
            standing: (0..count as u32).collect(),
            left: count,
            changed: vec![0.0; count],
            graph,
        };
        for region in 0..count as u32 {
            let higher = reduction.graph.neighbours[region as usize].range(region..);
            for (other, link) in higher
                .map(|(&other, &link)| (other, link))
                .collect::<Vec<_>>()
            {
                reduction.measure(region, other, link);
            }
        }
        reduction
    }

    fn distance(&self, [a, b]: [u32; 2], link: u32) -> Option<f64> {
        let pair = [a, b].map(|region| &self.graph.regions[region as usize]);
        let link = &self.graph.links[link as usize];
        region_distance(
            self.settings,
            self.barely_curved,
            self.small_below,
            pair,
            link,
        )
    }

    /// Puts a link on the heap as it is now.
    fn measure(&mut self, a: u32, b: u32, link: u32) {
        self.stamps[link as usize] += 1;
        self.on_heap[link as usize] = f64::INFINITY;
        if let Some(distance) = self.distance([a, b], link) {
            self.on_heap[link as usize] = distance;
            let mut names = [self.sets.first(a), self.sets.first(b)];
            names.sort_unstable();
            let stamp = self.stamps[link as usize];
            self.heap.push(Candidate {
                distance,
                names,
                regions: [a, b],
                link,
                stamp,
            });
        }
    }

    /// As [`Self::measure`], if the link has become shorter: one that has grown is noticed when it comes off
    /// the heap.
    fn measure_if_shorter(&mut self, a: u32, b: u32, link: u32) {
        let now = self.distance([a, b], link);
        if now.is_some_and(|now| now < self.on_heap[link as usize]) {
            self.measure(a, b, link);
        }
    }

    /// The shortest link there is and all that are as short, off the heap. They are merged at once: on a
    /// symmetric part an order among equals would come from how the part lies.
    fn shortest(&mut self) -> Vec<Candidate> {
        let mut tied: Vec<Candidate> = Vec::new();
        while let Some(candidate) = self.heap.peek() {
            if tied
                .first()
                .is_some_and(|first| candidate.distance > first.distance)
            {
                break;
            }
            let Some(candidate) = self.heap.pop() else {
                break;
            };
            let [a, b] = candidate.regions;
            let current = self.graph.neighbours[a as usize].get(&b) == Some(&candidate.link);
            if !current || self.stamps[candidate.link as usize] != candidate.stamp {
                continue;
            }
            match self.distance([a, b], candidate.link) {
                Some(now) if now > candidate.distance => self.measure(a, b, candidate.link),
                _ => {
                    self.on_heap[candidate.link as usize] = f64::INFINITY;
                    tied.push(candidate);
                }
            }
        }
        tied
    }

    /// Makes two regions one, or those they have become part of.
    fn merge(&mut self, regions: [u32; 2]) {
        let [a, b] = regions.map(|region| self.standing[self.sets.first(region) as usize]);
        if a == b {
            return;
        }
        let before = [a, b].map(|region| self.graph.regions[region as usize]);
        let Merged {
            kept,
            gone,
            relinked,
        } = self.graph.merge(a, b, self.border);
        self.sets.unite(kept, gone);
        self.standing[self.sets.first(kept) as usize] = kept;
        self.left -= 1;

        let before = if kept == a { before[0] } else { before[1] };
        let after = self.graph.regions[kept as usize];
        self.changed[kept as usize] += self.change(&before, &after);
        for other in relinked {
            if let Some(&link) = self.graph.neighbours[kept as usize].get(&other) {
                self.measure(kept, other, link);
            }
        }
        if self.changed[kept as usize] > MEASURE_AGAIN_AFTER {
            self.changed[kept as usize] = 0.0;
            let links: Vec<_> = self.graph.neighbours[kept as usize]
                .iter()
                .map(|(&other, &link)| (other, link))
                .collect();
            for (other, link) in links {
                self.measure_if_shorter(kept, other, link);
            }
        }
    }

    /// How much a region has changed, relatively, as far as distances go.
    fn change(&self, before: &Region, after: &Region) -> f64 {
        if (before.area < self.small_below) != (after.area < self.small_below) {
            return f64::INFINITY;
        }
        let curvature = norm(minus(after.curvature, before.curvature));
        let perimeter = (after.perimeter - before.perimeter).abs();
        curvature / (norm(before.curvature) + self.barely_curved)
            + if perimeter > 0.0 {
                perimeter / before.perimeter
            } else {
                0.0
            }
    }

    fn finish(self) -> (Vec<u32>, Vec<Region>) {
        let (numbers, left) = self.sets.numbered();
        let mut regions = vec![Region::default(); left];
        // Of those that have become one, all but one are empty.
        for (&number, region) in numbers.iter().zip(&self.graph.regions) {
            if region.area > 0.0 {
                regions[number as usize] = *region;
            }
        }
        (numbers, regions)
    }
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
    let favour = if small { settings.small_factor } else { 1.0 };
    Some(to_eight_digits(curvature * nesting * favour))
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}
