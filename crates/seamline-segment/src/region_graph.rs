//! The region adjacency graph (paper 4.4.1): what two neighbouring regions have in common.

use std::collections::BTreeMap;

use rayon::prelude::*;
use seamline_ecs::components::{
    FaceLabel, FaceShape, Position, Region, SharpEdge, VertexCurvature,
};
use seamline_mesh::{EdgeKind, Topology};

/// What two regions have in common.
#[derive(Clone, Debug, Default)]
pub struct Link {
    /// Length of all common edges.
    pub length: f64,
    /// Length of the common edges that are not sharp.
    pub smooth_length: f64,
    /// Curvature along the common border, if it was asked for.
    pub border: BorderCurvature,
}

/// Curvature at the vertices of a common border.
#[derive(Clone, Debug, Default)]
pub struct BorderCurvature {
    /// Vertices of the common edges, with how many of these edges each ends.
    ends: BTreeMap<u32, u32>,
    /// Sum over all of them.
    all: [f64; 2],
    /// Sum over those with two common edges at least.
    inner: [f64; 2],
    inner_count: usize,
}

impl BorderCurvature {
    fn add(&mut self, vertex: u32, edges: u32, curvature: [f64; 2]) {
        let count = self.ends.entry(vertex).or_insert(0);
        if *count == 0 {
            self.all = plus(self.all, curvature);
        }
        if *count < 2 && *count + edges >= 2 {
            self.inner = plus(self.inner, curvature);
            self.inner_count += 1;
        }
        *count += edges;
    }

    fn unite(&mut self, mut other: Self, curvatures: &[VertexCurvature]) {
        if self.ends.len() < other.ends.len() {
            std::mem::swap(self, &mut other);
        }
        for (vertex, edges) in other.ends {
            self.add(vertex, edges, curvatures[vertex as usize].k.feature());
        }
    }

    /// `c_ij` of the paper (4.4.3): the mean over real boundary vertices, those with two incident edges
    /// that separate the two regions; over all ends where there is none.
    pub fn mean(&self) -> [f64; 2] {
        if self.inner_count > 0 {
            self.inner.map(|sum| sum / self.inner_count as f64)
        } else {
            self.all.map(|sum| sum / self.ends.len().max(1) as f64)
        }
    }
}

fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Regions and their links. A link is named by its two regions, the lower first.
#[derive(Clone, Debug, Default)]
pub struct RegionGraph {
    /// One a region; those merged into another one are empty.
    pub regions: Vec<Region>,
    /// The links of each region: neighbour, and index into `links`.
    pub neighbours: Vec<BTreeMap<u32, u32>>,
    /// The links; those united with another one are empty.
    pub links: Vec<Link>,
}

impl RegionGraph {
    /// The graph of a labelled mesh. `regions` brings the curvatures; areas and perimeters are measured
    /// here: the perimeter is the length of the edges with the region on one side only, mesh borders
    /// included. `border` asks for the curvature along common borders.
    pub fn build(
        topology: &Topology,
        positions: &[Position],
        shapes: &[FaceShape],
        sharp: &[SharpEdge],
        labels: &[FaceLabel],
        mut regions: Vec<Region>,
        border: Option<&[VertexCurvature]>,
    ) -> Self {
        for region in &mut regions {
            (region.area, region.perimeter) = (0.0, 0.0);
        }
        for (label, shape) in labels.iter().zip(shapes) {
            regions[label.0 as usize].area += shape.area;
        }
        let length = |edge: usize| {
            let [a, b] = topology.edge_vertices[edge].map(|v| positions[v as usize].0);
            a.distance(b)
        };
        let mut common: Vec<(u32, u32, u32)> = Vec::new();
        for edge in 0..topology.edge_vertices.len() {
            if let Some([a, b]) = topology.face_pair(edge) {
                let [a, b] = [a, b].map(|face| labels[face as usize].0);
                if a != b {
                    common.push((a.min(b), a.max(b), edge as u32));
                    regions[a as usize].perimeter += length(edge);
                    regions[b as usize].perimeter += length(edge);
                }
            }
        }
        for (face, edges) in topology.face_edges.iter().enumerate() {
            for &edge in edges {
                if matches!(
                    topology.edge_kind[edge as usize],
                    EdgeKind::Border | EdgeKind::NonManifold
                ) {
                    regions[labels[face].0 as usize].perimeter += length(edge as usize);
                }
            }
        }
        common.par_sort_unstable();

        let mut graph = Self {
            neighbours: vec![BTreeMap::new(); regions.len()],
            regions,
            links: Vec::new(),
        };
        for edges in common.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let mut link = Link::default();
            for &(_, _, edge) in edges {
                let edge = edge as usize;
                link.length += length(edge);
                if !sharp[edge].0 {
                    link.smooth_length += length(edge);
                }
                if let Some(curvatures) = border {
                    for v in topology.edge_vertices[edge] {
                        link.border.add(v, 1, curvatures[v as usize].k.feature());
                    }
                }
            }
            let (a, b, _) = edges[0];
            let index = graph.links.len() as u32;
            graph.neighbours[a as usize].insert(b, index);
            graph.neighbours[b as usize].insert(a, index);
            graph.links.push(link);
        }
        graph
    }

    /// Merges two neighbouring regions: curvatures averaged by area, areas added, perimeters less the common
    /// border, links united (paper 4.4.2). The region with more links stays and takes over those of the
    /// other, which is left empty.
    pub fn merge(&mut self, a: u32, b: u32, border: Option<&[VertexCurvature]>) -> Merged {
        let links_of = |region: u32| self.neighbours[region as usize].len();
        let [kept, gone] = if (links_of(b), a) > (links_of(a), b) {
            [b, a]
        } else {
            [a, b]
        };
        let common = self.neighbours[kept as usize].remove(&gone);
        self.neighbours[gone as usize].remove(&kept);
        let common_length = common.map_or(0.0, |link| self.links[link as usize].length);

        let pair = [self.regions[kept as usize], self.regions[gone as usize]];
        self.regions[kept as usize] = united(pair, common_length);
        self.regions[gone as usize] = Region::default();
        let mut relinked = Vec::new();
        for (other, link) in std::mem::take(&mut self.neighbours[gone as usize]) {
            relinked.push(other);
            self.neighbours[other as usize].remove(&gone);
            match self.neighbours[kept as usize].get(&other) {
                Some(&into) => {
                    let from = std::mem::take(&mut self.links[link as usize]);
                    let into = &mut self.links[into as usize];
                    into.length += from.length;
                    into.smooth_length += from.smooth_length;
                    if let Some(curvatures) = border {
                        into.border.unite(from.border, curvatures);
                    }
                }
                None => {
                    self.neighbours[kept as usize].insert(other, link);
                    self.neighbours[other as usize].insert(kept, link);
                }
            }
        }
        Merged {
            kept,
            gone,
            relinked,
        }
    }
}

