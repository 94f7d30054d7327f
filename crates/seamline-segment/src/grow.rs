//! Regions of equal cluster (paper 4.3).

use bevy_ecs::prelude::*;
use seamline_ecs::components::*;
use seamline_ecs::rows::{self, Regions};
use seamline_ecs::{Column, Counts, MeshTopology, Settled, Stage, StageSystems};
use seamline_mesh::{Sets, Topology};

use crate::rounding::to_eight_digits;
use crate::surfaces::regions_of;

pub(crate) fn vertex_systems() -> StageSystems {
    grow_from_vertices.pipe(make_rows).in_set(Stage::Grow)
}

pub(crate) fn facet_systems() -> StageSystems {
    grow_from_facets.pipe(make_rows).in_set(Stage::Grow)
}

/// Regions as they come out of growing: the region of each face, and the curvature of each region.
#[derive(Clone, Debug, Default)]
pub struct Grown {
    /// One a face; every face has a region.
    pub of_face: Vec<u32>,
    /// `(|k_min|, k_max)` of each region.
    pub curvatures: Vec<[f64; 2]>,
    /// Faces that no seed reached.
    pub cracks: usize,
}

fn make_rows(In(grown): In<Grown>, world: &mut World) {
    for (row, label) in rows::column_mut::<FaceLabel>(world)
        .iter_mut()
        .zip(grown.of_face)
    {
        row.0 = label;
    }
    rows::resize::<Regions>(world, grown.curvatures.len());
    for (row, &curvature) in rows::column_mut::<Region>(world)
        .iter_mut()
        .zip(&grown.curvatures)
    {
        *row = Region {
            curvature,
            ..Region::default()
        };
    }
    let mut counts = world.resource_mut::<Counts>();
    counts.note(Stage::Grow, "regions", grown.curvatures.len());
    counts.note(Stage::Grow, "crack_faces", grown.cracks);
}

fn grow_from_facets(
    settled: Res<Settled>,
    topology: Res<MeshTopology>,
    sharp: Column<SharpEdge>,
    facet_of_face: Column<FaceSample>,
    shapes: Column<FaceShape>,
    samples: Column<Sample>,
    clusters: Column<SampleCluster>,
) -> Grown {
    if let Some(patches) = &settled.0 {
        return regions_of(patches, &facet_of_face, &shapes, &samples);
    }
    grow_facets(
        &topology.0,
        &sharp,
        &facet_of_face,
        &shapes,
        &samples,
        &clusters,
    )
}

/// Regions from clusters of facets: facets of equal cluster, connected over edges that are not sharp. A
/// region has the area mean of its facets' curvature.
pub fn grow_facets(
    topology: &Topology,
    sharp: &[SharpEdge],
    facet_of_face: &[FaceSample],
    shapes: &[FaceShape],
    samples: &[Sample],
    clusters: &[SampleCluster],
) -> Grown {
    let cluster_of_face: Vec<u32> = facet_of_face
        .iter()
        .map(|facet| clusters[facet.0 as usize].0)
        .collect();
    let (of_face, count) = components(topology, sharp, &cluster_of_face);

    let curvatures = mean_curvatures(&of_face, count, facet_of_face, shapes, samples);
    Grown {
        of_face,
        curvatures,
        cracks: 0,
    }
}

/// The area mean of each region's facets' curvature.
pub(crate) fn mean_curvatures(
    of_face: &[u32],
    count: usize,
    facet_of_face: &[FaceSample],
    shapes: &[FaceShape],
    samples: &[Sample],
) -> Vec<[f64; 2]> {
    let mut sums = vec![([0.0; 2], 0.0); count];
    for ((&region, facet), shape) in of_face.iter().zip(facet_of_face).zip(shapes) {
        let curvature = samples[facet.0 as usize].curvature;
        let (sum, area) = &mut sums[region as usize];
        *sum = [0, 1].map(|k| sum[k] + curvature[k] * shape.area);
        *area += shape.area;
    }
    let mean = |(sum, area): ([f64; 2], f64)| {
        if area > 0.0 {
            sum.map(|s| s / area)
        } else {
            [0.0; 2]
        }
    };
    sums.into_iter().map(mean).collect()
}

