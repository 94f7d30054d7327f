//! Evidence for a rectifier, which looks at a few edges of many: scores of single edges, with no more curvature than each
//! of them needs, and surfaces, where it asks for them.
//!
//! Whatever is computed here is the same to the last bit as where all of it is computed.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use seamline_ecs::components::{NONE, Sample, VertexCurvature};
use seamline_ecs::{Evidence, EvidenceOnDemand, LabelledMesh};

use crate::curvature::{Carrier, CurvatureSettings, vertex_curvature};
use crate::facets::{FacetSettings, FacetSum, are_alike, filtered};
use crate::score::{ScoreSettings, along, facet_score, vertex_score};
use crate::surfaces::{SurfaceSettings, exact_surfaces};
use crate::tensor::{Bending, face_tensor};

/// Scores by the carrier of curvature, and surfaces if they are looked for.
pub(crate) fn evidence(
    curvature: CurvatureSettings,
    facets: FacetSettings,
    score: ScoreSettings,
    surfaces: SurfaceSettings,
) -> EvidenceOnDemand {
    EvidenceOnDemand(Arc::new(move |mesh: LabelledMesh<'_>| {
        let bending = Bending {
            topology: mesh.topology,
            positions: mesh.positions,
            shapes: mesh.shapes,
            angles: mesh.angles,
            sharp: mesh.sharp,
        };
        let scores = match curvature.carrier {
            Carrier::Vertices => Scores::ByVertices(SomeVertices::new(bending, curvature.clone())),
            Carrier::Facets => Scores::ByFacets(SomeFacets::new(bending, facets.clone())),
        };
        Box::new(OnDemand {
            mesh,
            scores,
            weight: score.curvature_weight,
            surfaces: surfaces.clone(),
        })
    }))
}

struct OnDemand<'a> {
    mesh: LabelledMesh<'a>,
    scores: Scores<'a>,
    /// Of curvature against angles ([`ScoreSettings`]).
    weight: f64,
    surfaces: SurfaceSettings,
}

enum Scores<'a> {
    ByVertices(SomeVertices<'a>),
    ByFacets(SomeFacets<'a>),
}

impl Evidence for OnDemand<'_> {
    fn score(&self, edge: u32) -> f64 {
        match &self.scores {
            Scores::ByVertices(vertices) => vertices.score(edge, self.weight),
            Scores::ByFacets(facets) => facets.score(edge, self.weight),
        }
    }

    fn surfaces(&self) -> Vec<u32> {
        if self.surfaces.enabled {
            exact_surfaces(&self.surfaces, &self.mesh)
        } else {
            Vec::new()
        }
    }
}

/// Curvature at vertices somebody has asked for.
struct SomeVertices<'a> {
    bending: Bending<'a>,
    settings: CurvatureSettings,
    known: RefCell<Vec<Option<VertexCurvature>>>,
}

impl<'a> SomeVertices<'a> {
    fn new(bending: Bending<'a>, settings: CurvatureSettings) -> Self {
        Self {
            known: RefCell::new(vec![None; bending.positions.len()]),
            bending,
            settings,
        }
    }

    fn at(&self, vertex: u32) -> VertexCurvature {
        let mut known = self.known.borrow_mut();
        *known[vertex as usize]
            .get_or_insert_with(|| vertex_curvature(&self.settings, &self.bending, vertex))
    }

    fn score(&self, edge: u32, weight: f64) -> f64 {
        let topology = self.bending.topology;
        let Some(faces) = topology.face_pair(edge as usize) else {
            return 0.0;
        };
        let ends = topology.edge_vertices[edge as usize].map(|v| self.at(v));
        let across = faces.map(|face| self.at(topology.opposite_vertex(face, edge)).k);
        let along = along(topology, self.bending.positions, edge as usize);
        vertex_score(along, ends, across, weight)
    }
}

/// Facets somebody has asked for, and those whose curvature has a part in theirs.
struct SomeFacets<'a> {
    bending: Bending<'a>,
    settings: FacetSettings,
    /// The facet of each face, [`NONE`] where nobody has asked for it.
    of_face: Vec<Cell<u32>>,
    facets: RefCell<Vec<Facet>>,
}

struct Facet {
    sample: Sample,
    faces: Vec<u32>,
    /// Those it touches along edges that are not sharp, once they are looked for.
    beside: Option<Rc<[usize]>>,
    /// Curvature before filtering and after each round of it, as far as it is known.
    rounds: Vec<[f64; 2]>,
}

