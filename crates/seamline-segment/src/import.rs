//! Import: rows for the mesh, its topology, and its scale.

use bevy_ecs::prelude::*;
use glam::DVec3;
use rayon::prelude::*;
use schemars::JsonSchema;
use seamline_ecs::components::Position;
use seamline_ecs::rows::{self, Edges, Faces, Vertices};
use seamline_ecs::settings::{OutOfRange, Profile, StepSettings};
use seamline_ecs::{
    Counts, InputMesh, MeshScale, MeshTopology, Stage, StageSystems, StepError, fallible,
};
use seamline_mesh::{Mesh, Topology};
use serde::{Deserialize, Serialize};

use crate::orient::turned_faces;
use crate::spatial_order::SpatialOrder;

/// The `[mesh]` table: how a mesh is read and scaled.
#[derive(Resource, Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshSettings {
    /// Vertices nearer than this share of the bounding box's diagonal become one. Identical coordinates
    /// always do.
    pub weld_share: f64,
    /// What becomes 1 when the mesh is scaled: curvatures are relative to it.
    pub scale: ScaleBy,
}

/// A length to scale a mesh by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ScaleBy {
    /// The longest side of the bounding box, as in the paper (4.4.3). Depends on how the part lies.
    LongestSide,
    /// The greatest distance between the area's centre and a vertex, doubled. The same however the part
    /// lies.
    Reach,
}

impl StepSettings for MeshSettings {
    const TABLE: &'static str = "mesh";

    fn defaults(profile: Profile) -> Self {
        let scale = match profile {
            Profile::Cad => ScaleBy::Reach,
            Profile::Lavoue2005 => ScaleBy::LongestSide,
        };
        Self {
            weld_share: 0.0,
            scale,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        OutOfRange::unless(
            (0.0..0.1).contains(&self.weld_share),
            "weld_share",
            "a share from 0 to below 0.1",
        )
    }
}

pub(crate) fn systems() -> StageSystems {
    fallible(import).in_set(Stage::Import)
}

fn import(world: &mut World) -> Result<(), StepError> {
    let mesh = world.resource::<InputMesh>().0.clone();
    let by = world.resource::<MeshSettings>().scale;
    let [low, high] = mesh.bounding_box();
    let side = (high - low).max_element();
    if side > 0.0 && !PART_SIZES.contains(&side) {
        return Err(StepError::new(
            format!("the part is {side:e} long"),
            "sizes from 1e-70 to 1e70 can be computed with; export it in another unit",
        ));
    }
    let Laid {
        scale,
        mut order,
        positions,
        triangles,
    } = lay_out(&mesh, by).ok_or_else(|| {
        StepError::new(
            "no face has an area",
            "the mesh needs one triangle at least whose corners do not lie on one line",
        )
    })?;
    let mut topology = Topology::build(positions.len(), triangles);
    let turned = turned_faces(&topology, &positions);
    if !turned.is_empty() {
        for &face in &turned {
            topology.triangles[face as usize].swap(1, 2);
        }
        topology = Topology::build(positions.len(), topology.triangles);
        order.turned = true;
    }
    let [vertices, faces, edges] = topology.counts();
    rows::resize::<Vertices>(world, vertices);
    rows::resize::<Faces>(world, faces);
    rows::resize::<Edges>(world, edges);
    rows::column_mut(world).copy_from_slice(&positions);

    let mut counts = world.resource_mut::<Counts>();
    counts.note(Stage::Import, "vertices", vertices);
    counts.note(Stage::Import, "triangles", faces);
    counts.note(Stage::Import, "edges", edges);
    if !turned.is_empty() {
        counts.note(Stage::Import, "turned_triangles", turned.len());
    }
    world.insert_resource(scale);
    world.insert_resource(order);
    world.insert_resource(MeshTopology(topology));
    Ok(())
}

/// Longest side of the bounding box, in the file's unit: beyond, volumes overflow or vanish.
const PART_SIZES: std::ops::RangeInclusive<f64> = 1e-70..=1e70;

/// A mesh in rows.
#[derive(Clone, Debug)]
pub struct Laid {
    /// From the file's coordinates to the rows'.
    pub scale: MeshScale,
    /// Which row holds what.
    pub order: SpatialOrder,
    /// One a vertex row: scaled, the centre of the bounding box at the origin.
    pub positions: Vec<Position>,
    /// One a face row, between vertex rows.
    pub triangles: Vec<[u32; 3]>,
}

/// Scales a mesh and puts it in spatial order. `None` if it has no area.
pub fn lay_out(mesh: &Mesh, by: ScaleBy) -> Option<Laid> {
    let [low, high] = mesh.bounding_box();
    let side = (high - low).max_element();
    let centre = low + (high - low) / 2.0;
    if side <= 0.0 {
        return None;
    }
    // In box sides, so that coordinates of 1e-12 and of 1e12 lose nothing.
    let unit: Vec<DVec3> = mesh
        .positions()
        .par_iter()
        .map(|&p| (p - centre) / side)
        .collect();
    let (order, triangles) = SpatialOrder::of(&unit, &mesh.triangles);
    let mut positions: Vec<_> = order
        .vertex_of_row
        .iter()
        .map(|&v| Position(unit[v as usize]))
        .collect();
    let reach = reach(&positions, &triangles)?;
    let shrink = match by {
        ScaleBy::LongestSide => 1.0,
        ScaleBy::Reach => 2.0 * reach,
    };
    for position in &mut positions {
        position.0 /= shrink;
    }
    let scale = MeshScale {
        centre,
        length: side * shrink,
    };
    Some(Laid {
        scale,
        order,
        positions,
        triangles,
    })
}

/// The greatest distance of a used vertex from the centre of the area. `None` if there is no area.
fn reach(positions: &[Position], triangles: &[[u32; 3]]) -> Option<f64> {
    let at = |v: u32| positions[v as usize].0;
    let mut area = 0.0;
    let mut moment = DVec3::ZERO;
    for corners in triangles {
        let [a, b, c] = corners.map(at);
        let doubled = (b - a).cross(c - a).length();
        area += doubled;
        moment += (a + b + c) * (doubled / 3.0);
    }
    let middle = moment / area;
    let squared = triangles
        .as_flattened()
        .iter()
        .map(|&v| at(v).distance_squared(middle));
    (area > 0.0).then(|| squared.fold(0.0, f64::max).sqrt())
}