fn grow_from_vertices(
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    sharp: Column<SharpEdge>,
    samples: Column<Sample>,
    clusters: Column<SampleCluster>,
) -> Grown {
    grow_pure_triangles(&topology.0, &positions, &sharp, &samples, &clusters)
}

/// Regions from clusters of vertices (paper 4.3).
///
/// The three seed situations of the paper's Fig. 5 are the triangles with at least one vertex that is not
/// sharp and all such vertices in one cluster: the pure ones. Growing from a pure triangle takes in pure
/// triangles of its cluster and no others, so regions are the connected components of those over edges
/// that are not sharp, in whatever order they grow. The triangles in between are filled in rounds from
/// their neighbours. A region has the curvature of its cluster's centroid.
pub fn grow_pure_triangles(
    topology: &Topology,
    positions: &[Position],
    sharp: &[SharpEdge],
    samples: &[Sample],
    clusters: &[SampleCluster],
) -> Grown {
    let mut cluster_of_vertex = vec![NONE; positions.len()];
    let mut curvature_of_vertex = vec![[0.0; 2]; positions.len()];
    let mut centroids = vec![([0.0; 2], 0usize); samples.len()];
    for (sample, cluster) in samples.iter().zip(clusters) {
        cluster_of_vertex[sample.vertex as usize] = cluster.0;
        curvature_of_vertex[sample.vertex as usize] = sample.curvature;
        let (sum, count) = &mut centroids[cluster.0 as usize];
        *sum = [0, 1].map(|k| sum[k] + sample.curvature[k]);
        *count += 1;
    }
    let cluster_of_face: Vec<u32> = topology
        .triangles
        .iter()
        .map(|corners| pure_cluster(corners, &cluster_of_vertex))
        .collect();

    let (sets, _) = components(topology, sharp, &cluster_of_face);
    let mut region_of_set = vec![NONE; sets.len()];
    let mut of_face = vec![NONE; sets.len()];
    let mut curvatures = Vec::new();
    for (face, &cluster) in cluster_of_face.iter().enumerate() {
        if cluster == NONE {
            continue;
        }
        let region = &mut region_of_set[sets[face] as usize];
        if *region == NONE {
            *region = curvatures.len() as u32;
            let (sum, count) = centroids[cluster as usize];
            curvatures.push(sum.map(|s| s / count as f64));
        }
        of_face[face] = *region;
    }

    let cracks = of_face.iter().filter(|&&label| label == NONE).count();
    fill_cracks(topology, positions, sharp, &mut of_face);
    label_pockets(
        topology,
        sharp,
        &cluster_of_vertex,
        &curvature_of_vertex,
        &mut of_face,
        &mut curvatures,
    );
    Grown {
        of_face,
        curvatures,
        cracks,
    }
}

/// The one cluster of a triangle's vertices that are not sharp, or [`NONE`].
fn pure_cluster(corners: &[u32; 3], cluster_of_vertex: &[u32]) -> u32 {
    let mut clusters = corners
        .iter()
        .map(|&v| cluster_of_vertex[v as usize])
        .filter(|&c| c != NONE);
    let Some(first) = clusters.next() else {
        return NONE;
    };
    if clusters.all(|c| c == first) {
        first
    } else {
        NONE
    }
}

/// Faces of equal cluster, connected over edges that are not sharp: a number a face, by lowest face.
fn components(
    topology: &Topology,
    sharp: &[SharpEdge],
    cluster_of_face: &[u32],
) -> (Vec<u32>, usize) {
    let mut sets = Sets::new(cluster_of_face.len());
    for (edge, sharp) in sharp.iter().enumerate() {
        if let Some([a, b]) = topology.face_pair(edge)
            && !sharp.0
            && cluster_of_face[a as usize] == cluster_of_face[b as usize]
        {
            sets.unite(a, b);
        }
    }
    sets.numbered()
}

