//! Curvature at vertices, and the samples made of it (paper 4.2.1).

use bevy_ecs::prelude::*;
use glam::DVec3;
use rayon::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::*;
use seamline_ecs::rows::{self, Samples};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Column, ColumnMut, Counts, MeshTopology, Stage, StageSystems};
use seamline_mesh::Topology;
use serde::{Deserialize, Serialize};

use crate::eigen::{PrincipalFrame, free_principal_frame, tangent_principal_frame};
use crate::tensor::{
    Bending, BendingColumns, Full, Gathered, TensorForm, TensorPair, vertex_tensor, vertex_tensors,
};

/// What carries the samples of curvature that are classified.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Carrier {
    /// Vertices that are not sharp, as in the paper.
    Vertices,
    /// Facets: flat pieces of the tessellation, such as one strip of a cylinder.
    Facets,
}

/// The `[curvature]` table.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurvatureSettings {
    /// What carries the samples: `vertices` (paper) or `facets`.
    pub carrier: Carrier,
    /// How a vertex gathers curvature, where vertices carry it: `spokes`, `cell`, `ring` or `ball`.
    pub tensor: TensorForm,
    /// Radius of the ball for `tensor = "ball"`, in units of the scaled mesh (0.01: a hundredth of the
    /// part's size).
    pub ball_radius: f64,
}

impl StepSettings for CurvatureSettings {
    const TABLE: &'static str = "curvature";

    fn defaults(profile: Profile) -> Self {
        let carrier = match profile {
            Profile::Cad => Carrier::Facets,
            Profile::Lavoue2005 => Carrier::Vertices,
        };
        Self {
            carrier,
            tensor: TensorForm::Spokes,
            ball_radius: 0.01,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.ball_radius > 0.0 && self.ball_radius <= 0.5,
            "ball_radius",
            "a radius above 0 and at most 0.5 (half the part)",
        )
    }
}

pub(crate) fn systems() -> StageSystems {
    (measure_vertices, gather_samples)
        .chain()
        .in_set(Stage::Curvature)
}

/// Fills the curvature columns of all vertices.
fn measure_vertices(
    settings: Res<CurvatureSettings>,
    columns: BendingColumns,
    sharp_vertices: Column<SharpVertex>,
    mut full: ColumnMut<VertexCurvature>,
    mut smooth: ColumnMut<SmoothCurvature>,
) {
    let bending = columns.lend();
    let tensors = vertex_tensors(&bending, settings.tensor, settings.ball_radius);
    let frames = |pick: fn(&TensorPair) -> &SymmetricTensor| {
        principal_frames(&bending, &sharp_vertices, &tensors, pick)
    };
    write_down(frames(|t| &t.full), &mut full);
    for (to, frame) in smooth.iter_mut().zip(frames(|t| &t.smooth)) {
        to.0 = frame.k;
    }
}

/// Fills the column the boundary score looks at, and no other.
pub(crate) fn measure_vertices_for_score(
    settings: Res<CurvatureSettings>,
    columns: BendingColumns,
    sharp_vertices: Column<SharpVertex>,
    mut full: ColumnMut<VertexCurvature>,
) {
    let bending = columns.lend();
    let tensors: Vec<Full> = vertex_tensors(&bending, settings.tensor, settings.ball_radius);
    let frames = principal_frames(&bending, &sharp_vertices, &tensors, |it| &it.0);
    write_down(frames, &mut full);
}

fn write_down(frames: Vec<PrincipalFrame>, to: &mut [VertexCurvature]) {
    for (to, frame) in to.iter_mut().zip(frames) {
        *to = curvature_of(frame);
    }
}

