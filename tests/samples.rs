//! The sample parts in `data`: what is committed, and that it is cut as it was made.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use seamline_mesh::read_bytes;
use seamline_tests::samples::samples;
use seamline_tests::{same_partition, segment};

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data")
}

/// Every mesh below a folder, by its path from there.
fn meshes_below(folder: &Path, from: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("its entries can be read").path();
        if path.is_dir() {
            meshes_below(&path, from, found);
        } else if !["rs", "md"]
            .iter()
            .any(|e| path.extension() == Some(e.as_ref()))
        {
            let relative = path.strip_prefix(from).expect("it lies below");
            found.insert(relative.display().to_string());
        }
    }
}

#[test]
fn committed_samples_are_byte_for_byte_what_the_program_makes() {
    let mut committed = BTreeSet::new();
    meshes_below(&data(), &data(), &mut committed);
    let made: BTreeSet<_> = samples()
        .iter()
        .map(|sample| sample.path.to_owned())
        .collect();
    assert_eq!(committed, made);
    for sample in samples() {
        let committed = fs::read(data().join(sample.path)).expect(sample.path);
        assert!(
            committed == sample.bytes,
            "{} is not what `cargo run --release -p seamline-tests --example make_samples` makes",
            sample.path
        );
    }
}

#[test]
fn samples_are_small() {
    let sizes: Vec<_> = samples().iter().map(|sample| sample.bytes.len()).collect();
    assert!(sizes.iter().all(|&size| size < 200_000), "{sizes:?}");
    assert!(sizes.iter().sum::<usize>() < 600_000, "{sizes:?}");
}

#[test]
fn the_default_profile_cuts_every_sample_into_the_surfaces_it_was_made_of() {
    for sample in samples() {
        let mesh = read_bytes(&sample.bytes, Path::new(sample.path)).expect(sample.path);
        let found = segment(mesh, &[]);
        assert_eq!(found.patches.len(), sample.patch_count(), "{}", sample.path);
        assert!(
            same_partition(&found.face_patches, &sample.patches),
            "{}: the patches are not the surfaces",
            sample.path
        );
    }
}

#[test]
fn the_readme_of_the_samples_names_each_with_its_number_of_patches() {
    let readme = fs::read_to_string(data().join("README.md")).expect("there is one");
    for sample in samples() {
        let start = format!("| `{}` |", sample.path);
        let end = format!("| {} |", sample.patch_count());
        assert!(
            readme
                .lines()
                .any(|line| line.starts_with(&start) && line.ends_with(&end)),
            "{start} ... {end}"
        );
    }
}
