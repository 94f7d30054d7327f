//! CAD meshes whose patches are known: a folder of `NAME-VARIANT.stl`, each with its truth in a `.seg` beside it.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use seamline_mesh::{Mesh, read, weld};

/// The tessellations there are, and what stands for each in the name of a file.
pub const VARIANTS: [&str; 3] = ["coarse", "fine", "uniform"];

/// One mesh and its patches.
pub struct Model {
    /// The name of its file, without ending: `gear-fine`.
    pub name: String,
    /// Which of [`VARIANTS`] it is.
    pub variant: usize,
    /// Welded; its triangles are those of the file, in their order.
    pub mesh: Arc<Mesh>,
    /// The label of each triangle.
    pub truth: Vec<u32>,
}

impl Model {
    /// The part, of which there are several tessellations: `gear`.
    pub fn part(&self) -> &str {
        let end = format!("-{}", VARIANTS[self.variant]);
        self.name.strip_suffix(&end).unwrap_or(&self.name)
    }

    fn load(path: &Path) -> Option<Self> {
        let name = path.file_stem()?.to_str()?;
        let variant = VARIANTS
            .iter()
            .position(|variant| name.ends_with(variant))?;
        let labels = fs::read_to_string(path.with_extension("seg")).expect("its truth");
        Some(Self {
            name: name.to_owned(),
            variant,
            mesh: Arc::new(weld(read(path).expect("the model reads"), 0.0)),
            truth: labels
                .lines()
                .map(|line| line.parse().expect("a label"))
                .collect(),
        })
    }
}

/// All models of a folder, by name. Meshes of no known variant are left out.
///
/// # Panics
///
/// If the folder cannot be listed, or a mesh or its truth does not read.
pub fn models(folder: &Path) -> Vec<Model> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder can be listed")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|end| end == "stl"))
        .collect();
    paths.sort();
    paths.iter().filter_map(|path| Model::load(path)).collect()
}