/// Crack filling (paper 4.3.2): in rounds, every face without a region that touches regions over edges that
/// are not sharp takes the one with the greatest common length, the lower of equals.
fn fill_cracks(
    topology: &Topology,
    positions: &[Position],
    sharp: &[SharpEdge],
    of_face: &mut [u32],
) {
    let mut rim: Vec<u32> = (0..of_face.len() as u32)
        .filter(|&f| of_face[f as usize] == NONE)
        .collect();
    while !rim.is_empty() {
        let taken: Vec<(u32, u32)> = rim
            .iter()
            .filter_map(|&face| {
                Some((
                    face,
                    longest_neighbour(topology, positions, sharp, of_face, face)?,
                ))
            })
            .collect();
        let mut next = Vec::new();
        for &(face, region) in &taken {
            of_face[face as usize] = region;
        }
        for &(face, _) in &taken {
            let across = smooth_neighbours(topology, sharp, face).map(|(_, across)| across);
            next.extend(across.filter(|&across| of_face[across as usize] == NONE));
        }
        next.sort_unstable();
        next.dedup();
        rim = next;
    }
}

fn smooth_neighbours<'a>(
    topology: &'a Topology,
    sharp: &'a [SharpEdge],
    face: u32,
) -> impl Iterator<Item = (u32, u32)> + 'a {
    let edges = topology.face_edges[face as usize].into_iter();
    edges
        .filter(|&edge| !sharp[edge as usize].0)
        .filter_map(move |edge| Some((edge, topology.neighbour(face, edge)?)))
}

fn longest_neighbour(
    topology: &Topology,
    positions: &[Position],
    sharp: &[SharpEdge],
    of_face: &[u32],
    face: u32,
) -> Option<u32> {
    let mut lengths: Vec<(u32, f64)> = Vec::with_capacity(3);
    for (edge, across) in smooth_neighbours(topology, sharp, face) {
        let region = of_face[across as usize];
        if region == NONE {
            continue;
        }
        let [a, b] = topology.edge_vertices[edge as usize].map(|v| positions[v as usize].0);
        match lengths.iter_mut().find(|(known, _)| *known == region) {
            Some((_, length)) => *length += a.distance(b),
            None => lengths.push((region, a.distance(b))),
        }
    }
    let length = |l: &(u32, f64)| to_eight_digits(l.1);
    let better =
        |a: &(u32, f64), b: &(u32, f64)| length(a).total_cmp(&length(b)).then(b.0.cmp(&a.0));
    lengths.into_iter().max_by(better).map(|(region, _)| region)
}

/// Faces that no region touches: one new region a connected pocket, with the mean curvature of its
/// vertices that have one.
fn label_pockets(
    topology: &Topology,
    sharp: &[SharpEdge],
    cluster_of_vertex: &[u32],
    curvature_of_vertex: &[[f64; 2]],
    of_face: &mut [u32],
    curvatures: &mut Vec<[f64; 2]>,
) {
    for first in 0..of_face.len() as u32 {
        if of_face[first as usize] != NONE {
            continue;
        }
        let region = curvatures.len() as u32;
        of_face[first as usize] = region;
        let mut open = vec![first];
        let mut vertices = Vec::new();
        while let Some(face) = open.pop() {
            vertices.extend(topology.triangles[face as usize]);
            for (_, across) in smooth_neighbours(topology, sharp, face) {
                if of_face[across as usize] == NONE {
                    of_face[across as usize] = region;
                    open.push(across);
                }
            }
        }
        vertices.sort_unstable();
        vertices.dedup();
        vertices.retain(|&v| cluster_of_vertex[v as usize] != NONE);
        let count = vertices.len().max(1) as f64;
        let sum = |k: usize| {
            vertices
                .iter()
                .map(|&v| curvature_of_vertex[v as usize][k])
                .sum::<f64>()
        };
        curvatures.push([sum(0) / count, sum(1) / count]);
    }
}
