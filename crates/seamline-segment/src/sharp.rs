//! Sharp edges and vertices (paper 4.1).

use bevy_ecs::prelude::*;
use rayon::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::{DihedralAngle, FaceShape, Position, SharpEdge, SharpVertex};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{Column, ColumnMut, Counts, MeshTopology, Stage, StageSystems};
use seamline_mesh::{EdgeKind, Topology};
use serde::{Deserialize, Serialize};

/// The `[sharp]` table.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SharpSettings {
    /// An edge is sharp if its faces turn by more than this. Must exceed the tessellator's angular step
    /// (30 degrees on a 12-gon); Fandisk does not care between 25 and 60.
    pub angle_deg: f64,
    /// Split triangles with three sharp vertices about their centre while segmenting (paper 4.1). Only
    /// where curvature lies on vertices.
    pub enrich: bool,
}

impl StepSettings for SharpSettings {
    const TABLE: &'static str = "sharp";

    fn defaults(profile: Profile) -> Self {
        Self {
            angle_deg: 40.0,
            enrich: profile == Profile::Lavoue2005,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            self.angle_deg > 0.0 && self.angle_deg < 180.0,
            "angle_deg",
            "an angle above 0 and below 180 degrees",
        )
    }
}

/// Angles come out of coordinates with a few ulps of error.
const ROUNDING: f64 = 1e-9;

pub(crate) fn systems() -> StageSystems {
    (measure_angles, mark_sharp).chain().in_set(Stage::Sharp)
}

fn measure_angles(
    topology: Res<MeshTopology>,
    positions: Column<Position>,
    shapes: Column<FaceShape>,
    mut angles: ColumnMut<DihedralAngle>,
) {
    dihedral_angles(&topology.0, &positions, &shapes, &mut angles);
}

fn mark_sharp(
    settings: Res<SharpSettings>,
    topology: Res<MeshTopology>,
    angles: Column<DihedralAngle>,
    mut edges: ColumnMut<SharpEdge>,
    mut vertices: ColumnMut<SharpVertex>,
    mut counts: ResMut<Counts>,
) {
    let edges = &mut edges[..];
    let vertices = &mut vertices[..];
    sharp_edges(&topology.0, &angles, settings.angle_deg.to_radians(), edges);
    sharp_vertices(&topology.0, edges, vertices);
    counts.note(
        Stage::Sharp,
        "sharp_edges",
        edges.iter().filter(|e| e.0).count(),
    );
    counts.note(
        Stage::Sharp,
        "sharp_vertices",
        vertices.iter().filter(|v| v.0).count(),
    );
}

/// Signed dihedral angle of every edge in radians: positive where the surface is convex, 0 where it is
/// flat; 0 at borders and non-manifold edges. Where two faces run along the edge in the same direction one
/// of them is taken as turned round.
pub fn dihedral_angles(
    topology: &Topology,
    positions: &[Position],
    shapes: &[FaceShape],
    angles: &mut [DihedralAngle],
) {
    angles
        .par_iter_mut()
        .enumerate()
        .with_min_len(4096)
        .for_each(|(edge, angle)| {
            angle.0 = topology.face_pair(edge).map_or(0.0, |[a, b]| {
                let [from, to] = topology.edge_vertices[edge];
                let along = positions[to as usize].0 - positions[from as usize].0;
                let along = if runs_along(topology, a, from, to) {
                    along
                } else {
                    -along
                };
                let na = shapes[a as usize].normal;
                let nb = match topology.edge_kind[edge] {
                    EdgeKind::Flipped => -shapes[b as usize].normal,
                    _ => shapes[b as usize].normal,
                };
                na.cross(nb)
                    .dot(along.normalize_or_zero())
                    .atan2(na.dot(nb))
            });
        });
}

fn runs_along(topology: &Topology, face: u32, from: u32, to: u32) -> bool {
    let [a, b, c] = topology.triangles[face as usize];
    [(a, b), (b, c), (c, a)].contains(&(from, to))
}

/// An edge is sharp if its faces turn by more than `limit` radians, or if it is no regular edge. A turn of
/// just `limit`, as between the sides of a 9-gon at 40 degrees, is not more, however it is rounded.
pub fn sharp_edges(
    topology: &Topology,
    angles: &[DihedralAngle],
    limit: f64,
    sharp: &mut [SharpEdge],
) {
    for ((sharp, angle), kind) in sharp.iter_mut().zip(angles).zip(&topology.edge_kind) {
        sharp.0 = *kind != EdgeKind::Regular || angle.0.abs() > limit + ROUNDING;
    }
}

/// A vertex is sharp if one of its edges is.
pub fn sharp_vertices(topology: &Topology, edges: &[SharpEdge], vertices: &mut [SharpVertex]) {
    vertices.fill(SharpVertex(false));
    for (edge, ends) in edges.iter().zip(&topology.edge_vertices) {
        if edge.0 {
            for &end in ends {
                vertices[end as usize].0 = true;
            }
        }
    }
}
