//! `seamline rectify`: close and clean the boundaries that another tool has found.

use std::path::Path;
use std::sync::Arc;

use anyhow::Result;
use seamline_ecs::Worker;
use seamline_mesh::Wanted;
use seamline_watch::{load, load_markings, shown, weld_share};

use crate::args::RectifyArgs;
use crate::outcome::{Outcome, WrongUse, say_failure};
use crate::results::{Failure, Results};
use crate::say::tell_as_it_comes;
use crate::settings::pipeline_of_args;

/// The rectifier whose settings say what becomes of open ends.
const CONTOUR_TRACKING: &str = "contour-tracking";

/// Rectifies what is given for one mesh.
pub fn run(args: &RectifyArgs) -> Result<Outcome> {
    refuse_without_effect(args)?;
    let pipeline = pipeline_of_args(&args.pipeline, &said(args)?)?;
    let results = Results::new(&args.results, args.said, pipeline)?;
    let pipeline = results.pipeline();
    if args.said.verbose {
        tell_as_it_comes();
    }
    let share = weld_share(pipeline.settings_in_force());
    let path = &args.mesh;
    let failed = |of: &Path, Failure { reason, hint }: Failure| {
        say_failure(of, &reason, &hint);
        Ok(Outcome::SomeFailed)
    };
    let mut loaded = match load(path, share) {
        Ok(loaded) => loaded,
        Err(error) => return failed(path, error.into()),
    };
    if let Some((file, wanted)) = given(args) {
        match load_markings(file, wanted, &loaded.mesh) {
            Ok(markings) => loaded.markings = Some(markings),
            Err(error) => return failed(file, error.into()),
        }
    }
    let markings = loaded
        .markings
        .as_ref()
        .map(|given| Arc::clone(&given.markings));
    let done = Worker::new(pipeline)
        .run(Arc::clone(&loaded.mesh), markings)
        .map_err(Failure::from)
        .and_then(|rectified| {
            let place = results.write(path, &loaded, &rectified)?;
            results.tell(path, &place, &loaded, &rectified)
        });
    match done {
        Ok(()) => Ok(Outcome::Done),
        Err(failure) => failed(path, failure),
    }
}

/// The file of markings, and what is looked for in it; nothing where hard edges are.
fn given(args: &RectifyArgs) -> Option<(&Path, Wanted<'_>)> {
    let labels = args.what.labels.as_deref().map(|file| {
        let by = args.labels_by.as_deref();
        (file, Wanted::Labels(by))
    });
    labels.or_else(|| Some((args.what.edges.as_deref()?, Wanted::Edges)))
}

/// Arguments that would be passed over in silence, or that another one overrules.
fn refuse_without_effect(args: &RectifyArgs) -> Result<(), WrongUse> {
    if let Some(name) = &args.pipeline.classifier {
        return Err(WrongUse(format!(
            "--classifier {name}: nothing is classified where boundaries are given; leave it out"
        )));
    }
    if let Some(by) = &args.labels_by {
        let Some(file) = &args.what.labels else {
            return Err(WrongUse(format!(
                "--labels-by {by}: no labels are given; name their PLY or OBJ with --labels"
            )));
        };
        // Other names say nothing: a PLY is known by its content.
        let name = file.to_string_lossy().to_lowercase();
        if name.ends_with(".seg") || name.ends_with(".selection.txt") {
            return Err(WrongUse(format!(
                "--labels-by {by}: in {} there is nothing to choose from; leave it out, or name a PLY or an OBJ",
                shown(file)
            )));
        }
    }
    let sets_hard_edges = |set: &&String| set.trim_start().starts_with("hard-edges.");
    if let Some(set) = args.pipeline.set.iter().find(sets_hard_edges) {
        return Err(WrongUse(format!(
            "--set {set}: what edges are hard is said by --sharp-deg; name both angles there, as 15:40"
        )));
    }
    refuse_ends_of_another_rectifier(args)
}

/// What becomes of a contour that ends is [`CONTOUR_TRACKING`]'s to say: another rectifier has no settings for it, and
/// tells of no ends.
fn refuse_ends_of_another_rectifier(args: &RectifyArgs) -> Result<(), WrongUse> {
    let Some(rectifier) = &args.pipeline.rectifier else {
        return Ok(());
    };
    let of_tracking = |set: &&String| {
        let key = set.trim_start().strip_prefix(CONTOUR_TRACKING);
        key.is_some_and(|key| key.starts_with('.'))
    };
    match args.pipeline.set.iter().find(of_tracking) {
        Some(set) if rectifier != CONTOUR_TRACKING => Err(WrongUse(format!(
            "--set {set}: has no effect with --rectifier {rectifier}; leave one of the two out"
        ))),
        _ => Ok(()),
    }
}

/// The settings the arguments stand for.
fn said(args: &RectifyArgs) -> Result<Vec<(&'static str, String)>, WrongUse> {
    let mut said = vec![("pipeline.kind", "rectify".to_owned())];
    if args.refine {
        said.push(("refine.enabled", "true".to_owned()));
    }
    if let Some(angles) = &args.what.sharp_deg {
        let (weak, strong) = angles.split_once(':').unwrap_or((angles, angles));
        let degrees = |angle: &str| {
            let degrees = angle.trim().parse::<f64>().ok();
            let degrees = degrees.filter(|deg| (0.0..180.0).contains(deg) && *deg > 0.0);
            degrees.ok_or_else(|| {
                WrongUse(format!(
                    "--sharp-deg {angles}: wants an angle above 0 and below 180 degrees, or two as 15:40"
                ))
            })
        };
        let [weak_deg, strong_deg] = [degrees(weak)?, degrees(strong)?];
        if weak_deg > strong_deg {
            return Err(WrongUse(format!(
                "--sharp-deg {angles}: the smaller angle comes first, as {strong_deg}:{weak_deg}"
            )));
        }
        said.push(("hard-edges.weak_deg", weak_deg.to_string()));
        said.push(("hard-edges.strong_deg", strong_deg.to_string()));
    } else {
        said.push(("hard-edges.strong_deg", "0".to_owned()));
        said.push(("hard-edges.weak_deg", "0".to_owned()));
    }
    Ok(said)
}
