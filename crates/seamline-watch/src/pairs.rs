//! Meshes and what another tool has marked on them, as pairs: `part.stl` with `part.seg` or `part.edges.txt`. A pure
//! state machine: the clock and the facts come from outside.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use seamline_mesh::Wanted;

use crate::tracker::ReadyFile;

/// Ends of the names of markings, and what is in them.
const ENDS: [(&str, Wanted<'static>); 2] = [
    (".seg", Wanted::Labels(None)),
    (".edges.txt", Wanted::Edges),
];

/// What is looked for in a file of this name, if it is one of markings.
pub fn markings_in(path: &Path) -> Option<Wanted<'static>> {
    let name = path.file_name()?.to_string_lossy().to_lowercase();
    let end = ENDS.iter().find(|(end, _)| name.ends_with(end));
    end.map(|&(_, wanted)| wanted)
}

/// What the two halves of a pair have in common: the path of a mesh without its ending, or of markings without theirs.
pub fn stem(path: &Path) -> PathBuf {
    let name = path
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let end = ENDS.iter().find(|(end, _)| name.ends_with(end));
    match end {
        // `.edges.txt` counts as two endings.
        Some((end, _)) if end.matches('.').count() == 2 => {
            path.with_extension("").with_extension("")
        }
        _ => path.with_extension(""),
    }
}

/// The names a mesh may have that belongs to the markings of this name.
pub fn meshes_of(markings: &Path) -> [PathBuf; 3] {
    ["stl", "obj", "ply"].map(|end| with_end(&stem(markings), &format!(".{end}")))
}

/// Where markings go whose mesh goes to `mesh`: beside it, under its stem and with their own ending.
pub fn beside(mesh: &Path, markings: &Path) -> PathBuf {
    let name = markings
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let end = ENDS.iter().find(|(end, _)| name.ends_with(end));
    with_end(&stem(mesh), end.map_or("", |(end, _)| end))
}

/// The markings that may lie beside a mesh.
pub fn markings_of(mesh: &Path) -> [PathBuf; 2] {
    ENDS.map(|(end, _)| with_end(&stem(mesh), end))
}

fn with_end(stem: &Path, end: &str) -> PathBuf {
    let mut name = stem.file_name().unwrap_or(OsStr::new("")).to_owned();
    name.push(end);
    stem.with_file_name(name)
}

/// What has become complete, or is given up to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Complete {
    /// Both halves hold still.
    Pair {
        /// The mesh.
        mesh: ReadyFile,
        /// What is marked on it.
        markings: ReadyFile,
    },
    /// A half whose other half has not come.
    Lone(ReadyFile),
    /// A mesh beside which lie both labels and edges.
    Crowded(ReadyFile),
}

/// Why a half is not worked on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unpaired {
    /// Its other half has not come.
    Lone,
    /// It has more than one other half.
    Crowded,
}

#[derive(Clone, Debug)]
struct Half {
    file: ReadyFile,
    since: Instant,
    /// It was given out, with its other half or without.
    given: bool,
}

#[derive(Clone, Debug, Default)]
struct Pair {
    meshes: BTreeMap<PathBuf, Half>,
    markings: BTreeMap<PathBuf, Half>,
}

/// Follows the halves of pairs, once each of them holds still by itself, and gives them out together.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    by_stem: BTreeMap<PathBuf, Pair>,
}

impl Pairs {
    /// Takes in halves that have become ready and gives what has become complete.
    ///
    /// A mesh with two kinds of markings is given as such. A pair is given when both halves hold still, and again when either has come to rest in another state. A half
    /// alone is given after `max_wait`, or at once if `nothing_comes`. `holds` tells whether a file is still in the state
    /// in which it became ready; one that is not waits to become ready anew, or is gone.
    pub fn step(
        &mut self,
        now: Instant,
        ready: Vec<ReadyFile>,
        holds: &dyn Fn(&ReadyFile) -> bool,
        max_wait: &dyn Fn(&Path) -> Duration,
        nothing_comes: bool,
    ) -> Vec<Complete> {
        for file in ready {
            let pair = self.by_stem.entry(stem(&file.path)).or_default();
            let is_markings = markings_in(&file.path).is_some();
            let path = file.path.clone();
            let half = Half {
                file,
                since: now,
                given: false,
            };
            if is_markings {
                pair.meshes.values_mut().for_each(|mesh| mesh.given = false);
                pair.markings.insert(path, half);
            } else {
                pair.meshes.insert(path, half);
            }
        }
        let mut complete = Vec::new();
        for pair in self.by_stem.values_mut() {
            pair.meshes.retain(|_, mesh| holds(&mesh.file));
            pair.markings.retain(|_, half| holds(&half.file));
            let is_over = |half: &Half| {
                nothing_comes
                    || now.saturating_duration_since(half.since) >= max_wait(&half.file.path)
            };
            for mesh in pair.meshes.values_mut().filter(|mesh| !mesh.given) {
                let file = mesh.file.clone();
                let mut beside = pair.markings.values_mut();
                match (beside.next(), beside.next()) {
                    (None, _) if is_over(mesh) => complete.push(Complete::Lone(file)),
                    (None, _) => continue,
                    (Some(markings), None) => {
                        markings.given = true;
                        complete.push(Complete::Pair {
                            mesh: file,
                            markings: markings.file.clone(),
                        });
                    }
                    // The markings stay where they are: once one of them is taken away, the other serves.
                    (Some(one), Some(other)) => {
                        one.given = true;
                        other.given = true;
                        complete.push(Complete::Crowded(file));
                    }
                }
                mesh.given = true;
            }
            for markings in pair.markings.values_mut() {
                if !markings.given && is_over(markings) {
                    markings.given = true;
                    complete.push(Complete::Lone(markings.file.clone()));
                }
            }
        }
        self.by_stem
            .retain(|_, pair| !pair.meshes.is_empty() || !pair.markings.is_empty());
        complete
    }
}

#[cfg(test)]
mod tests;
