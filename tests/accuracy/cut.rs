//! One model cut and scored.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};
use seamline_ecs::Worker;
use seamline_ecs::results::PatchSurface;
use seamline_tests::models::Model;
use seamline_tests::score::{Agreement, Partner, agreement, partners, tangent_recall};

use crate::truth::Truth;

/// How often each model is cut.
const RUNS: usize = 3;

pub struct Cut<'a> {
    pub model: &'a Model,
    pub truth: Truth,
    pub agreement: Agreement,
    /// `None` if no true patches meet without an edge.
    pub tangent_recall: Option<f64>,
    /// The found patch for each true one, by its label.
    pub partners: BTreeMap<u32, Partner>,
    /// What each found patch is told to be.
    pub surfaces: Vec<Option<PatchSurface>>,
    /// Of all processors together, reading and welding not counted, in the run of median time.
    pub seconds: f64,
    /// From begin to end, the same.
    pub elapsed: Duration,
}

impl<'a> Cut<'a> {
    /// # Panics
    ///
    /// If the model's JSON does not read or a step fails.
    pub fn of(model: &'a Model, folder: &Path, worker: &mut Worker) -> Self {
        let truth = Truth::read(&folder.join(format!("{}.json", model.name)));
        let mut once = || {
            let (before, begin) = (processor_time(), Instant::now());
            let cut = worker
                .segment(Arc::clone(&model.mesh))
                .expect("every step does its work");
            let elapsed = begin.elapsed();
            (cut, (processor_time() - before).as_secs_f64(), elapsed)
        };
        let mut times = [(); RUNS].map(|()| once());
        times.sort_by_key(|(_, _, elapsed)| *elapsed);
        let (cut, seconds, elapsed) = &times[RUNS / 2];
        let (mesh, labels, found) = (&model.mesh, &model.truth, &cut.face_patches);
        Self {
            agreement: agreement(mesh, labels, found),
            tangent_recall: tangent_recall(mesh, labels, found, &truth.tangent()),
            partners: partners(mesh, labels, found),
            surfaces: cut.patches.iter().map(|patch| patch.surface).collect(),
            seconds: *seconds,
            elapsed: *elapsed,
            model,
            truth,
        }
    }
}

/// What this process has had so far.
fn processor_time() -> Duration {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    Duration::try_from(time).expect("no time is before the start")
}
