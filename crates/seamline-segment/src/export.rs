//! Export: finished patches, their boundaries, and curvature in the file's own unit.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use rayon::prelude::*;
use seamline_ecs::components::*;
use seamline_ecs::results::{Boundary, PatchReport, PatchSummary, Segmentation, VertexQuantities};
use seamline_ecs::rows::{self, Patches};
use seamline_ecs::{
    Column, ColumnMut, Counts, GivenBoundary, InputMesh, MeshScale, OpenEnd, OpenEnds,
    PipelineKind, Stage, StageSystems, Told,
};
use seamline_mesh::{EdgeKind, Findings, Mesh, Topology, examine};

use crate::boundaries::chains;
use crate::changes::{changes, mesh_edge};
use crate::curvature::principal_frames;
use crate::eigen::free_principal_values;
use crate::face_patches::{FacePatches, number_patches};
use crate::facets;
use crate::refine::{RefinedRows, refine_boundaries};
use crate::refined::refined_mesh;
use crate::spatial_order::SpatialOrder;
use crate::surfaces::{SurfaceSettings, patch_surfaces};
use crate::tensor::{
    Bending, BendingColumns, Smooth, TensorForm, face_tensors, over, vertex_tensors,
};

/// With `refines` boundaries may run through triangles; with `measures` facets are measured where nothing has needed
/// them before.
pub(crate) fn systems(refines: bool, measures: bool) -> StageSystems {
    let mut export = number.pipe(collect).pipe(make_rows).into_configs();
    if measures {
        export = (facets::systems().run_if(facets_are_missing), export).chain();
    }
    if refines {
        export = (refine_boundaries, export).chain();
    }
    export.in_set(Stage::Export)
}

fn facets_are_missing(told: Res<Told>, facet_of_face: Column<FaceSample>) -> bool {
    let first = facet_of_face.first();
    told.patch_curvature && first.is_some_and(|facet| facet.0 == NONE)
}

fn number(
    mesh: Res<InputMesh>,
    order: Res<SpatialOrder>,
    shapes: Column<FaceShape>,
    mut labels: ColumnMut<FaceLabel>,
) -> FacePatches {
    number_patches(&mesh.0, &order, &shapes, &mut labels)
}

fn collect(
    In(patches): In<FacePatches>,
    mesh: Res<InputMesh>,
    order: Res<SpatialOrder>,
    scale: Res<MeshScale>,
    columns: BendingColumns,
    sharp_vertices: Column<SharpVertex>,
    facet_of_face: Column<FaceSample>,
    samples: Column<Sample>,
    labels: Column<FaceLabel>,
    face_surfaces: Column<FaceSurface>,
    surfaces: Column<Surface>,
    looked_for: Res<SurfaceSettings>,
    given: GivenColumns,
    told: Res<Told>,
) -> Segmentation {
    let bending = columns.lend();
    let curvatures = if told.patch_curvature {
        face_curvatures(&bending, &facet_of_face, &samples)
    } else {
        vec![Principal::default(); labels.len()]
    };
    let rows = LabelledRows {
        bending,
        order: &order,
        sharp_vertices: &sharp_vertices,
        curvatures: &curvatures,
        labels: &labels,
        length: scale.length,
        turned: order.turned,
        given: given.lend(),
    };
    let found = looked_for.enabled.then(|| {
        let shapes = rows.bending.shapes;
        patch_surfaces(patches.count, &labels, shapes, &face_surfaces, &surfaces)
    });
    let mut segmentation = describe(&mesh.0, &rows, patches, told.vertex_curvature);
    for (patch, surface) in segmentation
        .patches
        .iter_mut()
        .zip(found.into_iter().flatten())
    {
        patch.surface = Some(surface);
    }
    segmentation
}

/// What was given to be rectified, and what became of it.
#[derive(SystemParam)]
struct GivenColumns<'w, 's> {
    kind: Res<'w, PipelineKind>,
    boundary: Res<'w, GivenBoundary>,
    contours: Column<'w, 's, ContourState>,
    open_ends: Res<'w, OpenEnds>,
    refined: Res<'w, RefinedRows>,
}

impl GivenColumns<'_, '_> {
    fn lend(&self) -> Option<Given<'_>> {
        (*self.kind == PipelineKind::Rectify).then_some(Given {
            edges: &self.boundary.edges,
            at_borders: self.boundary.at_borders,
            contours: &self.contours,
            open_ends: &self.open_ends.0,
            refined: (!self.refined.triangles.is_empty()).then_some(&*self.refined),
        })
    }
}

/// Boundaries that were given to be rectified.
#[derive(Clone, Copy)]
pub struct Given<'a> {
    /// The edges they ran along, rising.
    pub edges: &'a [u32],
    /// How many edges were given besides, on borders and non-manifold edges.
    pub at_borders: usize,
    /// What has become of each edge of the mesh.
    pub contours: &'a [ContourState],
    /// What has become of the open ends.
    pub open_ends: &'a [OpenEnd],
    /// The mesh whose triangles boundaries run through, if they may.
    pub refined: Option<&'a RefinedRows>,
}

