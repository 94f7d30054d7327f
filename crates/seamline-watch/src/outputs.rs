//! Results as files: for `part.stl` the folder `part.stl.seamline/`, whole or not at all.

mod folder;
mod report;
mod sweep;

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::thread;

use schemars::JsonSchema;
use seamline_ecs::settings::SettingsError;
use seamline_ecs::{Segmentation, Told};
use seamline_mesh::Mesh;
use seamline_mesh::write::{
    CurveGroup, VertexQuantities, write_labels, write_ply, write_polylines,
};
use serde::{Deserialize, Serialize};

use crate::fitted::fitted;
use crate::retry::is_full_disk;

pub use report::{JobFacts, REPORT_SCHEMA_VERSION, report};
pub use sweep::sweep_leftovers;

pub(crate) use sweep::{TEMPORARY_END, TEMPORARY_START, hold};

/// What the name of a result folder ends in.
pub const FOLDER_SUFFIX: &str = ".seamline";

/// One file of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum OutputFile {
    /// `labels.seg`: the patch of each input face, one a line.
    Labels,
    /// `patches.ply`: the mesh with patches, colours and curvatures.
    Patches,
    /// `boundaries.obj`: the boundary curves.
    Boundaries,
    /// `report.json`: everything that is told of the mesh and its patches.
    Report,
}

impl OutputFile {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Labels, Self::Patches, Self::Boundaries, Self::Report];

    /// The word for it in configurations and on the command line.
    pub fn word(self) -> &'static str {
        match self {
            Self::Labels => "labels",
            Self::Patches => "patches",
            Self::Boundaries => "boundaries",
            Self::Report => "report",
        }
    }

    /// Its name in the result folder.
    pub fn file_name(self) -> &'static str {
        match self {
            Self::Labels => "labels.seg",
            Self::Patches => "patches.ply",
            Self::Boundaries => "boundaries.obj",
            Self::Report => "report.json",
        }
    }
}

/// Which files a result consists of. Read from text, it is a list with commas: `labels,report`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WriteSet([bool; 4]);

impl WriteSet {
    /// Every file.
    pub const ALL: Self = Self([true; 4]);

    /// Is this file among them?
    pub fn has(self, file: OutputFile) -> bool {
        self.0[file as usize]
    }

    /// What these files tell of finished patches.
    pub fn told(self) -> Told {
        Told {
            patch_curvature: self.has(OutputFile::Report),
            vertex_curvature: self.has(OutputFile::Patches),
        }
    }
}

impl From<&[OutputFile]> for WriteSet {
    fn from(files: &[OutputFile]) -> Self {
        Self(OutputFile::ALL.map(|file| files.contains(&file)))
    }
}

impl FromStr for WriteSet {
    type Err = SettingsError;

    fn from_str(list: &str) -> Result<Self, SettingsError> {
        let words = list
            .split(',')
            .map(str::trim)
            .filter(|word| !word.is_empty());
        let files: Vec<_> = words
            .map(|word| {
                let known = OutputFile::ALL.into_iter().find(|file| file.word() == word);
                known.ok_or_else(|| {
                    SettingsError::unknown(
                        "write",
                        "file",
                        word,
                        OutputFile::ALL.map(OutputFile::word),
                    )
                })
            })
            .collect::<Result<_, _>>()?;
        if files.is_empty() {
            return Err(SettingsError::new(
                "write",
                "names no file",
                "wants a list such as `labels,report`",
            ));
        }
        Ok(Self::from(&files[..]))
    }
}

/// Why results could not be written. The input is not at fault.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The file system refused.
    #[error("{} cannot be written: {error}", .path.display())]
    Io {
        /// What was to be written.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// Something that is no result folder has its name.
    #[error("{} is in the way: it is not a folder", .path.display())]
    InTheWay {
        /// The name.
        path: PathBuf,
    },
}

impl OutputError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Io { .. } => {
                "check that the output folder may be written and that the disk has room"
            }
            Self::InTheWay { .. } => "move it away, or choose another output folder",
        }
    }

    /// Is there no more room on the disk?
    pub fn is_full_disk(&self) -> bool {
        matches!(self, Self::Io { error, .. } if is_full_disk(error))
    }

    pub(crate) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |error| Self::Io {
            path: path.to_owned(),
            error,
        }
    }
}

/// The folder that holds the results of an input of this name: its name and `.seamline`. A name that is too long
/// for that is shortened.
pub fn result_folder(destination_parent: &Path, input_name: &OsStr) -> PathBuf {
    destination_parent.join(fitted(input_name, FOLDER_SUFFIX))
}

