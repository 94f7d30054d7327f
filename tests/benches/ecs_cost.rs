//! What the ECS costs: the steps as systems on columns, against the bare kernels on plain vectors, in one
//! run on the same mesh.
//!
//! `cargo bench -p seamline-tests --bench ecs_cost`. Both keep their memory from mesh to mesh.

use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use seamline_contour_tracking::{ContourTrackingSettings, Ground, mark, patches, track};
use seamline_ecs::components::*;
use seamline_ecs::settings::{Profile, StepSettings};
use seamline_ecs::{Segmentation, Stage, Worker};
use seamline_kmeans::{KMeansSettings, classify};
use seamline_mesh::{Mesh, Topology, shapes, weld};
use seamline_segment::*;
use seamline_tests::pipeline;

/// The `cad` pipeline without ECS: the same kernels in the same order on vectors of its own.
#[derive(Default)]
struct Bare {
    topology: Topology,
    order: SpatialOrder,
    positions: Vec<Position>,
    sharp_vertices: Vec<SharpVertex>,
    shapes: Vec<FaceShape>,
    facet_of_face: Vec<FaceSample>,
    labels: Vec<FaceLabel>,
    angles: Vec<DihedralAngle>,
    sharp: Vec<SharpEdge>,
    scores: Vec<BoundaryScore>,
    states: Vec<ContourState>,
    samples: Vec<Sample>,
    features: Vec<SampleFeature>,
    length: f64,
}

impl Bare {
    fn bending(&self) -> Bending<'_> {
        Bending {
            topology: &self.topology,
            positions: &self.positions,
            shapes: &self.shapes,
            angles: &self.angles,
            sharp: &self.sharp,
        }
    }

    fn prepare(&mut self, mesh: &Mesh) {
        let by = MeshSettings::defaults(Profile::Cad).scale;
        let Laid {
            scale,
            order,
            positions,
            triangles,
        } = lay_out(mesh, by).expect("it has an area");
        self.topology = Topology::build(positions.len(), triangles);
        (self.length, self.order, self.positions) = (scale.length, order, positions);
        let [vertices, faces, edges] = self.topology.counts();
        self.sharp_vertices.resize(vertices, SharpVertex::default());
        self.shapes.resize(faces, FaceShape::default());
        self.labels.resize(faces, FaceLabel::default());
        self.angles.resize(edges, DihedralAngle::default());
        self.sharp.resize(edges, SharpEdge::default());
        self.scores.resize(edges, BoundaryScore::default());
        self.states.resize(edges, ContourState::default());
        face_shapes(&self.topology, &self.positions, &mut self.shapes);
        dihedral_angles(
            &self.topology,
            &self.positions,
            &self.shapes,
            &mut self.angles,
        );
        let limit = SharpSettings::defaults(Profile::Cad).angle_deg.to_radians();
        sharp_edges(&self.topology, &self.angles, limit, &mut self.sharp);
        sharp_vertices(&self.topology, &self.sharp, &mut self.sharp_vertices);
    }

    fn curvature(&mut self) {
        let settings = FacetSettings::defaults(Profile::Cad);
        let facets = find_facets(&self.bending(), settings.flat_deg.to_radians());
        self.facet_of_face.clear();
        self.facet_of_face
            .extend(facets.of_face.into_iter().map(FaceSample));
        self.samples = facets.samples;
        filter_curvatures(
            &settings,
            &self.topology,
            &self.sharp,
            &self.facet_of_face,
            &mut self.samples,
        );
        self.features.clear();
        self.features.extend(
            self.samples
                .iter()
                .map(|sample| facet_feature(&settings, sample)),
        );
    }

    fn segment(&mut self, mesh: &Mesh) -> Segmentation {
        self.prepare(mesh);
        self.curvature();
        let clusters = classify(&self.features, &KMeansSettings::defaults(Profile::Cad)).of_sample;
        self.grow_and_merge(&clusters);
        self.rectify();
        let curvatures = face_curvatures(&self.bending(), &self.facet_of_face, &self.samples);
        let face_patches = number_patches(mesh, &self.order, &self.shapes, &mut self.labels);
        let rows = LabelledRows {
            bending: self.bending(),
            order: &self.order,
            sharp_vertices: &self.sharp_vertices,
            curvatures: &curvatures,
            labels: &self.labels,
            length: self.length,
            turned: false,
            given: None,
        };
        describe(mesh, &rows, face_patches, true)
    }

    fn grow_and_merge(&mut self, clusters: &[SampleCluster]) {
        let (topology, sharp, shapes) = (&self.topology, &self.sharp, &self.shapes);
        let grown = grow_facets(
            topology,
            sharp,
            &self.facet_of_face,
            shapes,
            &self.samples,
            clusters,
        );
        for (label, region) in self.labels.iter_mut().zip(grown.of_face) {
            label.0 = region;
        }
        let regions: Vec<_> = grown
            .curvatures
            .iter()
            .map(|&curvature| Region {
                curvature,
                ..Region::default()
            })
            .collect();
        let graph = RegionGraph::build(
            topology,
            &self.positions,
            shapes,
            sharp,
            &self.labels,
            regions,
            None,
        );
        let barely_curved = FacetSettings::defaults(Profile::Cad).barely_curved;
        let settings = MergeSettings::defaults(Profile::Cad);
        let number = reduce(graph, &settings, barely_curved, None).number;
        for label in &mut self.labels {
            label.0 = number[label.0 as usize];
        }
    }

    fn rectify(&mut self) {
        let weight = ScoreSettings::defaults(Profile::Cad).curvature_weight;
        let settings = ContourTrackingSettings::defaults(Profile::Cad);
        let Self {
            topology,
            positions,
            shapes,
            facet_of_face,
            samples,
            ..
        } = self;
        let (scores, states, labels) = (&mut self.scores, &mut self.states, &mut self.labels);
        facet_scores(
            topology,
            positions,
            shapes,
            facet_of_face,
            samples,
            weight,
            scores,
        );
        let ground = Ground {
            topology,
            positions,
            evidence: &&scores[..],
            turn_weight: settings.turn_weight,
            max_gap: f64::INFINITY,
        };
        mark(&ground, &self.sharp, labels, &settings, states);
        track(ground, states);
        patches(topology, false, states, labels);
    }
}