/// A finished mesh in rows.
pub struct LabelledRows<'a> {
    /// Geometry.
    pub bending: Bending<'a>,
    /// Which row holds what.
    pub order: &'a SpatialOrder,
    /// One a vertex.
    pub sharp_vertices: &'a [SharpVertex],
    /// One a face ([`face_curvatures`]).
    pub curvatures: &'a [Principal],
    /// The patch of each face.
    pub labels: &'a [FaceLabel],
    /// The scale ([`MeshScale`]).
    pub length: f64,
    /// Are there triangles whose corners run the other way in the mesh itself ([`crate::turned_faces`])?
    pub turned: bool,
    /// The boundaries given, where they were to be rectified.
    pub given: Option<Given<'a>>,
}

/// Everything told of finished patches, by the mesh's own vertices and in its own unit. Curvature at vertices is told
/// only with `vertex_curvature`.
pub fn describe(
    mesh: &Mesh,
    rows: &LabelledRows,
    patches: FacePatches,
    vertex_curvature: bool,
) -> Segmentation {
    let boundaries = boundaries(rows);
    let summaries = summaries(rows, &patches);
    let vertices = vertex_curvature.then(|| vertex_quantities(rows));
    let refined = rows.given.and_then(|given| given.refined);
    Segmentation {
        face_patches: patches.of_face,
        patches: with_neighbours(summaries, &boundaries),
        boundaries,
        refined: refined.map(|refined| refined_mesh(mesh, rows, refined, vertices.as_ref())),
        vertices: vertices.unwrap_or_default(),
        changes: rows.given.map(|given| changes(rows, given)),
        findings: findings(mesh, rows.bending.topology, rows.turned),
        stages: Vec::new(),
    }
}

/// What the mesh is as it came, triangles that are there twice or turned inside out included.
fn findings(mesh: &Mesh, rows: &Topology, turned: bool) -> Findings {
    if rows.triangles.len() == mesh.triangles.len() && !turned {
        return examine(mesh, rows);
    }
    examine(
        mesh,
        &Topology::build(mesh.positions().len(), mesh.triangles.clone()),
    )
}

fn make_rows(In(segmentation): In<Segmentation>, world: &mut World) {
    rows::resize::<Patches>(world, segmentation.patches.len());
    for (row, patch) in rows::column_mut::<Patch>(world)
        .iter_mut()
        .zip(&segmentation.patches)
    {
        row.0 = patch.summary;
    }
    let mut counts = world.resource_mut::<Counts>();
    counts.note(Stage::Export, "patches", segmentation.patches.len());
    counts.note(Stage::Export, "boundaries", segmentation.boundaries.len());
    world.insert_resource(segmentation);
}

/// Principal curvatures of each face: those of its facet after filtering, where facets carry curvature,
/// else those of its own tensor, sharp edges left out.
pub fn face_curvatures(
    bending: &Bending,
    facet_of_face: &[FaceSample],
    samples: &[Sample],
) -> Vec<Principal> {
    let carried = facet_of_face.first().is_some_and(|facet| facet.0 != NONE);
    if carried {
        let signed = |sample: &Sample| {
            let sign = free_principal_values(&sample.tensor).k_min.signum();
            let [k_min, k_max] = sample.curvature;
            Principal {
                k_min: k_min * sign,
                k_max,
            }
        };
        let of_facet: Vec<_> = samples.par_iter().with_min_len(2048).map(signed).collect();
        return facet_of_face
            .iter()
            .map(|facet| of_facet[facet.0 as usize])
            .collect();
    }
    let tensors: Vec<Smooth> = face_tensors(bending);
    let own = tensors.par_iter().zip(bending.shapes).with_min_len(2048);
    own.map(|(tensor, shape)| free_principal_values(&over(&tensor.0, shape.area)))
        .collect()
}

/// Curvature at every vertex for display, by the `ring` form with sharp edges left out: exact on prisms,
/// and not blurred by creases.
fn vertex_quantities(rows: &LabelledRows) -> VertexQuantities {
    let tensors: Vec<Smooth> = vertex_tensors(&rows.bending, TensorForm::Ring, 0.0);
    let frames = principal_frames(&rows.bending, rows.sharp_vertices, &tensors, |it| &it.0);
    let count = frames.len();
    let mut quantities = VertexQuantities {
        k_min: vec![0.0; count],
        k_max: vec![0.0; count],
        d_min: vec![[0.0; 3]; count],
        d_max: vec![[0.0; 3]; count],
    };
    for (&vertex, frame) in rows.order.vertex_of_row.iter().zip(frames) {
        let vertex = vertex as usize;
        quantities.k_min[vertex] = (frame.k.k_min / rows.length) as f32;
        quantities.k_max[vertex] = (frame.k.k_max / rows.length) as f32;
        quantities.d_min[vertex] = frame.d_min.as_vec3().to_array();
        quantities.d_max[vertex] = frame.d_max.as_vec3().to_array();
    }
    quantities
}

