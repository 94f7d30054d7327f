//! Facets, the flat pieces of a tessellation, and the curvature each of them bears.
//!
//! On a coarse CAD tessellation every vertex of a fillet lies on its rim, shared with large planes, and
//! says little of the fillet. Its strips say all: one strip of a cylinder, a plane however it is cut, a
//! needle, each is one facet, and its tensor over its area is exact on prisms.

use bevy_ecs::prelude::*;
use glam::DVec3;
use rayon::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::*;
use seamline_ecs::rows::{self, Samples};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Column, ColumnMut, Counts, MeshTopology, Stage, StageSystems};
use seamline_mesh::{Sets, Topology};
use serde::{Deserialize, Serialize};

use crate::eigen::tangent_principal_frame;
use crate::tensor::{Bending, BendingColumns, Smooth, add_scaled, face_tensors, over};

/// The `[facets]` table: curvature on facets.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FacetSettings {
    /// Triangles that turn by less than this belong to one facet.
    pub flat_deg: f64,
    /// Rounds of the median filter over neighbouring facets. A third raises ARI on uniform meshes from .88 to
    /// .93 and leaves coarse and fine ones within .01.
    pub median_rounds: u32,
    /// A neighbour takes part in the median if the smaller of the two areas is more than this share of the
    /// larger. Without it a large flat is outvoted by the strips about it (boundary F1 .84 falls to .69).
    pub similar_area_share: f64,
    /// Curvature that counts as barely curved, over the part's size: features are `ln(1 + c / this)`, and
    /// the relative distance of regions levels off below it. At 0.4 that is a radius of two and a half sizes; from
    /// 0.4 to 0.7 the means over the bench move by .02.
    pub barely_curved: f64,
}

impl StepSettings for FacetSettings {
    const TABLE: &'static str = "facets";

    fn defaults(_: Profile) -> Self {
        Self {
            flat_deg: 0.1,
            median_rounds: 3,
            similar_area_share: 0.5,
            barely_curved: 0.4,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (0.0..90.0).contains(&self.flat_deg),
            "flat_deg",
            "an angle from 0 to below 90 degrees",
        )?;
        OutOfRange::unless(
            (0.0..1.0).contains(&self.similar_area_share),
            "similar_area_share",
            "a share from 0 to below 1",
        )?;
        OutOfRange::unless(
            self.median_rounds <= 100,
            "median_rounds",
            "a number from 0 to 100",
        )?;
        OutOfRange::unless(
            self.barely_curved > 0.0,
            "barely_curved",
            "a curvature above 0",
        )
    }
}

pub(crate) fn systems() -> StageSystems {
    (measure.pipe(make_rows), filter).chain()
}

/// The facets of a mesh.
#[derive(Clone, Debug)]
pub struct Facets {
    /// The facet of each face, numbered by lowest face.
    pub of_face: Vec<u32>,
    /// What each facet is: area, tensor, curvature.
    pub samples: Vec<Sample>,
}

/// Finds facets: faces connected over regular edges that are not sharp and turn by less than `flat`
/// radians. The tensor of a facet is that of its faces over its area, sharp edges left out; its
/// curvature is taken across its mean normal.
pub fn find_facets(bending: &Bending, flat: f64) -> Facets {
    let mut sets = Sets::new(bending.shapes.len());
    for edge in 0..bending.angles.len() {
        if !bending.sharp[edge].0
            && bending.angles[edge].0.abs() < flat
            && let Some([a, b]) = bending.topology.face_pair(edge)
        {
            sets.unite(a, b);
        }
    }
    let (of_face, count) = sets.numbered();

    let tensors: Vec<Smooth> = face_tensors(bending);
    let mut sums = vec![FacetSum::default(); count];
    for ((&facet, tensor), shape) in of_face.iter().zip(&tensors).zip(bending.shapes) {
        sums[facet as usize].add(tensor, shape);
    }
    let samples = sums.par_iter().with_min_len(2048);
    Facets {
        of_face,
        samples: samples.map(FacetSum::sample).collect(),
    }
}

/// What the faces of a facet come to together.
#[derive(Clone, Default)]
pub(crate) struct FacetSum {
    tensor: SymmetricTensor,
    normal: DVec3,
    area: f64,
}

impl FacetSum {
    pub(crate) fn add(&mut self, tensor: &Smooth, shape: &FaceShape) {
        add_scaled(&mut self.tensor, &tensor.0, 1.0);
        self.normal += shape.normal * shape.area;
        self.area += shape.area;
    }

    pub(crate) fn sample(&self) -> Sample {
        let tensor = over(&self.tensor, self.area);
        let frame = tangent_principal_frame(&tensor, self.normal.normalize_or_zero());
        Sample {
            area: self.area,
            curvature: frame.k.feature(),
            tensor,
            d_min: frame.d_min.as_vec3().to_array(),
            vertex: NONE,
        }
    }
}

