//! One world and one schedule, through which mesh after mesh passes.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use bevy_ecs::prelude::*;
use bevy_ecs::schedule::SingleThreadedExecutor;
use rayon::{ThreadPool, ThreadPoolBuilder};
use seamline_mesh::{Markings, Mesh};
use thiserror::Error;

use crate::job::{
    Counts, GivenBoundary, InputMarkings, InputMesh, JobFailure, Measures, MeshTopology, Settled,
};
use crate::pipeline::Pipeline;
use crate::plugin::{Answered, OpenEnds};
use crate::results::{Segmentation, StageRecord};
use crate::stage::{Scoring, Stage};

/// Why a mesh gave no patches. It ends the job; the worker goes on with the next mesh.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{}: {message}", .stage.name())]
pub struct StageError {
    /// Where it happened.
    pub stage: Stage,
    /// What went wrong, in one line.
    pub message: String,
    /// What would be right.
    pub hint: String,
}

/// Sends meshes through a pipeline, one at a time. Keeps its rows from mesh to mesh; a mesh of less than
/// half the rows gets a fresh world, so that one giant does not hold its memory for ever.
pub struct Worker {
    pipeline: Arc<Pipeline>,
    world: World,
    schedule: Schedule,
    rows: usize,
    pool: Option<ThreadPool>,
    progress: Progress,
}

/// Which stage a worker is in, to be asked from another thread, or after a panic.
#[derive(Clone, Debug, Default, Resource)]
pub struct Progress(Arc<AtomicUsize>);

impl Progress {
    /// The stage under way; the last one, once all are through.
    pub fn stage(&self) -> Stage {
        let at = self.0.load(Ordering::Relaxed);
        Stage::ALL[at.min(Stage::ALL.len() - 1)]
    }

    fn set(&self, stages_done: usize) {
        self.0.store(stages_done, Ordering::Relaxed);
    }
}

/// Times each stage, and notes in which one a job failed.
#[derive(Resource)]
struct StageClock {
    last: Instant,
    seconds: [f64; Stage::ALL.len()],
    failed_in: Option<Stage>,
}

impl Worker {
    /// A worker for `pipeline`, with no rows yet.
    pub fn new(pipeline: Arc<Pipeline>) -> Self {
        Self::with_progress(pipeline, Progress::default())
    }

    /// As [`Worker::new`]; `progress` tells which stage it is in.
    pub fn with_progress(pipeline: Arc<Pipeline>, progress: Progress) -> Self {
        // Where no pool is to be had the one there is serves: results are the same.
        let threads = [0, rayon::current_num_threads()];
        let pool = (!threads.contains(&pipeline.threads()))
            .then(|| {
                ThreadPoolBuilder::new()
                    .num_threads(pipeline.threads())
                    .build()
            })
            .and_then(Result::ok);
        let (world, schedule) = fresh(&pipeline, &progress);
        Self {
            pipeline,
            world,
            schedule,
            rows: 0,
            pool,
            progress,
        }
    }

    /// Cuts one mesh into patches.
    ///
    /// Errors: the failure of a step, with its stage.
    pub fn segment(&mut self, mesh: Arc<Mesh>) -> Result<Segmentation, StageError> {
        self.run(mesh, None)
    }

    /// Sends one mesh through the pipeline, with what another tool has marked on it. A pipeline that segments
    /// does not look at that; one that rectifies needs it, but for one that looks for hard edges itself.
    ///
    /// Errors: the failure of a step, with its stage.
    pub fn run(
        &mut self,
        mesh: Arc<Mesh>,
        markings: Option<Arc<Markings>>,
    ) -> Result<Segmentation, StageError> {
        let rows = mesh.triangles.len();
        if rows < self.rows / 2 {
            (self.world, self.schedule) = fresh(&self.pipeline, &self.progress);
        }
        self.rows = rows;

        self.world.insert_resource(InputMesh(mesh));
        if let Some(markings) = markings {
            self.world.insert_resource(InputMarkings(markings));
        }
        self.world.insert_resource(JobFailure::default());
        self.world.insert_resource(Answered::default());
        self.world.resource_mut::<Counts>().clear();
        self.world.resource_mut::<Measures>().clear();
        let clock = StageClock {
            last: Instant::now(),
            seconds: [0.0; Stage::ALL.len()],
            failed_in: None,
        };
        self.world.insert_resource(clock);
        self.progress.set(0);

        let (world, schedule) = (&mut self.world, &mut self.schedule);
        match &self.pool {
            Some(pool) => pool.install(|| schedule.run(world)),
            None => schedule.run(world),
        }
        self.world.remove_resource::<InputMesh>();
        self.world.remove_resource::<InputMarkings>();
        self.collect()
    }

    /// The world, to look at what the last mesh left in it.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }

    fn collect(&mut self) -> Result<Segmentation, StageError> {
        let finished = self.world.remove_resource::<Segmentation>();
        let clock = self.world.resource::<StageClock>();
        if let Some(error) = &self.world.resource::<JobFailure>().0 {
            let stage = clock.failed_in.unwrap_or(Stage::Export);
            return Err(StageError {
                stage,
                message: error.message.clone(),
                hint: error.hint.clone(),
            });
        }
        let mut segmentation = finished.ok_or_else(|| StageError {
            stage: Stage::Export,
            message: "no step gave a result".to_owned(),
            hint: "the pipeline lacks its built-in steps".to_owned(),
        })?;
        let counts = self.world.resource::<Counts>();
        let measures = self.world.resource::<Measures>();
        segmentation.stages = Stage::ALL
            .into_iter()
            .map(|stage| StageRecord {
                stage,
                seconds: clock.seconds[stage as usize],
                counts: counts.of(stage).collect(),
                measures: measures.of(stage).collect(),
            })
            .collect();
        Ok(segmentation)
    }
}

fn fresh(pipeline: &Pipeline, progress: &Progress) -> (World, Schedule) {
    let mut world = World::new();
    world.insert_resource(progress.clone());
    world.init_resource::<MeshTopology>();
    world.init_resource::<Counts>();
    world.init_resource::<GivenBoundary>();
    world.init_resource::<OpenEnds>();
    world.init_resource::<Settled>();
    world.init_resource::<Measures>();

    let mut schedule = Schedule::default();
    schedule.set_executor(SingleThreadedExecutor::new());
    for stage in Stage::ALL {
        schedule.configure_sets(stage.run_if(|failure: Res<JobFailure>| failure.0.is_none()));
        let note = move |mut clock: ResMut<StageClock>,
                         failure: Res<JobFailure>,
                         progress: Res<Progress>| {
            let now = Instant::now();
            progress.set(stage as usize + 1);
            clock.seconds[stage as usize] = (now - clock.last).as_secs_f64();
            clock.last = now;
            if failure.0.is_some() {
                clock.failed_in.get_or_insert(stage);
            }
        };
        match Stage::ALL.get(stage as usize + 1) {
            Some(&next) => schedule.add_systems(note.after(stage).before(next)),
            None => schedule.add_systems(note.after(stage)),
        };
    }
    let are_needed = |answered: Res<Answered>| !answered.is_there();
    schedule.configure_sets(Scoring.in_set(Stage::Score).run_if(are_needed));
    pipeline.install(&mut world, &mut schedule);
    (world, schedule)
}
