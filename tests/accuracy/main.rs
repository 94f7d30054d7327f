//! How well `cad` cuts CAD meshes whose patches are known, as tables in Markdown.
//!
//! `cargo run --release -p seamline-tests --example accuracy [-- [--seconds] [FOLDER]]`: every mesh of a folder by
//! profile `cad` with no setting touched, and with noise by `lavoue2005` too. FOLDER has `NAME-VARIANT.stl` with `.seg`
//! and `.json` beside it, VARIANT one of coarse, fine and uniform; without it, the bench beside the project's folder.
//! `--seconds` adds the ten meshes that took most time. Exit status: 0, also where the bench is absent and there is
//! nothing to tell; 2 if the arguments are wrong or FOLDER has no meshes.
//!
//! Every figure is made as the bench's `score.py` makes it, and agrees with it to rounding.

mod cut;
mod noise;
mod patches;
mod seconds;
mod surfaces;
mod text;
mod truth;
mod types;
mod variants;

use std::env;
use std::path::PathBuf;
use std::process::ExitCode;

use cut::Cut;
use seamline_ecs::Worker;
use seamline_tests::models::models;
use seamline_tests::{bench, pipeline};

/// That of the program, so that it takes as long.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    let mut tell_seconds = false;
    let mut folder: Option<PathBuf> = None;
    for argument in env::args().skip(1) {
        if argument == "--seconds" {
            tell_seconds = true;
        } else if argument.starts_with('-') || folder.is_some() {
            eprintln!("usage: accuracy [--seconds] [FOLDER]; `{argument}` is too much");
            return ExitCode::from(2);
        } else {
            folder = Some(argument.into());
        }
    }
    if let Some(folder) = folder.as_ref().filter(|folder| !folder.is_dir()) {
        eprintln!("{} is no folder", folder.display());
        return ExitCode::from(2);
    }
    let Some(folder) = folder.or_else(|| bench("models")) else {
        return ExitCode::SUCCESS;
    };

    let models = models(&folder);
    if models.is_empty() {
        eprintln!("{} has no NAME-VARIANT.stl", folder.display());
        return ExitCode::from(2);
    }
    let mut worker = Worker::new(pipeline(&["pipeline.profile=cad"]));
    let cuts: Vec<_> = models
        .iter()
        .map(|model| Cut::of(model, &folder, &mut worker))
        .collect();
    variants::print(&cuts);
    types::print(&cuts);
    surfaces::print(&cuts);
    patches::print(&cuts);
    noise::print(&models);
    if tell_seconds {
        seconds::print(&cuts);
    }
    ExitCode::SUCCESS
}