fn measure(settings: Res<FacetSettings>, columns: BendingColumns) -> Facets {
    find_facets(&columns.lend(), settings.flat_deg.to_radians())
}

fn make_rows(In(facets): In<Facets>, world: &mut World) {
    rows::resize::<Samples>(world, facets.samples.len());
    rows::column_mut(world).copy_from_slice(&facets.samples);
    for (row, facet) in rows::column_mut::<FaceSample>(world)
        .iter_mut()
        .zip(facets.of_face)
    {
        row.0 = facet;
    }
    world
        .resource_mut::<Counts>()
        .note(Stage::Curvature, "samples", facets.samples.len());
}

fn filter(
    settings: Res<FacetSettings>,
    topology: Res<MeshTopology>,
    sharp: Column<SharpEdge>,
    facet_of_face: Column<FaceSample>,
    mut samples: ColumnMut<Sample>,
    mut features: ColumnMut<SampleFeature>,
) {
    let samples = &mut samples[..];
    filter_curvatures(&settings, &topology.0, &sharp, &facet_of_face, samples);
    for (feature, sample) in features.iter_mut().zip(samples) {
        *feature = facet_feature(&settings, sample);
    }
}

/// What is compared of a facet: `ln(1 + c / barely_curved)`, so that a ratio of radii counts alike at any
/// size.
pub fn facet_feature(settings: &FacetSettings, sample: &Sample) -> SampleFeature {
    SampleFeature::rounded(
        sample
            .curvature
            .map(|c| (c / settings.barely_curved).ln_1p()),
    )
}

/// The median filter, `median_rounds` times, all facets at once in each.
pub fn filter_curvatures(
    settings: &FacetSettings,
    topology: &Topology,
    sharp: &[SharpEdge],
    facet_of_face: &[FaceSample],
    samples: &mut [Sample],
) {
    let pairs = smooth_neighbours(topology, sharp, facet_of_face);
    for _ in 0..settings.median_rounds {
        median_filter(&pairs, settings.similar_area_share, samples);
    }
}

/// Pairs of facets that touch along an edge that is not sharp, each in both orders, sorted, once.
fn smooth_neighbours(
    topology: &Topology,
    sharp: &[SharpEdge],
    facet_of_face: &[FaceSample],
) -> Vec<[u32; 2]> {
    let mut pairs: Vec<[u32; 2]> = Vec::new();
    for (edge, sharp) in sharp.iter().enumerate() {
        let Some([a, b]) = topology.face_pair(edge) else {
            continue;
        };
        let [a, b] = [a, b].map(|face| facet_of_face[face as usize].0);
        if !sharp.0 && a != b {
            pairs.extend([[a, b], [b, a]]);
        }
    }
    pairs.par_sort_unstable();
    pairs.dedup();
    pairs
}

/// Each curvature becomes the median, component by component, of the facet's own and those of its
/// neighbours of similar area; facets with fewer than two such neighbours keep theirs. Irregular
/// tessellations scatter a cone's facets over a factor of 40; a median keeps edges where a mean blurs them.
fn median_filter(pairs: &[[u32; 2]], similar: f64, samples: &mut [Sample]) {
    let filtered: Vec<(u32, [f64; 2])> = pairs
        .chunk_by(|a, b| a[0] == b[0])
        .collect::<Vec<_>>()
        .into_par_iter()
        .with_min_len(512)
        .filter_map(|row| {
            let own = &samples[row[0][0] as usize];
            let others = row.iter().map(|pair| &samples[pair[1] as usize]);
            let alike = others.filter(|other| are_alike(own, other, similar));
            let values = alike.map(|other| other.curvature).collect();
            Some((row[0][0], filtered(own.curvature, values)?))
        })
        .collect();
    for (facet, curvature) in filtered {
        samples[facet as usize].curvature = curvature;
    }
}

/// Do areas let one facet take part in the median of the other?
pub(crate) fn are_alike(one: &Sample, other: &Sample, similar: f64) -> bool {
    one.area.min(other.area) > similar * one.area.max(other.area)
}

/// The median of a facet's own curvature and those of its neighbours, if they are enough.
pub(crate) fn filtered(own: [f64; 2], mut neighbours: Vec<[f64; 2]>) -> Option<[f64; 2]> {
    if neighbours.len() < 2 {
        return None;
    }
    neighbours.push(own);
    Some([0, 1].map(|k| median(neighbours.iter().map(|v| v[k]).collect())))
}

/// The middle value; of an even number, the mean of the two in the middle.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let half = values.len() / 2;
    if values.len() % 2 == 1 {
        values[half]
    } else {
        (values[half - 1] + values[half]) / 2.0
    }
}
