//! The built-in steps of the method, in the order a mesh meets them.
//!
//! Lavoué, Dupont, Baskurt: "A new CAD mesh segmentation method, based on curvature tensor analysis",
//! Computer-Aided Design 37 (2005). Each file is one step: a pure kernel on slices, the thin system that
//! lends it its columns, and its settings. Classifying and rectifying are left to plugins.

mod adopt;
mod ball;
mod boundaries;
mod changes;
mod curvature;
mod eigen;
mod enrich;
mod export;
mod face_patches;
mod face_shape;
mod facets;
mod grow;
mod hard_edges;
mod import;
mod merge;
mod on_demand;
mod orient;
mod reduction;
mod refine;
mod refined;
mod region_graph;
mod rounding;
mod score;
mod sharp;
mod spatial_order;
mod surfaces;
mod tensor;
mod threshold;

use std::sync::Arc;

use bevy_ecs::prelude::*;
use seamline_ecs::settings::{SettingsError, SettingsTable, StepSettings, read};
use seamline_ecs::{BuiltinSteps, InstallStep, PipelineKind, PipelineSettings, Stage};
use toml::Table;

pub use adopt::{adopt_edges, adopt_labels};
pub use boundaries::chains;
pub use curvature::{Carrier, CurvatureSettings};
pub use eigen::{PrincipalFrame, free_principal_frame, tangent_principal_frame};
pub use export::{Given, LabelledRows, describe, face_curvatures};
pub use face_patches::{FacePatches, number_patches};
pub use face_shape::face_shapes;
pub use facets::{FacetSettings, Facets, facet_feature, filter_curvatures, find_facets};
pub use grow::{Grown, grow_facets, grow_pure_triangles};
pub use hard_edges::{HardEdgeSettings, hard_edges};
pub use import::{Laid, MeshSettings, ScaleBy, lay_out};
pub use merge::{MergeSettings, RegionDistance};
pub use orient::turned_faces;
pub use reduction::{Reduced, reduce};
pub use refine::{RefineSettings, RefinedRows, refine};
pub use region_graph::{Link, Merged, RegionGraph};
pub use score::{ScoreSettings, angle_score, curvature_score, facet_scores, vertex_scores};
pub use sharp::{SharpSettings, dihedral_angles, sharp_edges, sharp_vertices};
pub use spatial_order::SpatialOrder;
pub use surfaces::{SurfaceSettings, patch_surfaces};
pub use tensor::{
    Bending, Full, Gathered, Smooth, TensorForm, TensorPair, edge_tensor, face_tensors,
    vertex_tensors,
};
pub use threshold::{Threshold, widest_gap};

/// The built-in steps and their tables of settings.
pub fn builtin_steps() -> BuiltinSteps {
    BuiltinSteps {
        tables: vec![
            SettingsTable::of::<MeshSettings>(),
            SettingsTable::of::<SharpSettings>(),
            SettingsTable::of::<HardEdgeSettings>(),
            SettingsTable::of::<SurfaceSettings>(),
            SettingsTable::of::<CurvatureSettings>(),
            SettingsTable::of::<FacetSettings>(),
            SettingsTable::of::<MergeSettings>(),
            SettingsTable::of::<ScoreSettings>(),
            SettingsTable::of::<RefineSettings>(),
        ],
        with_chosen_classifier: &[(SurfaceSettings::TABLE, "enabled", false)],
        install,
        idle: |kind| match kind {
            PipelineKind::Segment => &[HardEdgeSettings::TABLE, RefineSettings::TABLE],
            PipelineKind::Rectify => &[MergeSettings::TABLE],
        },
    }
}

fn install(in_force: &Table) -> Result<InstallStep, SettingsError> {
    let kind = read::<PipelineSettings>(in_force)?.kind;
    let mesh: MeshSettings = read(in_force)?;
    let sharp: SharpSettings = read(in_force)?;
    let hard_edges: HardEdgeSettings = read(in_force)?;
    let surfaces: SurfaceSettings = read(in_force)?;
    let curvature: CurvatureSettings = read(in_force)?;
    let facets: FacetSettings = read(in_force)?;
    let merge: MergeSettings = read(in_force)?;
    let score: ScoreSettings = read(in_force)?;
    let refine: RefineSettings = read(in_force)?;

    Ok(Arc::new(
        move |world: &mut World, schedule: &mut Schedule| {
            world.insert_resource(kind);
            world.insert_resource(mesh.clone());
            world.insert_resource(sharp.clone());
            world.insert_resource(hard_edges.clone());
            world.insert_resource(SurfaceSettings {
                enabled: surfaces.enabled && kind == PipelineKind::Segment,
                ..surfaces.clone()
            });
            world.insert_resource(RefinedRows::default());
            world.insert_resource(curvature.clone());
            world.insert_resource(facets.clone());
            world.insert_resource(merge.clone());
            world.insert_resource(score.clone());

            schedule.add_systems((import::systems(), face_shape::systems()));
            match kind {
                PipelineKind::Segment => {
                    let enriched = sharp.enrich && curvature.carrier == Carrier::Vertices;
                    if surfaces.enabled {
                        schedule.add_systems(surfaces::systems());
                    }
                    segment(schedule, curvature.carrier, enriched);
                }
                PipelineKind::Rectify => {
                    let evidence = on_demand::evidence(
                        curvature.clone(),
                        facets.clone(),
                        score.clone(),
                        surfaces.clone(),
                    );
                    world.insert_resource(evidence);
                    rectify(schedule, curvature.carrier);
                }
            }
            let refines = refine.enabled && kind == PipelineKind::Rectify;
            let measures = kind == PipelineKind::Rectify && curvature.carrier == Carrier::Facets;
            schedule.add_systems(export::systems(refines, measures));
        },
    ))
}

/// From sharp edges to merged regions.
fn segment(schedule: &mut Schedule, carrier: Carrier, enriched: bool) {
    if enriched {
        schedule.add_systems((sharp::systems(), enrich::systems()).chain());
        schedule.add_systems((merge::systems(), enrich::removal()).chain());
    } else {
        schedule.add_systems((sharp::systems(), merge::systems()));
    }
    match carrier {
        Carrier::Vertices => schedule.add_systems((
            curvature::systems(),
            grow::vertex_systems(),
            score::vertex_systems(),
        )),
        Carrier::Facets => schedule.add_systems((
            facets::systems().in_set(Stage::Curvature),
            grow::facet_systems(),
            score::facet_systems(),
        )),
    };
}

/// From sharp edges to what was given. Curvature is measured for the scores alone.
fn rectify(schedule: &mut Schedule, carrier: Carrier) {
    schedule.add_systems((sharp::systems(), adopt::no_samples(), adopt::systems()));
    schedule.add_systems(match carrier {
        Carrier::Vertices => score::vertex_systems(),
        Carrier::Facets => score::measured_facet_systems(),
    });
}