impl<'a> SomeFacets<'a> {
    fn new(bending: Bending<'a>, settings: FacetSettings) -> Self {
        Self {
            of_face: vec![Cell::new(NONE); bending.shapes.len()],
            facets: RefCell::default(),
            bending,
            settings,
        }
    }

    fn score(&self, edge: u32, weight: f64) -> f64 {
        let Bending {
            topology,
            positions,
            shapes,
            ..
        } = self.bending;
        let Some(faces) = topology.face_pair(edge as usize) else {
            return 0.0;
        };
        let filtered = faces.map(|face| {
            let facet = self.facet_at(face);
            Sample {
                curvature: self.curvature(facet, self.settings.median_rounds as usize),
                ..self.facets.borrow()[facet].sample
            }
        });
        let along = along(topology, positions, edge as usize);
        let normals = faces.map(|face| shapes[face as usize].normal);
        facet_score(along, filtered.each_ref(), normals, weight)
    }

    /// The facet of a face ([`crate::find_facets`]), gathered from face to face.
    fn facet_at(&self, face: u32) -> usize {
        let known = self.of_face[face as usize].get();
        if known != NONE {
            return known as usize;
        }
        let mut facets = self.facets.borrow_mut();
        let number = facets.len() as u32;
        let flat = self.settings.flat_deg.to_radians();
        self.of_face[face as usize].set(number);
        let mut faces = vec![face];
        let mut next = 0;
        while next < faces.len() {
            for (edge, across) in self.smooth_sides(faces[next]) {
                let of_across = &self.of_face[across as usize];
                if of_across.get() == NONE && self.bending.angles[edge as usize].0.abs() < flat {
                    of_across.set(number);
                    faces.push(across);
                }
            }
            next += 1;
        }
        // Sums come out the same in one order alone.
        faces.sort_unstable();
        let mut sum = FacetSum::default();
        for &face in &faces {
            let shape = &self.bending.shapes[face as usize];
            sum.add(&face_tensor(&self.bending, face), shape);
        }
        let sample = sum.sample();
        facets.push(Facet {
            rounds: vec![sample.curvature],
            sample,
            faces,
            beside: None,
        });
        number as usize
    }

    /// The edges of a face that are not sharp, each with the face across.
    fn smooth_sides(&self, face: u32) -> impl Iterator<Item = (u32, u32)> {
        let Bending {
            topology, sharp, ..
        } = self.bending;
        let edges = topology.face_edges[face as usize].into_iter();
        edges.filter_map(move |edge| {
            let [a, b] = topology.face_pair(edge as usize)?;
            (!sharp[edge as usize].0).then_some((edge, if a == face { b } else { a }))
        })
    }

    /// The curvature of a facet after so many rounds of the median filter ([`crate::filter_curvatures`]).
    fn curvature(&self, facet: usize, round: usize) -> [f64; 2] {
        let known = |round: usize| self.facets.borrow()[facet].rounds.get(round).copied();
        if let Some(known) = known(round) {
            return known;
        }
        let own = self.curvature(facet, round - 1);
        let beside = self.beside(facet);
        let alike = beside.iter().filter(|&&other| {
            let facets = self.facets.borrow();
            let (own, other) = (&facets[facet].sample, &facets[other].sample);
            are_alike(own, other, self.settings.similar_area_share)
        });
        let values = alike
            .map(|&other| self.curvature(other, round - 1))
            .collect();
        let curvature = filtered(own, values).unwrap_or(own);
        self.facets.borrow_mut()[facet].rounds.push(curvature);
        curvature
    }

    fn beside(&self, facet: usize) -> Rc<[usize]> {
        if let Some(known) = &self.facets.borrow()[facet].beside {
            return Rc::clone(known);
        }
        let faces = std::mem::take(&mut self.facets.borrow_mut()[facet].faces);
        let sides = faces.iter().flat_map(|&face| self.smooth_sides(face));
        let mut beside: Vec<usize> = sides
            .map(|(_, across)| self.facet_at(across))
            .filter(|&other| other != facet)
            .collect();
        beside.sort_unstable();
        beside.dedup();
        let beside: Rc<[usize]> = beside.into();
        self.facets.borrow_mut()[facet].beside = Some(Rc::clone(&beside));
        beside
    }
}
