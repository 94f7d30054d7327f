//! Results of a command that works on meshes: written to a folder, told in a line, printed as a report.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Result;
use seamline_ecs::results::{Changes, StageRecord};
use seamline_ecs::{Pipeline, Segmentation, StageError};
use seamline_watch::outputs::sweep_leftovers;
use seamline_watch::{
    JobFacts, LoadError, LoadedMesh, VERSION, WriteSet, report, shown, write_results,
};

use crate::args::{ResultArgs, SaidArgs};
use crate::outcome::WrongUse;
use crate::say::{counted, print, say};

/// Where results go, and what is said of them.
pub struct Results<'a> {
    args: &'a ResultArgs,
    said: SaidArgs,
    write: WriteSet,
    pipeline: Arc<Pipeline>,
}

/// Why an input has no results, and what would be right.
pub struct Failure {
    pub reason: String,
    pub hint: String,
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        Self {
            reason: error.to_string(),
            hint: error.hint().to_owned(),
        }
    }
}

impl From<StageError> for Failure {
    fn from(error: StageError) -> Self {
        Self {
            reason: error.to_string(),
            hint: error.hint,
        }
    }
}

impl<'a> Results<'a> {
    /// Makes ready to write what the arguments ask for, and threads as the pipeline does.
    ///
    /// # Errors
    ///
    /// Wrong use: files that there are none of, an output folder that is none.
    pub fn new(args: &'a ResultArgs, said: SaidArgs, pipeline: Pipeline) -> Result<Self> {
        let write = args
            .write
            .as_deref()
            .map_or(Ok(WriteSet::ALL), str::parse)?;
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
        let mut told = write.told();
        told.patch_curvature |= args.json;
        Ok(Self {
            args,
            said,
            write,
            pipeline: Arc::new(pipeline.telling(told)),
        })
    }

    /// The pipeline, telling what these results have in them and no more.
    pub fn pipeline(&self) -> Arc<Pipeline> {
        Arc::clone(&self.pipeline)
    }

    /// Writes the results of one mesh and gives their folder.
    ///
    /// # Errors
    ///
    /// What the file system refuses.
    pub fn write(
        &self,
        path: &Path,
        loaded: &LoadedMesh,
        segmentation: &Segmentation,
    ) -> Result<PathBuf, Failure> {
        let name = path.file_name().unwrap_or(OsStr::new("mesh"));
        let about = self.facts(path, loaded);
        write_results(
            &self.args.output,
            name,
            &loaded.mesh,
            segmentation,
            &about,
            self.write,
        )
        .map_err(|e| Failure {
            reason: e.to_string(),
            hint: e.hint().to_owned(),
        })
    }

    /// Tells a person what was done, and prints the report if it is asked for.
    ///
    /// # Errors
    ///
    /// Standard output takes no report.
    pub fn tell(
        &self,
        path: &Path,
        place: &Path,
        loaded: &LoadedMesh,
        segmentation: &Segmentation,
    ) -> Result<(), Failure> {
        if self.args.json {
            let about = self.facts(path, loaded);
            let report = report(&loaded.mesh, segmentation, &about);
            serde_json::to_string(&report)
                .map_err(Into::into)
                .and_then(|line| print(&line))
                .map_err(|e| Failure {
                    reason: format!("its report cannot be printed: {e}"),
                    hint: "check where standard output goes".to_owned(),
                })?;
        }
        if self.said.quiet {
            return Ok(());
        }
        let patches = counted(segmentation.patches.len(), "patch", "patches");
        let faces = counted(segmentation.face_patches.len(), "face", "faces");
        say(&format_args!(
            "{}: {patches} of {faces} -> {}",
            shown(path),
            shown(place)
        ));
        if let Some(changes) = &segmentation.changes {
            say(&format_args!("  {}", said_of(changes)));
        }
        if let Some(refined) = &segmentation.refined {
            let added = counted(refined.vertices_added, "vertex", "vertices");
            say(&format_args!("  refined: {added} added"));
        }
        if self.said.verbose {
            say_stages(loaded, segmentation);
        }
        Ok(())
    }

    fn facts<'b>(&'b self, path: &'b Path, loaded: &'b LoadedMesh) -> JobFacts<'b> {
        JobFacts {
            path,
            hash: &loaded.hash,
            format: loaded.format,
            bytes_len: loaded.bytes_len,
            markings: loaded.markings.as_ref(),
            settings: self.pipeline.settings_in_force(),
            program_version: VERSION,
            read_seconds: loaded.took.as_secs_f64(),
        }
    }
}

fn said_of(changes: &Changes) -> String {
    let edges = &changes.edges;
    let mut said = format!(
        "edges: {} kept, {} added, {} removed; open ends: {} closed",
        edges.kept, edges.added, edges.removed, changes.open_ends_closed
    );
    if changes.open_ends_left > 0 {
        said += &format!(", {} left", changes.open_ends_left);
    }
    if edges.at_borders > 0 {
        let borders = counted(edges.at_borders, "edge", "edges");
        said += &format!("; {borders} given on borders, which are boundaries anyway");
    }
    if edges.creases > 0 {
        let creases = counted(edges.creases, "edge", "edges");
        said += &format!("; {creases} inside a patch");
    }
    if edges.doubted > 0 {
        let doubted = counted(edges.doubted, "edge", "edges");
        said += &format!("; {doubted} doubted: contour-tracking.doubt_given=false takes them all");
    }
    said
}

fn say_stages(loaded: &LoadedMesh, segmentation: &Segmentation) {
    let read = loaded.took.as_secs_f64();
    say(&format_args!("  {:<10} {read:>9.3} s", "read"));
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