/// A smooth cube of 540,000 triangles.
fn mesh() -> Arc<Mesh> {
    Arc::new(weld(shapes::smooth_cube(0.2, 140, 72).polygons(), 0.0))
}

fn whole_pipeline(c: &mut Criterion) {
    let mesh = mesh();
    let mut worker = Worker::new(pipeline(&["surfaces.enabled=false"]));
    let mut bare = Bare::default();
    let cut = worker.segment(Arc::clone(&mesh)).expect("it is cut");
    assert_eq!(
        cut.face_patches,
        bare.segment(&mesh).face_patches,
        "both do the same"
    );

    let mut group = c.benchmark_group("whole pipeline");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(20));
    group.bench_function("systems on columns", |b| {
        b.iter(|| worker.segment(Arc::clone(&mesh)))
    });
    group.bench_function("bare kernels on vectors", |b| {
        b.iter(|| black_box(bare.segment(&mesh)))
    });
    group.finish();
}

fn curvature_stage(c: &mut Criterion) {
    let mesh = mesh();
    let mut worker = Worker::new(pipeline(&["surfaces.enabled=false"]));
    let mut bare = Bare::default();
    bare.prepare(&mesh);

    let mut group = c.benchmark_group("curvature stage");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(10));
    group.bench_function("systems on columns", |b| {
        b.iter_custom(|rounds| {
            let seconds = (0..rounds).map(|_| {
                let cut = worker.segment(Arc::clone(&mesh)).expect("it is cut");
                cut.stages[Stage::Curvature as usize].seconds
            });
            Duration::from_secs_f64(seconds.sum())
        });
    });
    group.bench_function("bare kernels on vectors", |b| b.iter(|| bare.curvature()));
    group.finish();
}

/// A plugin behind its contract (lent columns, answer checked and written down) against its kernel called on the
/// same features: in turn, since what the contract adds is less than what a busy machine changes from one minute to
/// the next.
fn classify_stage(_: &mut Criterion) {
    let mesh = mesh();
    let mut worker = Worker::new(pipeline(&["surfaces.enabled=false"]));
    let mut bare = Bare::default();
    bare.prepare(&mesh);
    bare.curvature();
    let settings = KMeansSettings::defaults(Profile::Cad);

    let [mut plugin, mut kernel] = [const { Vec::new() }; 2];
    for _ in 0..ROUNDS {
        let cut = worker.segment(Arc::clone(&mesh)).expect("it is cut");
        plugin.push(cut.stages[Stage::Classify as usize].seconds);
        let begun = Instant::now();
        black_box(classify(&bare.features, &settings));
        kernel.push(begun.elapsed().as_secs_f64());
    }
    let [plugin, kernel] = [plugin, kernel].map(|mut seconds: Vec<f64>| {
        seconds.sort_by(f64::total_cmp);
        seconds[ROUNDS / 2] * 1e3
    });
    println!(
        "classify stage, medians of {ROUNDS} in turn: plugin in the pipeline {plugin:.2} ms, its kernel {kernel:.2} ms, \
         ratio {:.3}",
        plugin / kernel
    );
}

/// So many that the median is the same again.
const ROUNDS: usize = 41;

criterion_group!(benches, curvature_stage, classify_stage, whole_pipeline);
criterion_main!(benches);
