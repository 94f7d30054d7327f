//! `seamline segment`: cut meshes into patches.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Result;
use indicatif::{ProgressBar, ProgressStyle};
use seamline_ecs::results::StageRecord;
use seamline_ecs::{Segmentation, Worker};
use seamline_watch::outputs::sweep_leftovers;
use seamline_watch::{
    JobFacts, LoadedMesh, VERSION, WriteSet, load, report, shown, weld_share, write_results,
};

use crate::args::SegmentArgs;
use crate::outcome::{Outcome, WrongUse, say_failure};
use crate::say::{counted, print, say, tell_as_it_comes};
use crate::settings::pipeline_of_args;

/// Cuts every mesh named; one that fails is told and the others go on.
pub fn run(args: &SegmentArgs) -> Result<Outcome> {
    let pipeline = Arc::new(pipeline_of_args(&args.pipeline)?);
    let write = args
        .write
        .as_deref()
        .map_or(Ok(WriteSet::ALL), str::parse)?;
    refuse_same_names(&args.meshes)?;
    if args.output.exists() && !args.output.is_dir() {
        let output = shown(&args.output);
        return Err(WrongUse(format!(
            "-o {output}: is not a folder; name one, or a name that is free"
        ))
        .into());
    }
    sweep_leftovers(&args.output);
    if pipeline.threads() > 0 {
        rayon::ThreadPoolBuilder::new()
            .num_threads(pipeline.threads())
            .build_global()?;
    }
    let weld_share = weld_share(pipeline.settings_in_force());

    if args.said.verbose {
        tell_as_it_comes();
    }
    let bar = progress(args.meshes.len(), args.said.quiet);
    let mut worker = Worker::new(Arc::clone(&pipeline));
    let mut failures = 0;
    for path in &args.meshes {
        bar.set_message(path.display().to_string());
        let done = cut(path, weld_share, &mut worker).and_then(|(loaded, segmentation)| {
            let about = JobFacts {
                path,
                hash: &loaded.hash,
                format: loaded.format,
                bytes_len: loaded.bytes_len,
                settings: pipeline.settings_in_force(),
                program_version: VERSION,
                read_seconds: loaded.took.as_secs_f64(),
            };
            let name = path.file_name().unwrap_or(OsStr::new("mesh"));
            let place = write_results(
                &args.output,
                name,
                &loaded.mesh,
                &segmentation,
                &about,
                write,
            )
            .map_err(|e| Failure {
                reason: e.to_string(),
                hint: e.hint().to_owned(),
            })?;
            bar.suspend(|| tell(args, path, &place, &loaded, &segmentation, &about))
                .map_err(|e| Failure {
                    reason: format!("its report cannot be printed: {e}"),
                    hint: "check where standard output goes".to_owned(),
                })
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

struct Failure {
    reason: String,
    hint: String,
}

fn cut(
    path: &Path,
    weld_share: f64,
    worker: &mut Worker,
) -> Result<(LoadedMesh, Segmentation), Failure> {
    let loaded = load(path, weld_share).map_err(|e| Failure {
        reason: e.to_string(),
        hint: e.hint().to_owned(),
    })?;
    let segmentation = worker
        .segment(Arc::clone(&loaded.mesh))
        .map_err(|e| Failure {
            reason: e.to_string(),
            hint: e.hint,
        })?;
    Ok((loaded, segmentation))
}

fn tell(
    args: &SegmentArgs,
    path: &Path,
    place: &Path,
    loaded: &LoadedMesh,
    segmentation: &Segmentation,
    about: &JobFacts,
) -> io::Result<()> {
    if args.json {
        let report = report(&loaded.mesh, segmentation, about);
        print(&serde_json::to_string(&report)?)?;
    }
    if args.said.quiet {
        return Ok(());
    }
    let patches = counted(segmentation.patches.len(), "patch", "patches");
    let faces = counted(segmentation.face_patches.len(), "face", "faces");
    say(&format_args!(
        "{}: {patches} of {faces} -> {}",
        shown(path),
        shown(place)
    ));
    if args.said.verbose {
        say(&format_args!(
            "  {:<10} {:>9.3} s",
            "read", about.read_seconds
        ));
        for StageRecord {
            stage,
            seconds,
            counts,
            measures,
        } in &segmentation.stages
        {
            let counts = counts.iter().map(|(name, n)| format!("{name} {n}"));
            let measures = measures.iter().map(|(name, x)| format!("{name} {x:.3}"));
            let told: Vec<_> = counts.chain(measures).collect();
            say(&format_args!(
                "  {:<10} {seconds:>9.3} s  {}",
                stage.name(),
                told.join(", ")
            ));
        }
    }
    Ok(())
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