/// Where two patches touch, by pairs of ids.
fn boundaries(rows: &LabelledRows) -> Vec<Boundary> {
    let LabelledRows {
        bending,
        labels,
        length,
        ..
    } = rows;
    let topology = bending.topology;
    let mut edges: Vec<([u32; 2], u32)> = Vec::new();
    let mut crowded: Vec<(u32, u32)> = Vec::new();
    for (face, around) in topology.face_edges.iter().enumerate() {
        let non_manifold = |e: &&u32| topology.edge_kind[**e as usize] == EdgeKind::NonManifold;
        crowded.extend(
            around
                .iter()
                .filter(non_manifold)
                .map(|&edge| (edge, labels[face].0)),
        );
    }
    crowded.sort_unstable();
    crowded.dedup();
    for patches in crowded.chunk_by(|a, b| a.0 == b.0) {
        for (i, &(edge, a)) in patches.iter().enumerate() {
            edges.extend(patches[i + 1..].iter().map(|&(_, b)| ([a, b], edge)));
        }
    }
    for edge in 0..topology.edge_faces.len() {
        let Some(faces) = topology.face_pair(edge) else {
            continue;
        };
        let [a, b] = faces.map(|face| labels[face as usize].0);
        if a != b {
            edges.push(([a.min(b), a.max(b)], edge as u32));
        }
    }
    edges.par_sort_unstable();
    edges
        .chunk_by(|a, b| a.0 == b.0)
        .map(|common| {
            let lengths = common.iter().map(|&(_, e)| bending.along(e).length());
            let whole: f64 = lengths.clone().sum();
            let sharp: f64 = lengths
                .zip(common)
                .filter(|(_, (_, e))| bending.sharp[*e as usize].0)
                .map(|(length, _)| length)
                .sum();
            let is_added = |edge: u32| {
                rows.given
                    .is_some_and(|given| given.edges.binary_search(&edge).is_err())
            };
            let curves = |added: bool| {
                let wanted = common.iter().filter(|&&(_, e)| is_added(e) == added);
                let ends: Vec<_> = wanted.map(|&(_, e)| mesh_edge(rows, e)).collect();
                chains(&ends)
            };
            Boundary {
                patches: common[0].0,
                length: whole * length,
                sharp_share: if whole > 0.0 { sharp / whole } else { 0.0 },
                polylines: curves(false),
                added: curves(true),
            }
        })
        .collect()
}

/// Area, perimeter and curvature of each patch.
fn summaries(rows: &LabelledRows, patches: &FacePatches) -> Vec<PatchSummary> {
    let LabelledRows {
        bending,
        labels,
        curvatures,
        length,
        ..
    } = rows;
    let mut summaries = vec![PatchSummary::default(); patches.count];
    for &patch in &patches.of_face {
        summaries[patch as usize].faces += 1;
    }
    let topology = bending.topology;
    for (face, edges) in topology.face_edges.iter().enumerate() {
        let patch = &mut summaries[labels[face].0 as usize];
        let (area, k) = (bending.shapes[face].area, curvatures[face]);
        patch.area += area;
        patch.k_min_mean += area * k.k_min;
        patch.k_max_mean += area * k.k_max;
        for &edge in edges {
            let across = topology.neighbour(face as u32, edge);
            if across.is_none_or(|across| labels[across as usize] != labels[face]) {
                patch.perimeter += bending.along(edge).length();
            }
        }
    }
    for patch in summaries.iter_mut().filter(|patch| patch.area > 0.0) {
        patch.k_min_mean /= patch.area;
        patch.k_max_mean /= patch.area;
    }
    for (face, k) in curvatures.iter().enumerate() {
        let patch = &mut summaries[labels[face].0 as usize];
        let area = bending.shapes[face].area;
        patch.k_min_spread += area * (k.k_min - patch.k_min_mean).powi(2);
        patch.k_max_spread += area * (k.k_max - patch.k_max_mean).powi(2);
    }
    for patch in &mut summaries {
        let area = if patch.area > 0.0 { patch.area } else { 1.0 };
        *patch = PatchSummary {
            faces: patch.faces,
            area: patch.area * length * length,
            perimeter: patch.perimeter * length,
            k_min_mean: patch.k_min_mean / length,
            k_min_spread: (patch.k_min_spread / area).sqrt() / length,
            k_max_mean: patch.k_max_mean / length,
            k_max_spread: (patch.k_max_spread / area).sqrt() / length,
        };
    }
    summaries
}

fn with_neighbours(summaries: Vec<PatchSummary>, boundaries: &[Boundary]) -> Vec<PatchReport> {
    let mut neighbours = vec![Vec::new(); summaries.len()];
    for boundary in boundaries {
        let [a, b] = boundary.patches;
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
    }
    let reports = summaries.into_iter().zip(neighbours).enumerate();
    reports
        .map(|(id, (summary, mut neighbours))| {
            neighbours.sort_unstable();
            PatchReport {
                id: id as u32,
                summary,
                surface: None,
                neighbours,
            }
        })
        .collect()
}
