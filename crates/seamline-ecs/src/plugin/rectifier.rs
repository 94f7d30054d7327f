//! Rectifiers: cleaner boundaries for a labelled mesh.

use std::cell::Cell;
use std::sync::Arc;

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use seamline_mesh::{Mesh, Topology};
use serde::Serialize;

use super::{StepError, StepSettings, check_answers};
use crate::column::{Column, ColumnMut};
use crate::components::*;
use crate::job::{Counts, GivenAs, GivenBoundary, InputMesh, MeshScale, MeshTopology};
use crate::stage::{Stage, StageSystems, fallible};

/// One way to clean the boundaries of patches. The value is the plugin's settings.
pub trait Rectifier: StepSettings {
    /// What it does, in one line.
    const SUMMARY: &'static str;

    /// Gives each face its final label. Faces of one label are one patch, whether they touch or not.
    ///
    /// # Errors
    ///
    /// Where it cannot do its work on this mesh: the job ends with this reason.
    fn rectify(&self, mesh: &LabelledMesh<'_>) -> Result<Labels, StepError>;

    /// The labels [`Rectifier::rectify`] would give, found with the scores of a few edges alone. Asked where boundaries
    /// were given, before there are any scores (`mesh.scores` is empty): each is computed when it is asked for, with the
    /// curvature that it needs. `None` has all of them computed, and `rectify` called.
    fn rectify_asking(&self, _mesh: &LabelledMesh<'_>, _evidence: &dyn Evidence) -> Option<Labels> {
        None
    }
}

/// What speaks for boundaries and against them, to be asked piece by piece.
pub trait Evidence {
    /// How badly an edge would serve as a boundary, 0 (well) to 90 degrees.
    fn score(&self, edge: u32) -> f64;

    /// The surface each face lies on as exactly as the mesh has it, [`NONE`] where there is none; empty where none are
    /// looked for. Looking for them costs more than all scores.
    fn surfaces(&self) -> Vec<u32> {
        Vec::new()
    }
}

impl Evidence for &[BoundaryScore] {
    fn score(&self, edge: u32) -> f64 {
        self[edge as usize].0
    }
}

/// Computes evidence when it is asked for, for a mesh that is lent without any. Put into the world by the steps that
/// know how.
#[derive(Resource, Clone)]
pub struct EvidenceOnDemand(pub MakeEvidence);

/// What makes the evidence of one mesh.
pub type MakeEvidence =
    Arc<dyn for<'a> Fn(LabelledMesh<'a>) -> Box<dyn Evidence + 'a> + Send + Sync>;

/// Evidence of which each score is computed once.
struct Asked<'a> {
    evidence: Box<dyn Evidence + 'a>,
    /// Not a number where it was not asked for.
    known: Vec<Cell<f64>>,
}

impl Evidence for Asked<'_> {
    fn score(&self, edge: u32) -> f64 {
        let known = &self.known[edge as usize];
        if known.get().is_nan() {
            known.set(self.evidence.score(edge));
        }
        known.get()
    }

    fn surfaces(&self) -> Vec<u32> {
        self.evidence.surfaces()
    }
}

/// What a rectifier answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    /// One a face, below the number of faces.
    pub of_face: Vec<FaceLabel>,
    /// What was done to each edge, one an edge; empty where that is not told.
    pub contours: Vec<ContourState>,
    /// What became of each open end of a contour, in the order of its vertices; empty where that is not told.
    pub open_ends: Vec<OpenEnd>,
    /// Numbers for the report, such as how many patches there are.
    pub counts: Vec<(&'static str, usize)>,
}

/// What the rectifier has answered where scores were computed as it asked for them.
#[derive(Resource, Clone, Debug, Default)]
pub struct Answered(pub(crate) Option<Labels>);

impl Answered {
    /// Is there an answer already?
    pub fn is_there(&self) -> bool {
        self.0.is_some()
    }
}

/// An open end of a contour, and what became of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenEnd {
    /// The vertex it was at.
    pub vertex: u32,
    /// What became of it.
    pub fate: EndFate,
    /// Edges that were added from here.
    pub edges: u32,
    /// Their length.
    pub length: f64,
}

/// What becomes of an open end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum EndFate {
    /// Closed: edges run from it to a contour.
    #[default]
    Closed,
    /// Closed by another that ran into it.
    Met,
    /// Not closed: the gap is too long, or none are closed. What hangs on it encloses no patch.
    Left,
}

/// The open ends of the mesh in work, and what became of each.
#[derive(Resource, Clone, Debug, Default)]
pub struct OpenEnds(pub Vec<OpenEnd>);

