//! Rows of elements: one archetype a kind, spawned in order, recycled from mesh to mesh.
//!
//! Row `i` of every column of a kind is element `i`. Rows are added and taken away at the tail only, which
//! keeps that true; a fresh world for every mesh would cost three times the whole pipeline (measured).

use std::marker::PhantomData;

use bevy_ecs::bundle::NoBundleEffect;
use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;

use crate::column::whole_mut;
use crate::components::*;

/// A kind of element: the components each of them has.
pub trait ElementKind: Send + Sync + 'static {
    /// All components of the kind.
    type Components: Bundle<Effect: NoBundleEffect> + Default;
}

/// Vertices.
pub struct Vertices;
/// Faces.
pub struct Faces;
/// Edges.
pub struct Edges;
/// Samples of curvature.
pub struct Samples;
/// Surfaces.
pub struct Surfaces;
/// Regions.
pub struct Regions;
/// Patches.
pub struct Patches;

impl ElementKind for Vertices {
    type Components = (Position, SharpVertex, VertexCurvature, SmoothCurvature);
}
impl ElementKind for Faces {
    type Components = (FaceShape, FaceSurface, FaceSample, FaceLabel);
}
impl ElementKind for Edges {
    type Components = (DihedralAngle, SharpEdge, BoundaryScore, ContourState);
}
impl ElementKind for Samples {
    type Components = (SampleFeature, Sample, SampleCluster);
}
impl ElementKind for Surfaces {
    type Components = Surface;
}
impl ElementKind for Regions {
    type Components = Region;
}
impl ElementKind for Patches {
    type Components = Patch;
}

/// The entities of a kind, in mesh order.
#[derive(Resource)]
struct Rows<K: ElementKind> {
    entities: Vec<Entity>,
    kind: PhantomData<K>,
}

/// Makes the world hold `count` elements of a kind, growing or shrinking at the tail. New rows have
/// default components, old ones keep theirs.
pub fn resize<K: ElementKind>(world: &mut World, count: usize) {
    let mut entities = world
        .remove_resource::<Rows<K>>()
        .map(|rows| rows.entities)
        .unwrap_or_default();
    while entities.len() > count {
        if let Some(last) = entities.pop() {
            world.despawn(last);
        }
    }
    if entities.len() < count {
        let missing = count - entities.len();
        entities.extend(world.spawn_batch((0..missing).map(|_| K::Components::default())));
    }
    world.insert_resource(Rows::<K> {
        entities,
        kind: PhantomData,
    });
}

/// The whole column of a component, for steps that hold the world itself because they add or take rows.
///
/// # Panics
///
/// As [`crate::Column`].
pub fn column_mut<T: Component<Mutability = Mutable>>(world: &mut World) -> &mut [T] {
    whole_mut(world.query::<&mut T>().query_mut(world))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Column;
    use bevy_ecs::system::RunSystemOnce;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_keep_mesh_order_however_often_they_grow_and_shrink(
            counts in prop::collection::vec(0usize..50, 1..12),
        ) {
            let mut world = World::new();
            for count in counts {
                resize::<Faces>(&mut world, count);
                resize::<Vertices>(&mut world, count / 2);
                let labels: Vec<_> = (0..count as u32).map(FaceLabel).collect();
                column_mut(&mut world).copy_from_slice(&labels);
                let read = world.run_system_once(|c: Column<FaceLabel>| c.to_vec()).unwrap();
                prop_assert_eq!(read, labels);
            }
        }
    }
}