/// Writes the results of one mesh to `destination_parent/input_name.seamline/` and gives that path.
///
/// The folder appears whole or not at all: it is written under another name, brought to disk and then
/// renamed. One that is there already is exchanged in one step and then deleted, with all that is in it.
///
/// # Errors
///
/// [`OutputError`]; what was there before is then still there.
pub fn write_results(
    destination_parent: &Path,
    input_name: &OsStr,
    mesh: &Mesh,
    segmentation: &Segmentation,
    about: &JobFacts<'_>,
    what: WriteSet,
) -> Result<PathBuf, OutputError> {
    let place = result_folder(destination_parent, input_name);
    let folder = folder::WholeFolder::begin(&place)?;
    let write = |file: OutputFile| {
        let path = folder.path().join(file.file_name());
        write_file(&path, |out| write_one(file, out, mesh, segmentation, about))
            .map_err(OutputError::io(&place.join(file.file_name())))
    };
    let write = &write;
    // Much of the time is spent waiting for the disk, file by file.
    thread::scope(|scope| {
        let files = OutputFile::ALL.into_iter().filter(|&file| what.has(file));
        let writing: Vec<_> = files.map(|file| scope.spawn(move || write(file))).collect();
        let written = writing.into_iter().map(|file| {
            file.join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        });
        written.collect::<Result<Vec<()>, _>>()
    })?;
    folder.commit()?;
    Ok(place)
}

fn write_file(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::new(File::create_new(path)?);
    fill(&mut out)?;
    out.into_inner()
        .map_err(io::IntoInnerError::into_error)?
        .sync_all()
}

fn write_one(
    file: OutputFile,
    out: &mut impl Write,
    mesh: &Mesh,
    segmentation: &Segmentation,
    about: &JobFacts<'_>,
) -> io::Result<()> {
    match file {
        OutputFile::Labels => write_labels(out, &segmentation.face_patches),
        OutputFile::Patches => {
            let refined = segmentation.refined.as_ref();
            let of = refined.map_or(&segmentation.vertices, |refined| &refined.vertices);
            let quantities = VertexQuantities {
                k_min: &of.k_min,
                k_max: &of.k_max,
                d_min: &of.d_min,
                d_max: &of.d_max,
            };
            let types = segmentation.patches.iter();
            let types: Option<Vec<u8>> = types
                .map(|patch| patch.surface.map(|surface| surface.shape.number()))
                .collect();
            let (polygons, patches) = match refined {
                Some(refined) => (&refined.polygons, &refined.patches),
                None => (&mesh.polygons, &segmentation.face_patches),
            };
            write_ply(out, polygons, quantities, patches, types.as_deref())
        }
        OutputFile::Boundaries => {
            let refined = segmentation.refined.as_ref();
            let positions = refined.map_or(mesh.positions(), |refined| &refined.polygons.positions);
            write_polylines(out, positions, &curve_groups(segmentation))
        }
        OutputFile::Report => {
            serde_json::to_writer_pretty(&mut *out, &report(mesh, segmentation, about))?;
            out.write_all(b"\n")
        }
    }
}

/// The curves of each pair of patches. Where boundaries were given, those that were kept are `old` and those that were
/// added `new`; what was removed and what lies inside one patch are groups of their own.
fn curve_groups(segmentation: &Segmentation) -> Vec<CurveGroup<'_>> {
    let boundaries = segmentation.boundaries.iter();
    let Some(changes) = &segmentation.changes else {
        return boundaries
            .map(|boundary| group_of(boundary.patches, "", &boundary.polylines))
            .collect();
    };
    let of_patches: Vec<CurveGroup<'_>> = match &segmentation.refined {
        Some(refined) => {
            let kept = refined.kept.iter().map(|curves| (curves, " old"));
            let added = refined.added.iter().map(|curves| (curves, " new"));
            kept.chain(added)
                .map(|((patches, polylines), mark)| group_of(*patches, mark, polylines))
                .collect()
        }
        None => boundaries
            .flat_map(|boundary| {
                [
                    group_of(boundary.patches, " old", &boundary.polylines),
                    group_of(boundary.patches, " new", &boundary.added),
                ]
            })
            .collect(),
    };
    let others = [
        ("removed", &changes.removed_curves),
        ("crease", &changes.crease_curves),
    ];
    let others = others.into_iter().map(|(name, polylines)| CurveGroup {
        names: name.to_owned(),
        polylines,
    });
    let all = of_patches.into_iter().chain(others);
    all.filter(|group| !group.polylines.is_empty()).collect()
}

fn group_of<'a>([a, b]: [u32; 2], mark: &str, polylines: &'a [Vec<u32>]) -> CurveGroup<'a> {
    CurveGroup {
        names: format!("patch_{a}_patch_{b}{mark}"),
        polylines,
    }
}

#[cfg(test)]
mod tests;
