//! The reduction of the region adjacency graph (paper 4.4.2): the shortest link is merged first, until the
//! shortest is longer than the threshold or few enough regions are left.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use seamline_ecs::components::{Region, VertexCurvature};
use seamline_mesh::Sets;

use crate::merge::{MergeSettings, minus, norm, region_distance};
use crate::region_graph::{Merged, RegionGraph};
use crate::threshold::{Threshold, widest_gap};

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
/// that: 7 s of 16 on a flange of 1.7 million triangles. A distance that has grown is noticed in any case;
/// one that has shrunk by less than about this is noticed late.
const MEASURE_AGAIN_AFTER: f64 = 0.01;

/// A reduced graph.
pub struct Reduced {
    /// The new number of each region, counted by lowest old one.
    pub number: Vec<u32>,
    /// What is left.
    pub regions: Vec<Region>,
    /// The distance above which nothing was merged; `None` where a number of regions was wanted.
    pub threshold: Option<f64>,
}

/// Reduces the graph.
///
/// Cost: n log n in the number of links, as long as regions do not change by much with each merge.
pub fn reduce(
    graph: RegionGraph,
    settings: &MergeSettings,
    barely_curved: f64,
    border: Option<&[VertexCurvature]>,
) -> Reduced {
    let wanted = settings.regions as usize;
    let threshold = (wanted == 0).then(|| match settings.threshold {
        Threshold::Fixed(threshold) => threshold,
        Threshold::Auto => {
            let to_the_end = Reduction::of(graph.clone(), settings, barely_curved, border);
            widest_gap(&to_the_end.merged_at(), settings.distance)
        }
    });
    let mut reduction = Reduction::of(graph, settings, barely_curved, border);
    while reduction.left > wanted {
        let tied = reduction.shortest();
        let Some(shortest) = tied.first() else {
            break;
        };
        if threshold.is_some_and(|threshold| shortest.distance > threshold) {
            break;
        }
        for candidate in tied {
            if reduction.left > wanted {
                reduction.merge(candidate.regions);
            }
        }
    }
    let (number, regions) = reduction.finish();
    Reduced {
        number,
        regions,
        threshold,
    }
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

    /// Merges whatever has a link. Gives the distance of each merge, in the order they were made: of equal ones
    /// only one.
    fn merged_at(mut self) -> Vec<f64> {
        let mut distances = Vec::new();
        loop {
            let tied = self.shortest();
            let Some(first) = tied.first() else {
                return distances;
            };
            distances.push(first.distance);
            for candidate in tied {
                self.merge(candidate.regions);
            }
        }
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
