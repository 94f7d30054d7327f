//! How much memory there is, how much a mesh needs, and who may have it now.
//!
//! [`limit()`] says what all meshes in work may take together, [`estimate()`] what a file will take before it
//! is read, [`bytes_for_mesh`] what it takes once that is known, and a [`Gate`] lets in as many as fit.

mod estimate;
mod gate;
mod limit;

pub use estimate::{Estimate, START_BYTES, bytes_for_mesh, bytes_kept, estimate};
pub use gate::{Gate, Pass, TooLarge};
pub use limit::{limit, share_of_meshes};