/// Principal frames of all vertices: in the tangent plane where there is one, free at sharp vertices.
pub(crate) fn principal_frames<T: Gathered>(
    bending: &Bending,
    sharp: &[SharpVertex],
    tensors: &[T],
    pick: fn(&T) -> &SymmetricTensor,
) -> Vec<PrincipalFrame> {
    tensors
        .par_iter()
        .enumerate()
        .with_min_len(2048)
        .map(|(v, pair)| principal_frame(bending, sharp[v].0, pick(pair), v as u32))
        .collect()
}

fn principal_frame(
    bending: &Bending,
    sharp: bool,
    tensor: &SymmetricTensor,
    vertex: u32,
) -> PrincipalFrame {
    if sharp {
        return free_principal_frame(tensor);
    }
    let Bending {
        topology,
        positions,
        shapes,
        ..
    } = bending;
    tangent_principal_frame(tensor, vertex_normal(topology, positions, shapes, vertex))
}

/// Curvature of one vertex, with every edge counted.
pub(crate) fn vertex_curvature(
    settings: &CurvatureSettings,
    bending: &Bending,
    vertex: u32,
) -> VertexCurvature {
    let around = bending.topology.vertex_edges.row(vertex as usize);
    let sharp = around.iter().any(|&edge| bending.sharp[edge as usize].0);
    let tensor: Full = vertex_tensor(bending, settings.tensor, settings.ball_radius, vertex);
    curvature_of(principal_frame(bending, sharp, &tensor.0, vertex))
}

fn curvature_of(frame: PrincipalFrame) -> VertexCurvature {
    VertexCurvature {
        k: frame.k,
        d_min: frame.d_min,
        d_max: frame.d_max,
    }
}

/// Unit normal of a vertex: the normals of its faces, weighted by their angles at it. Zero where they
/// cancel out or there are none.
fn vertex_normal(
    topology: &Topology,
    positions: &[Position],
    shapes: &[FaceShape],
    v: u32,
) -> DVec3 {
    let here = positions[v as usize].0;
    let mut sum = DVec3::ZERO;
    for &face in topology.vertex_faces.row(v as usize) {
        let [a, b] =
            others(topology.triangles[face as usize], v).map(|w| positions[w as usize].0 - here);
        let angle = a.cross(b).length().atan2(a.dot(b));
        sum += shapes[face as usize].normal * angle;
    }
    sum.normalize_or_zero()
}

fn others([a, b, c]: [u32; 3], v: u32) -> [u32; 2] {
    if a == v {
        [b, c]
    } else if b == v {
        [c, a]
    } else {
        [a, b]
    }
}

/// One sample a vertex that is used and not sharp, in vertex order.
fn gather_samples(world: &mut World) {
    let used = {
        let topology = &world.resource::<MeshTopology>().0;
        (0..topology.vertex_faces.row_count())
            .map(|v| !topology.vertex_faces.row(v).is_empty())
            .collect::<Vec<_>>()
    };
    let sharp: Vec<bool> = rows::column_mut::<SharpVertex>(world)
        .iter()
        .map(|s| s.0)
        .collect();
    let directions: Vec<[f32; 3]> = rows::column_mut::<VertexCurvature>(world)
        .iter()
        .map(|curvature| curvature.d_min.as_vec3().to_array())
        .collect();
    let samples: Vec<Sample> = rows::column_mut::<SmoothCurvature>(world)
        .iter()
        .enumerate()
        .filter(|&(v, _)| used[v] && !sharp[v])
        .map(|(v, k)| Sample {
            curvature: k.0.feature(),
            d_min: directions[v],
            vertex: v as u32,
            ..Sample::default()
        })
        .collect();
    rows::resize::<Samples>(world, samples.len());
    for (feature, sample) in rows::column_mut::<SampleFeature>(world)
        .iter_mut()
        .zip(&samples)
    {
        *feature = SampleFeature::rounded(sample.curvature);
    }
    rows::column_mut(world).copy_from_slice(&samples);
    rows::column_mut(world).fill(FaceSample(NONE));
    world
        .resource_mut::<Counts>()
        .note(Stage::Curvature, "samples", samples.len());
}
