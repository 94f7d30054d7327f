//! Triangle meshes as columns: what a file holds, welded and triangulated, and how it hangs together.
//!
//! Data flows one way: a reader gives a [`PolygonMesh`] (faces as the file has them), [`weld()`] turns it
//! into a [`Mesh`] (distinct positions, triangles, and the way back from triangle to input face), and
//! [`Topology::build`] finds edges and neighbours. Nothing here knows of curvature, of the ECS or of the
//! daemon.

mod findings;
mod markings;
mod mesh;
mod polygon_mesh;
mod read;
mod sets;
pub mod shapes;
mod topology;
mod triangulate;
mod weld;
pub mod write;

pub use findings::{Findings, examine};
pub use markings::{Markings, MarkingsError, Wanted};
pub use mesh::Mesh;
pub use polygon_mesh::{Format, PolygonMesh};
pub use read::{Place, ReadError, read, read_bytes};
pub use sets::Sets;
pub use topology::{Csr, EdgeKind, NO_FACE, Topology};
pub use triangulate::Triangulator;
pub use weld::{tolerance_from_share, weld};