/// What became of two regions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Merged {
    /// The one that stays.
    pub kept: u32,
    /// The one that is gone.
    pub gone: u32,
    /// The regions whose link to the one that stays is new or has grown.
    pub relinked: Vec<u32>,
}

fn united([a, b]: [Region; 2], common_length: f64) -> Region {
    let area = a.area + b.area;
    let blend = |k: usize| (a.curvature[k] * a.area + b.curvature[k] * b.area) / area;
    Region {
        curvature: if area > 0.0 {
            [blend(0), blend(1)]
        } else {
            a.curvature
        },
        area,
        perimeter: (a.perimeter + b.perimeter - 2.0 * common_length).max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, dvec3};

    /// A grid of unit squares in the plane, `labels` row by row.
    fn grid(columns: u32, labels: &[u32]) -> RegionGraph {
        let rows = labels.len() as u32 / columns;
        let at = |x: u32, y: u32| y * (columns + 1) + x;
        let mut triangles = Vec::new();
        let mut of_face = Vec::new();
        for (square, &label) in labels.iter().enumerate() {
            let (x, y) = (square as u32 % columns, square as u32 / columns);
            triangles.push([at(x, y), at(x + 1, y), at(x + 1, y + 1)]);
            triangles.push([at(x, y), at(x + 1, y + 1), at(x, y + 1)]);
            of_face.extend([FaceLabel(label); 2]);
        }
        let corners = (0..=rows).flat_map(|y| (0..=columns).map(move |x| (x, y)));
        let positions: Vec<_> = corners
            .map(|(x, y)| Position(dvec3(f64::from(x), f64::from(y), 0.0)))
            .collect();
        let topology = Topology::build(positions.len(), triangles);
        let shapes = vec![
            FaceShape {
                normal: DVec3::Z,
                area: 0.5
            };
            of_face.len()
        ];
        let sharp = vec![SharpEdge(false); topology.edge_vertices.len()];
        let count = labels.iter().max().map_or(0, |&last| last as usize + 1);
        let curvatures = vec![VertexCurvature::default(); positions.len()];
        let regions = vec![Region::default(); count];
        RegionGraph::build(
            &topology,
            &positions,
            &shapes,
            &sharp,
            &of_face,
            regions,
            Some(&curvatures),
        )
    }

    /// `N` of the paper.
    fn nesting(graph: &RegionGraph, a: usize, b: u32) -> f64 {
        let link = &graph.links[graph.neighbours[a][&b] as usize];
        graph.regions[a]
            .perimeter
            .min(graph.regions[b as usize].perimeter)
            / link.length
    }

    #[test]
    fn two_unit_squares_that_share_a_side_nest_by_4() {
        let graph = grid(2, &[0, 1]);
        assert_eq!(graph.regions[0].perimeter, 4.0);
        assert_eq!(nesting(&graph, 0, 1), 4.0);
    }

    #[test]
    fn a_region_wholly_inside_another_nests_by_1() {
        let graph = grid(3, &[0, 0, 0, 0, 1, 0, 0, 0, 0]);
        assert_eq!(graph.regions[0].perimeter, 16.0);
        assert_eq!(nesting(&graph, 0, 1), 1.0);
    }

    #[test]
    fn merging_adds_areas_and_takes_the_common_border_off_the_perimeters() {
        let mut graph = grid(3, &[0, 1, 2, 0, 1, 2]);
        let merged = graph.merge(0, 1, None);
        let expected = Merged {
            kept: 1,
            gone: 0,
            relinked: vec![],
        };
        assert_eq!(merged, expected, "the one with more links stays");
        let region = graph.regions[1];
        assert_eq!((region.area, region.perimeter), (4.0, 8.0));
        assert_eq!(graph.neighbours[1].keys().copied().collect::<Vec<_>>(), [2]);
        assert_eq!(nesting(&graph, 1, 2), 3.0);
    }

    #[test]
    fn only_vertices_with_two_common_edges_are_on_the_real_border() {
        let mut border = BorderCurvature::default();
        for (vertex, curvature) in [(0, 1.0), (1, 5.0), (1, 5.0), (2, 3.0)] {
            border.add(vertex, 1, [0.0, curvature]);
        }
        assert_eq!(border.mean(), [0.0, 5.0]);
    }

    #[test]
    fn a_border_of_one_edge_has_the_mean_of_its_ends() {
        let mut border = BorderCurvature::default();
        border.add(0, 1, [0.0, 1.0]);
        border.add(1, 1, [0.0, 3.0]);
        assert_eq!(border.mean(), [0.0, 2.0]);
    }
}
