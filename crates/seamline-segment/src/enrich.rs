//! Enrichment (paper 4.1): a triangle with three sharp vertices has no curvature of its own, so it gets a
//! vertex at its centre while regions are found.
//!
//! The new elements come at the tail of their columns, so that taking them away again is cutting the tail
//! off. The new vertex and its spokes are never sharp. A parent triangle's three children hang together
//! over their spokes and share one vertex that is not sharp, hence one cluster and one region: the label
//! of the first child, which sits in the parent's row, is the parent's.

use bevy_ecs::prelude::*;
use seamline_ecs::components::{DihedralAngle, FaceShape, Position, SharpEdge, SharpVertex};
use seamline_ecs::rows::{self, Edges, Faces, Vertices};
use seamline_ecs::{Column, Counts, MeshTopology, Stage, StageSystems};
use seamline_mesh::Topology;

/// What enrichment changed besides the tails: the topology, and the shapes of the parents.
#[derive(Resource)]
struct BeforeEnrichment {
    topology: Topology,
    parents: Vec<(u32, FaceShape)>,
}

pub(crate) fn systems() -> StageSystems {
    find_sharp_triangles.pipe(split).in_set(Stage::Sharp)
}

pub(crate) fn removal() -> StageSystems {
    remove.in_set(Stage::Merge)
}

fn find_sharp_triangles(topology: Res<MeshTopology>, sharp: Column<SharpVertex>) -> Vec<u32> {
    let sharp = &sharp[..];
    let all_sharp = |corners: &[u32; 3]| corners.iter().all(|&v| sharp[v as usize].0);
    let triangles = topology.0.triangles.iter().enumerate();
    triangles
        .filter(|(_, corners)| all_sharp(corners))
        .map(|(face, _)| face as u32)
        .collect()
}

fn split(In(parents): In<Vec<u32>>, world: &mut World) {
    world
        .resource_mut::<Counts>()
        .note(Stage::Sharp, "inserted_vertices", parents.len());
    let original = std::mem::take(&mut world.resource_mut::<MeshTopology>().0);
    let [old_vertices, old_faces, old_edges] = original.counts();
    let mut enriched = original.clone();
    enriched.split_faces(&parents);
    let [vertices, faces, edges] = enriched.counts();
    rows::resize::<Vertices>(world, vertices);
    rows::resize::<Faces>(world, faces);
    rows::resize::<Edges>(world, edges);

    let positions = rows::column_mut::<Position>(world);
    for (i, &parent) in parents.iter().enumerate() {
        let [a, b, c] = original.triangles[parent as usize].map(|v| positions[v as usize].0);
        positions[old_vertices + i] = Position((a + b + c) / 3.0);
    }
    rows::column_mut(world)[old_vertices..].fill(SharpVertex(false));
    rows::column_mut(world)[old_edges..].fill(DihedralAngle(0.0));
    rows::column_mut(world)[old_edges..].fill(SharpEdge(false));

    let shapes = rows::column_mut::<FaceShape>(world);
    let parents: Vec<_> = parents
        .into_iter()
        .map(|face| (face, shapes[face as usize]))
        .collect();
    for (i, &(parent, shape)) in parents.iter().enumerate() {
        let child = FaceShape {
            area: shape.area / 3.0,
            ..shape
        };
        shapes[parent as usize] = child;
        shapes[old_faces + 2 * i..][..2].fill(child);
    }
    world.insert_resource(MeshTopology(enriched));
    world.insert_resource(BeforeEnrichment {
        topology: original,
        parents,
    });
}

fn remove(world: &mut World) {
    let Some(before) = world.remove_resource::<BeforeEnrichment>() else {
        return;
    };
    let [vertices, faces, edges] = before.topology.counts();
    rows::resize::<Vertices>(world, vertices);
    rows::resize::<Faces>(world, faces);
    rows::resize::<Edges>(world, edges);
    let shapes = rows::column_mut::<FaceShape>(world);
    for (face, shape) in before.parents {
        shapes[face as usize] = shape;
    }
    world.insert_resource(MeshTopology(before.topology));
}
