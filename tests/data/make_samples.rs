//! Writes the sample parts of this folder anew:
//!
//!     cargo run --release -p seamline-tests --example make_samples

use std::fs;
use std::io;
use std::path::Path;

use seamline_tests::samples::samples;

fn main() -> io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    for sample in samples() {
        let path = folder.join(sample.path);
        fs::create_dir_all(path.parent().unwrap_or(&folder))?;
        fs::write(&path, &sample.bytes)?;
        println!(
            "{}: {} bytes, {} faces, {} patches",
            sample.path,
            sample.bytes.len(),
            sample.patches.len(),
            sample.patch_count()
        );
    }
    Ok(())
}
