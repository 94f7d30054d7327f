//! The threads that cut: each has a worker of its own, and threads of its own for that worker.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender};
use rayon::{ThreadPool, ThreadPoolBuilder};
use seamline_ecs::{Pipeline, Progress, Segmentation, Worker};

use super::guard::guarded;
use super::{Cutting, Shared};
use crate::daemon::job::{Cut, Failure, Job, Loaded, Outcome};
use crate::load::LoadedMesh;
use crate::memory::{Pass, bytes_kept};

/// An idle cutter looks this often whether somebody waits for the memory it keeps.
const GIVE_WAY_EVERY: Duration = Duration::from_millis(100);

/// What a cutter keeps from mesh to mesh.
struct Kept {
    worker: Worker,
    pipeline: Arc<Pipeline>,
    /// Of its own, and not shared among the cutters: a mesh that hangs in one of the threads hangs nobody else.
    pool: Option<ThreadPool>,
    /// The memory its rows take while it has nothing to do.
    idle: Option<Pass>,
}

impl Kept {
    fn new(pipeline: &Arc<Pipeline>, progress: &Progress) -> Self {
        // Without a pool the worker has the threads of the whole program: results are the same.
        let pool = ThreadPoolBuilder::new()
            .num_threads(pipeline.threads())
            .build()
            .ok();
        let new = || Worker::with_progress(pipeline.clone(), progress.clone());
        Self {
            worker: pool.as_ref().map_or_else(new, |pool| pool.install(new)),
            pipeline: pipeline.clone(),
            pool,
            idle: None,
        }
    }

    fn cut(&mut self, mesh: &LoadedMesh) -> Result<Segmentation, seamline_ecs::StageError> {
        let Self { worker, pool, .. } = self;
        let given = mesh.markings.as_ref();
        let markings = given.map(|given| given.markings.clone());
        let mesh = mesh.mesh.clone();
        match pool {
            Some(pool) => pool.install(|| worker.run(mesh, markings)),
            None => worker.run(mesh, markings),
        }
    }
}

pub(super) fn cut_all(
    shared: &Shared,
    to_cut: &Receiver<Loaded>,
    cut: &Sender<Cut>,
    outcome: &Sender<Outcome>,
) {
    let mut kept: Option<Kept> = None;
    let progress = Progress::default();
    while let Some(Loaded { job, mesh, pass }) = next(shared, to_cut, &mut kept) {
        if shared.is_stopping() {
            drop((mesh, pass));
            if outcome.send(Outcome::Dropped { job }).is_err() {
                return;
            }
            continue;
        }
        let said = job.span.clone();
        let _said = said.enter();
        begin(shared, &job, &mesh.content, &progress);
        let result = cut_one(&mut kept, &progress, &job, &mesh);
        if !end(shared, &job) {
            // This job was given up, and another cutter has this one's place.
            shared.abandoned.fetch_sub(1, Ordering::Relaxed);
            return;
        }
        keep_if_there_is_room(shared, &mut kept, &job, &mesh);
        let handed_on = match result {
            Ok(segmentation) => {
                for record in &segmentation.stages {
                    let took = Duration::from_secs_f64(record.seconds);
                    shared.metrics.stage_took(record.stage.name(), took);
                }
                let segmentation = Box::new(segmentation);
                let done = Cut {
                    job,
                    mesh,
                    segmentation,
                    pass,
                };
                cut.send(done).is_ok()
            }
            Err(failure) => {
                let failure = failure.of(mesh.content);
                outcome.send(Outcome::Failed { job, failure }).is_ok()
            }
        };
        if !handed_on {
            return;
        }
    }
}

/// The next mesh. Who waits for one gives up the rows of the last as soon as somebody needs the memory.
fn next(shared: &Shared, to_cut: &Receiver<Loaded>, kept: &mut Option<Kept>) -> Option<Loaded> {
    loop {
        match to_cut.recv_timeout(GIVE_WAY_EVERY) {
            Ok(loaded) => {
                if let Some(kept) = kept {
                    // From here on the memory is that of the mesh.
                    kept.idle = None;
                }
                return Some(loaded);
            }
            Err(RecvTimeoutError::Timeout) if shared.gate.is_waited_for() => *kept = None,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return None,
        }
    }
}

/// Rows are kept for the next mesh where there is room for them beside the meshes in work.
fn keep_if_there_is_room(shared: &Shared, kept: &mut Option<Kept>, job: &Job, mesh: &LoadedMesh) {
    let (triangles, vertices) = (mesh.mesh.triangles.len(), mesh.mesh.positions().len());
    let bytes = bytes_kept(triangles as u64, vertices as u64, job.setup.enriched);
    let Some(at_rest) = kept else {
        return;
    };
    at_rest.idle = shared.gate.try_enter(bytes).ok().flatten();
    if at_rest.idle.is_none() {
        *kept = None;
    }
}

fn cut_one(
    kept: &mut Option<Kept>,
    progress: &Progress,
    job: &Job,
    mesh: &LoadedMesh,
) -> Result<Segmentation, Failure> {
    let pipeline = &job.setup.pipeline;
    let mut at_work = kept
        .take()
        .filter(|kept| Arc::ptr_eq(&kept.pipeline, pipeline));
    let result = guarded("pipeline", || {
        at_work
            .get_or_insert_with(|| Kept::new(pipeline, progress))
            .cut(mesh)
    });
    match result {
        Ok(cut) => {
            *kept = at_work;
            cut.map_err(|error| {
                let mut failure = Failure::new(error.stage.name(), error.message, error.hint);
                failure.fault.of_content = true;
                failure
            })
        }
        Err(mut panicked) => {
            panicked.fault.stage = progress.stage().name().to_owned();
            // Its world may be half changed: the next mesh gets a new one.
            let _ = catch_unwind(AssertUnwindSafe(|| drop(at_work)));
            Err(panicked)
        }
    }
}

fn begin(shared: &Shared, job: &Job, content: &str, progress: &Progress) {
    let under_way = Cutting {
        job: job.clone(),
        content: content.to_owned(),
        since: Instant::now(),
        progress: progress.clone(),
    };
    shared.cutting().insert(job.file.id, under_way);
}

/// False if the job was given up meanwhile.
fn end(shared: &Shared, job: &Job) -> bool {
    shared.cutting().remove(&job.file.id).is_some()
}
