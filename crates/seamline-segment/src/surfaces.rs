//! Surfaces the vertices lie on exactly. Where they explain a mesh, its patches follow from them, and what the
//! classifier says is not asked.

use bevy_ecs::prelude::*;
use glam::DVec3;
use schemars::JsonSchema;
use seamline_ecs::components::*;
use seamline_ecs::results::{PatchSurface, SurfaceShape};
use seamline_ecs::rows::{self, Surfaces};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{
    Column, ColumnMut, Counts, InputMesh, LabelledMesh, Measures, MeshScale, MeshTopology, Settled,
    Stage, StageSystems,
};
use seamline_mesh::{Mesh, Topology};
use seamline_primitives::{Fitted, Found, Kind, LEAST_EXACT_OF_NOISY, find};
use serde::{Deserialize, Serialize};

use crate::grow::{Grown, mean_curvatures};

/// The `[surfaces]` table: planes, cylinders, cones, spheres and tori the vertices lie on.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceSettings {
    /// Are surfaces looked for? Where surfaces explain a mesh no classifier is
    /// asked: so not by default where a classifier other than the default one is chosen. In `rectify`: are labels held
    /// against them where their boundaries are rough?
    pub enabled: bool,
    /// Share of the area that must lie exactly on surfaces for the patches to follow from them; below it curvature leads
    /// (noise, scans, natural shapes). The least of the bench is .06, a loft between two flat ends; a coil spring of one
    /// spline has less, scans have 0. Where all vertices lie on smooth free forms and next to nothing (.005) on
    /// surfaces, the patches are these forms, whatever this is.
    pub least_exact_share: f64,
    /// The same share where vertices are noisy, of what lies on surfaces as exactly as the noise allows. Where that is
    /// below .15, smooth free forms go first, whatever this is.
    pub least_exact_share_of_noisy: f64,
}

impl StepSettings for SurfaceSettings {
    const TABLE: &'static str = "surfaces";

    fn defaults(profile: Profile) -> Self {
        Self {
            enabled: profile == Profile::Cad,
            least_exact_share: 0.05,
            least_exact_share_of_noisy: LEAST_EXACT_OF_NOISY,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (0.0..=1.0).contains(&self.least_exact_share),
            "least_exact_share",
            "a share of the whole area from 0 to 1",
        )?;
        OutOfRange::unless(
            (0.0..=1.0).contains(&self.least_exact_share_of_noisy),
            "least_exact_share_of_noisy",
            "a share of the whole area from 0 to 1",
        )
    }
}

impl SurfaceSettings {
    /// Do the surfaces found explain the mesh?
    fn explains(&self, found: &Found) -> bool {
        let least = if found.noise > 0.0 {
            self.least_exact_share_of_noisy
        } else {
            self.least_exact_share
        };
        found.smooth || found.exact_share >= least
    }
}

pub(crate) fn systems() -> StageSystems {
    look.pipe(make_rows).in_set(Stage::Surfaces)
}

fn look(
    topology: Res<MeshTopology>,
    mesh: Res<InputMesh>,
    scale: Res<MeshScale>,
    positions: Column<Position>,
) -> Found {
    let positions: Vec<DVec3> = positions.iter().map(|p| p.0).collect();
    find_stored(&positions, &topology.0, &mesh.0, scale.length)
}

/// Surfaces of a scaled mesh whose vertices are as exact as the file stores them; `length` of the file is 1 of it.
fn find_stored(positions: &[DVec3], topology: &Topology, mesh: &Mesh, length: f64) -> Found {
    let [low, high] = mesh.bounding_box();
    let farthest = low.abs().max(high.abs()).max_element();
    find(positions, topology, farthest / length)
}

/// The surface each face lies on exactly, [`NONE`] where there is none; none at all where they explain too little.
pub(crate) fn exact_surfaces(settings: &SurfaceSettings, mesh: &LabelledMesh<'_>) -> Vec<u32> {
    let positions: Vec<DVec3> = mesh.positions.iter().map(|p| p.0).collect();
    let found = find_stored(&positions, mesh.topology, mesh.mesh, mesh.scale.length);
    if !settings.explains(&found) {
        return Vec::new();
    }
    let is_exact = |surface: &u32| found.surfaces[*surface as usize].is_some_and(|it| it.exact);
    let of_face = found.of_face.iter();
    of_face
        .map(|surface| if is_exact(surface) { *surface } else { NONE })
        .collect()
}