/// A mesh cut into patches whose boundaries are to be cleaned. Lengths are in units of the scaled mesh. Slices
/// of one kind of element are of one length.
#[derive(Clone, Copy)]
pub struct LabelledMesh<'a> {
    /// Edges and neighbours of the scaled mesh.
    pub topology: &'a Topology,
    /// One a vertex.
    pub positions: &'a [Position],
    /// Normal and area, one a face.
    pub shapes: &'a [FaceShape],
    /// Signed dihedral angle in radians, one an edge.
    pub angles: &'a [DihedralAngle],
    /// One an edge.
    pub sharp: &'a [SharpEdge],
    /// How badly each edge would serve as a boundary, 0 (well) to 90 degrees.
    pub scores: &'a [BoundaryScore],
    /// The patch of each face so far, below the number of faces. Where edges were given, what they part.
    pub labels: &'a [FaceLabel],
    /// The edges that were given as boundaries instead of labels, rising; empty while segmenting, and where labels
    /// were given. They may end anywhere.
    pub given_edges: &'a [u32],
    /// What was given.
    pub given_as: GivenAs,
    /// The mesh as it was read, in the file's unit, its vertices and faces in the file's order.
    pub mesh: &'a Mesh,
    /// From its unit to that of the scaled mesh.
    pub scale: MeshScale,
}

impl LabelledMesh<'_> {
    /// The length of an edge.
    pub fn edge_length(&self, edge: usize) -> f64 {
        let [a, b] = self.topology.edge_vertices[edge].map(|v| self.positions[v as usize].0);
        a.distance(b)
    }
}

/// Edges between two labels, rising.
pub fn boundary(topology: &Topology, labels: &[FaceLabel]) -> Vec<u32> {
    let parts = |&edge: &u32| {
        topology
            .face_pair(edge as usize)
            .is_some_and(|[a, b]| labels[a as usize] != labels[b as usize])
    };
    (0..topology.edge_faces.len() as u32)
        .filter(parts)
        .collect()
}

#[derive(SystemParam)]
struct BoundaryColumns<'w, 's> {
    topology: Res<'w, MeshTopology>,
    positions: Column<'w, 's, Position>,
    shapes: Column<'w, 's, FaceShape>,
    angles: Column<'w, 's, DihedralAngle>,
    sharp: Column<'w, 's, SharpEdge>,
    scores: Column<'w, 's, BoundaryScore>,
    mesh: Res<'w, InputMesh>,
    scale: Res<'w, MeshScale>,
    given: Res<'w, GivenBoundary>,
}

impl BoundaryColumns<'_, '_> {
    fn lend<'a>(&'a self, labels: &'a [FaceLabel]) -> LabelledMesh<'a> {
        LabelledMesh {
            topology: &self.topology.0,
            positions: &self.positions,
            shapes: &self.shapes,
            angles: &self.angles,
            sharp: &self.sharp,
            scores: &self.scores,
            labels,
            given_edges: match self.given.origin {
                GivenAs::Nothing | GivenAs::Labels => &[],
                GivenAs::Edges | GivenAs::HardEdges => &self.given.edges,
            },
            given_as: self.given.origin,
            mesh: &self.mesh.0,
            scale: *self.scale,
        }
    }
}

/// The system that asks for an answer before there are scores ([`Rectifier::rectify_asking`]).
pub(crate) fn early_systems(
    rectify: impl Fn(&LabelledMesh<'_>, &dyn Evidence) -> Option<Labels> + Send + Sync + 'static,
) -> StageSystems {
    let system = move |columns: BoundaryColumns,
                       labels: Column<FaceLabel>,
                       on_demand: Option<Res<EvidenceOnDemand>>,
                       mut answered: ResMut<Answered>,
                       mut counts: ResMut<Counts>| {
        let Some(on_demand) = on_demand else { return };
        let seen = LabelledMesh {
            scores: &[],
            ..columns.lend(&labels)
        };
        let evidence = Asked {
            evidence: (on_demand.0)(seen),
            known: vec![Cell::new(f64::NAN); seen.angles.len()],
        };
        answered.0 = rectify(&seen, &evidence);
        if answered.is_there() {
            let known = evidence.known.iter();
            let asked = known.filter(|score| !score.get().is_nan()).count();
            counts.note(Stage::Score, "edges_scored", asked);
        }
    };
    system.into_configs()
}

/// The system that lends `rectify` its columns, checks its answer and writes it down.
pub fn rectifier_systems(
    rectify: impl Fn(&LabelledMesh<'_>) -> Result<Labels, StepError> + Send + Sync + 'static,
) -> StageSystems {
    let system = move |columns: BoundaryColumns,
                       mut labels: ColumnMut<FaceLabel>,
                       mut contours: ColumnMut<ContourState>,
                       mut open_ends: ResMut<OpenEnds>,
                       mut answered: ResMut<Answered>,
                       mut counts: ResMut<Counts>| {
        let found = match answered.0.take() {
            Some(found) => found,
            None => rectify(&columns.lend(&labels))?,
        };
        let answers = found.of_face.iter().map(|label| label.0);
        check_answers("rectifier", "label", "face", answers, labels.len())?;
        if found.contours.is_empty() {
            contours.fill(ContourState::Off);
        } else if found.contours.len() == contours.len() {
            contours.copy_from_slice(&found.contours);
        } else {
            let (given, wanted) = (found.contours.len(), contours.len());
            return Err(StepError::new(
                format!("the rectifier told of {given} edges where there are {wanted}"),
                "one state for every edge, or none at all",
            ));
        }
        labels.copy_from_slice(&found.of_face);
        open_ends.0 = found.open_ends;
        for (name, value) in found.counts {
            counts.note(Stage::Rectify, name, value);
        }
        Ok(())
    };
    fallible(system)
}
