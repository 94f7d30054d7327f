//! Classifiers: a cluster for every sample of curvature.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use glam::{DVec3, Vec3};
use seamline_mesh::{Mesh, Topology};

use super::{StepError, StepSettings, check_answers};
use crate::column::{Column, ColumnMut};
use crate::components::*;
use crate::job::{Counts, InputMesh, MeshTopology, Settled};
use crate::stage::{Stage, StageSystems, fallible};

/// One way to sort samples of curvature into clusters. The value is the plugin's settings.
pub trait Classifier: StepSettings {
    /// What it does, in one line.
    const SUMMARY: &'static str;

    /// Gives each sample a cluster. Clusters need not be connected on the surface, nor numbered without gaps.
    ///
    /// # Errors
    ///
    /// Where it cannot do its work on this mesh: the job ends with this reason.
    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError>;
}

/// What a classifier answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clusters {
    /// One a sample, below the number of samples.
    pub of_sample: Vec<SampleCluster>,
    /// Numbers for the report, such as how many clusters there are.
    pub counts: Vec<(&'static str, usize)>,
}

/// The samples of curvature of one mesh, and the surface they lie on. Lengths are in units of the scaled mesh,
/// curvatures in one over that. Slices of one kind of element are of one length.
#[derive(Clone, Copy)]
pub struct CurvatureSamples<'a> {
    /// What is to be compared, one a sample. In `cad` `ln(1 + c / barely_curved)` of the curvatures, in
    /// `lavoue2005` the curvatures `(|k_min|, k_max)` themselves.
    pub features: &'a [SampleFeature],
    /// Areas, curvatures and directions, one a sample.
    pub samples: &'a [Sample],
    /// The sample each face belongs to; [`NONE`] for all where samples lie on vertices.
    pub facet_of_face: &'a [FaceSample],
    /// Edges and neighbours of the scaled mesh.
    pub topology: &'a Topology,
    /// One a vertex.
    pub positions: &'a [Position],
    /// Normal and area, one a face.
    pub shapes: &'a [FaceShape],
    /// One an edge.
    pub sharp: &'a [SharpEdge],
    /// The mesh as it was read, in the file's unit, its vertices and faces in the file's order.
    pub mesh: &'a Mesh,
}

impl CurvatureSamples<'_> {
    /// The area each sample stands for: that of its facet, or a third of the faces round its vertex.
    pub fn areas(&self) -> Vec<f64> {
        let of = |sample: &Sample| {
            if sample.vertex == NONE {
                return sample.area;
            }
            let around = self.topology.vertex_faces.row(sample.vertex as usize);
            around
                .iter()
                .map(|&face| self.shapes[face as usize].area / 3.0)
                .sum()
        };
        self.samples.iter().map(of).collect()
    }

    /// `ln(1 + c / barely_curved)` of both curvatures of each sample, so that a ratio of radii counts alike at any
    /// size.
    pub fn log_curvatures(&self, barely_curved: f64) -> Vec<[f64; 2]> {
        let log = |c: f64| (c / barely_curved).ln_1p();
        self.samples
            .iter()
            .map(|sample| sample.curvature.map(log))
            .collect()
    }

    /// Pairs of samples that touch along an edge that is not sharp, lower number first, sorted, each once.
    pub fn neighbours(&self) -> Vec<[u32; 2]> {
        let mut of_vertex = Vec::new();
        if self.on_vertices() {
            of_vertex = vec![NONE; self.positions.len()];
            for (sample, row) in self.samples.iter().zip(0..) {
                of_vertex[sample.vertex as usize] = row;
            }
        }
        let ends = |edge: usize| -> Option<[u32; 2]> {
            if of_vertex.is_empty() {
                let faces = self.topology.face_pair(edge)?;
                Some(faces.map(|face| self.facet_of_face[face as usize].0))
            } else {
                let ends = self.topology.edge_vertices[edge];
                Some(ends.map(|vertex| of_vertex[vertex as usize]))
            }
        };
        let smooth = (0..self.sharp.len()).filter(|&edge| !self.sharp[edge].0);
        let mut pairs: Vec<_> = smooth
            .filter_map(ends)
            .filter(|&[a, b]| a != b && a != NONE && b != NONE)
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Do samples lie on vertices, and not on facets?
    pub fn on_vertices(&self) -> bool {
        self.samples.first().is_some_and(|s| s.vertex != NONE)
    }

    /// Unit direction of least curvature of each sample: along a cylinder's axis.
    pub fn directions(&self) -> impl Iterator<Item = DVec3> {
        self.samples
            .iter()
            .map(|sample| Vec3::from(sample.d_min).as_dvec3())
    }
}

#[derive(SystemParam)]
struct SampleColumns<'w, 's> {
    features: Column<'w, 's, SampleFeature>,
    samples: Column<'w, 's, Sample>,
    facet_of_face: Column<'w, 's, FaceSample>,
    topology: Res<'w, MeshTopology>,
    positions: Column<'w, 's, Position>,
    shapes: Column<'w, 's, FaceShape>,
    sharp: Column<'w, 's, SharpEdge>,
    mesh: Res<'w, InputMesh>,
}

impl SampleColumns<'_, '_> {
    fn lend(&self) -> CurvatureSamples<'_> {
        CurvatureSamples {
            features: &self.features,
            samples: &self.samples,
            facet_of_face: &self.facet_of_face,
            topology: &self.topology.0,
            positions: &self.positions,
            shapes: &self.shapes,
            sharp: &self.sharp,
            mesh: &self.mesh.0,
        }
    }
}

/// The system that lends `classify` its columns, checks its answer and writes it down.
pub fn classifier_systems(
    classify: impl Fn(&CurvatureSamples<'_>) -> Result<Clusters, StepError> + Send + Sync + 'static,
) -> StageSystems {
    let system = move |columns: SampleColumns,
                       mut clusters: ColumnMut<SampleCluster>,
                       mut counts: ResMut<Counts>| {
        let found = classify(&columns.lend())?;
        let answers = found.of_sample.iter().map(|cluster| cluster.0);
        let wanted = clusters.len();
        check_answers("classifier", "cluster", "sample", answers, wanted)?;
        clusters.copy_from_slice(&found.of_sample);
        for (name, value) in found.counts {
            counts.note(Stage::Classify, name, value);
        }
        Ok(())
    };
    fallible(system).run_if(Settled::not_yet)
}