fn make_rows(In(found): In<Found>, world: &mut World) {
    let explains = world.resource::<SurfaceSettings>().explains(&found);
    let scale = *world.resource::<MeshScale>();
    rows::resize::<Surfaces>(world, found.surfaces.len());
    for (row, fitted) in rows::column_mut::<Surface>(world)
        .iter_mut()
        .zip(&found.surfaces)
    {
        row.0 = fitted.map_or(PatchSurface::default(), |f| described(&f, &scale));
    }
    for (row, &surface) in rows::column_mut::<FaceSurface>(world)
        .iter_mut()
        .zip(&found.of_face)
    {
        row.0 = surface;
    }
    let known = found.surfaces.iter().flatten().count();
    world
        .resource_mut::<Counts>()
        .note(Stage::Surfaces, "surfaces", known);
    if found.noise > 0.0 {
        world
            .resource_mut::<Measures>()
            .note(Stage::Surfaces, "noise", found.noise * scale.length);
    }
    world.insert_resource(Settled(explains.then_some(found.of_face)));
}

/// Zero for what arithmetic leaves of it.
fn round_off(x: f64) -> f64 {
    if x.abs() < f64::EPSILON { 0.0 } else { x }
}

/// A surface in the file's unit.
fn described(fitted: &Fitted, scale: &MeshScale) -> PatchSurface {
    let surface = &fitted.surface;
    let point = |x: DVec3| (x * scale.length + scale.centre).to_array();
    let axis = surface.axis.to_array().map(round_off);
    // Of a torus that meets itself the inner part is about the other side of its circle.
    let radius = surface.a.abs() * scale.length;
    let shape = match surface.kind {
        Kind::Plane => SurfaceShape::Plane {
            point: point(surface.point),
            normal: axis,
        },
        Kind::Cylinder => SurfaceShape::Cylinder {
            point: point(surface.point),
            axis,
            radius,
        },
        Kind::Cone => SurfaceShape::Cone {
            apex: point(surface.point - surface.axis * (surface.a / surface.b.tan())),
            axis,
            half_angle_deg: surface.b.to_degrees(),
        },
        Kind::Sphere => SurfaceShape::Sphere {
            centre: point(surface.point),
            radius,
        },
        Kind::Torus => SurfaceShape::Torus {
            centre: point(surface.point),
            axis,
            major_radius: radius,
            minor_radius: surface.b * scale.length,
        },
    };
    let proved = f64::from(fitted.evidence) / (f64::from(fitted.evidence) + 1.0);
    PatchSurface {
        shape,
        concave: (surface.kind != Kind::Plane).then_some(!fitted.convex),
        residual: Some(round_off(fitted.residual) * scale.length),
        confidence: Some(if fitted.exact { proved } else { proved / 2.0 }),
    }
}

/// Regions that are the patches already.
pub(crate) fn regions_of(
    patches: &[u32],
    facet_of_face: &[FaceSample],
    shapes: &[FaceShape],
    samples: &[Sample],
) -> Grown {
    let count = patches.iter().max().map_or(0, |&last| last as usize + 1);
    Grown {
        of_face: patches.to_vec(),
        curvatures: mean_curvatures(patches, count, facet_of_face, shapes, samples),
        cracks: 0,
    }
}

/// Where surfaces explain the mesh, every boundary edge is a good one.
pub(crate) fn settle_scores(
    settled: Res<Settled>,
    topology: Res<MeshTopology>,
    labels: Column<FaceLabel>,
    mut scores: ColumnMut<BoundaryScore>,
) {
    if settled.0.is_none() {
        return;
    }
    for (edge, score) in scores.iter_mut().enumerate() {
        if let Some([a, b]) = topology.0.face_pair(edge)
            && labels[a as usize] != labels[b as usize]
        {
            score.0 = 0.0;
        }
    }
}

/// Share of a patch's area that must lie on one surface for the patch to be told to be it.
const PATCH_SHARE: f64 = 0.9;

/// The surface of each patch: that of most of its area.
pub fn patch_surfaces(
    patch_count: usize,
    labels: &[FaceLabel],
    shapes: &[FaceShape],
    of_face: &[FaceSurface],
    surfaces: &[Surface],
) -> Vec<PatchSurface> {
    let mut shares: Vec<(u32, u32, f64)> = labels
        .iter()
        .zip(of_face)
        .zip(shapes)
        .map(|((label, surface), shape)| (label.0, surface.0, shape.area))
        .collect();
    shares.sort_unstable_by_key(|&(patch, surface, _)| (patch, surface));
    let mut found = vec![PatchSurface::default(); patch_count];
    for patch in shares.chunk_by(|a, b| a.0 == b.0) {
        let area = |faces: &[(u32, u32, f64)]| faces.iter().map(|face| face.2).sum::<f64>();
        let most = patch
            .chunk_by(|a, b| a.1 == b.1)
            .max_by(|a, b| area(a).total_cmp(&area(b)));
        if let Some(most) = most
            && area(most) >= PATCH_SHARE * area(patch)
            && let Some(surface) = surfaces.get(most[0].1 as usize)
        {
            found[patch[0].0 as usize] = surface.0;
        }
    }
    found
}
