//! `seamline segment`: cut meshes into patches.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};
use seamline_ecs::Worker;
use seamline_watch::{load, weld_share};

use crate::args::SegmentArgs;
use crate::outcome::{Outcome, WrongUse, say_failure};
use crate::results::{Failure, Results};
use crate::say::tell_as_it_comes;
use crate::settings::pipeline_of_args;

/// Cuts every mesh named; one that fails is told and the others go on.
pub fn run(args: &SegmentArgs) -> Result<Outcome> {
    let kind = ("pipeline.kind", "segment".to_owned());
    let pipeline = pipeline_of_args(&args.pipeline, &[kind])?;
    refuse_same_names(&args.meshes)?;
    let results = Results::new(&args.results, args.said, pipeline)?;
    let pipeline = results.pipeline();
    let weld_share = weld_share(pipeline.settings_in_force());

    if args.said.verbose {
        tell_as_it_comes();
    }
    let bar = progress(args.meshes.len(), args.said.quiet);
    let mut worker = Worker::new(pipeline);
    let mut failures = 0;
    for path in &args.meshes {
        bar.set_message(path.display().to_string());
        let done = load(path, weld_share)
            .map_err(Failure::from)
            .and_then(|loaded| {
                let segmentation = worker.segment(Arc::clone(&loaded.mesh))?;
                let place = results.write(path, &loaded, &segmentation)?;
                bar.suspend(|| results.tell(path, &place, &loaded, &segmentation))
            });
        if let Err(Failure { reason, hint }) = done {
            failures += 1;
            bar.suspend(|| say_failure(path, &reason, &hint));
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(Outcome::of_failures(failures))
}

/// Results are named by their input's file name, so that two inputs of one name would end in one folder.
fn refuse_same_names(meshes: &[PathBuf]) -> Result<(), WrongUse> {
    let mut first: BTreeMap<&OsStr, &Path> = BTreeMap::new();
    for path in meshes {
        let Some(name) = path.file_name() else {
            continue;
        };
        if let Some(before) = first.insert(name, path) {
            return Err(WrongUse(format!(
                "{} and {} would both write {}.seamline; cut them into different folders with -o",
                before.display(),
                path.display(),
                name.display()
            )));
        }
    }
    Ok(())
}

/// A bar on a terminal, nothing elsewhere.
fn progress(meshes: usize, quiet: bool) -> ProgressBar {
    if quiet || meshes < 2 {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {wide_msg}");
    ProgressBar::new(meshes as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
