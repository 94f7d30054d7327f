//! Plugins in any language: a program that gets columns on standard input and answers on standard output.
//!
//! ```toml
//! [pipeline]
//! classifier = { command = ["python3", "my_classifier.py"], timeout_s = 30 }
//! ```
//!
//! **What comes in.** For each mesh, tables one after the other on standard input, each an Arrow IPC stream of its
//! own with its end-of-stream mark. The metadata of each schema says what it is: `seamline.protocol` (`1`),
//! `seamline.stage` (`classify` or `rectify`), `seamline.table` (its name), `seamline.tables` (the names of all
//! tables of this mesh, in order, with commas) and `seamline.answer` (the column that is wanted). `send` in the
//! configuration picks some of the tables; row `i` of a table is element `i` of its kind, and where a number
//! stands for an element that is not there, it is 4294967295. Lengths are those of the scaled mesh.
//!
//! | stage | table | columns |
//! |---|---|---|
//! | classify | `samples` | `area`, `k_min`, `k_max` (filtered, both as magnitudes), `feature_0`, `feature_1` (what is compared: logarithms in `cad`): f64; `d_x`, `d_y`, `d_z` (direction of least curvature): f32; `vertex` (the one it lies on): u32 |
//! | | `neighbours` | `a`, `b`: u32, pairs of samples that touch along an edge that is not sharp |
//! | | `vertices` | `x`, `y`, `z`: f64 |
//! | | `faces` | `a`, `b`, `c` (vertices), `sample`: u32; `area`: f64 |
//! | rectify | `faces` | `a`, `b`, `c` (vertices), `label`: u32; `area`: f64 |
//! | | `edges` | `a`, `b` (vertices), `left`, `right` (faces): u32; `length`, `score` (0 serves well as a boundary, 90 badly), `angle` (radians, positive where convex): f64; `sharp`: bool |
//! | | `vertices` | as above |
//!
//! **What goes out.** One Arrow IPC stream on standard output with one column of whole numbers: `cluster` for
//! each sample, below the number of samples, or `label` for each face, below the number of faces. Standard
//! error goes to the log of `watch`; `segment -v` and `plugins check` show it.
//!
//! **For how long.** A program that goes on reading after its answer gets the next mesh, of the same stage; its
//! input ends when it is needed no longer. One that ends with status 0 after an answer is started again for
//! the next mesh, and so is one that has said more after its answer. Several may run at a time.
//!
//! **What may go wrong** costs the job that was under way and the process, never more: a program that cannot be
//! started, ends before it has answered, says nothing for `timeout_s`, or answers with what is no Arrow stream,
//! has other columns, has gaps, or is of the wrong length.
//!
//! **What it costs.** On a million vertices 0.39 s where `samples` alone is sent and 0.94 s with all tables, measured on a
//! busy machine; a process is started once, not for each mesh. The README of `plugins/` has the command.

mod answer;
mod crew;
mod fault;
mod process;
mod tables;

use std::sync::Arc;

use seamline_ecs::components::{FaceLabel, SampleCluster};
use seamline_ecs::settings::OutOfRange;
use seamline_ecs::{
    Clusters, CommandSettings, Labels, MakeSystems, SwappableStage, classifier_systems,
    rectifier_systems,
};

use crew::Crew;

/// The systems of a stage that a program fills. All workers share its processes.
///
/// # Errors
///
/// A table to be sent that the stage does not have.
pub fn systems(
    stage: SwappableStage,
    settings: &CommandSettings,
) -> Result<MakeSystems, OutOfRange> {
    OutOfRange::unless(
        tables::are_known(stage, &settings.send),
        "send",
        match stage {
            SwappableStage::Classify => "any of samples, neighbours, vertices and faces",
            SwappableStage::Rectify => "any of faces, edges and vertices",
        },
    )?;
    let crew = Arc::new(Crew::new(settings.clone()));
    Ok(match stage {
        SwappableStage::Classify => Arc::new(move || {
            let crew = Arc::clone(&crew);
            classifier_systems(move |samples| {
                let tables = tables::of_samples(samples, &crew.settings().send);
                let clusters = crew.ask(&tables, "cluster", samples.samples.len())?;
                let count = clusters.iter().max().map_or(0, |greatest| greatest + 1);
                Ok(Clusters {
                    of_sample: clusters.into_iter().map(SampleCluster).collect(),
                    counts: vec![("clusters", count as usize)],
                })
            })
        }),
        SwappableStage::Rectify => Arc::new(move || {
            let crew = Arc::clone(&crew);
            rectifier_systems(move |mesh| {
                let tables = tables::of_mesh(mesh, &crew.settings().send);
                let labels = crew.ask(&tables, "label", mesh.labels.len())?;
                Ok(Labels {
                    of_face: labels.into_iter().map(FaceLabel).collect(),
                    ..Labels::default()
                })
            })
        }),
    })
}
