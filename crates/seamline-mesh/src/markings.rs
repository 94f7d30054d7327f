//! What another tool has found on a mesh: a label for each of its faces, or edges where it is to be cut.
//!
//! Labels come as text, one a line; as a property or the colour of the faces of a PLY; as groups, objects,
//! materials or smoothing groups of an OBJ; or as the faces of a selection. Edges come as pairs of vertices, as
//! lines of an OBJ, or as the edges of a selection. Whatever they come as, they are held against the mesh: what
//! does not fit is told with its place.

mod edges;
mod error;
mod labels;
mod obj_names;
mod obj_polylines;
mod ply_faces;
mod selection;

use std::path::Path;

pub use error::MarkingsError;

use crate::Mesh;
use crate::read::as_eight_bit_text;

/// What is marked on a mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum Markings {
    /// One a face of the file, numbered from 0 without gaps by first face.
    Labels(Vec<u32>),
    /// Edges of triangles, as pairs of vertices of the [`Mesh`], lower number first; each once, sorted.
    Edges(Vec<[u32; 2]>),
}

/// What is looked for in a file of markings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted<'a> {
    /// Labels of faces. In a PLY or OBJ they are told by this: the name of a property or `colour`; `group`,
    /// `object`, `material` or `smoothing`. Without it, by the first that says more than one thing.
    Labels(Option<&'a str>),
    /// Edges.
    Edges,
}

impl Markings {
    /// Reads markings of `mesh` from the bytes of a file. `name_hint` is asked for its extension; nothing is
    /// opened under that name.
    ///
    /// | file | labels | edges |
    /// |---|---|---|
    /// | `.selection.txt`, as CGAL saves it | selected faces and the rest | selected edges |
    /// | PLY | a whole number or a colour a face; MeshLab's selection is in its `flags` | |
    /// | OBJ | group, object, material, smoothing group | `l` elements |
    /// | any other text | one whole number a line | two vertex numbers a line, from 0 |
    ///
    /// Vertex numbers are those of the mesh's own file. STL numbers no vertices: there they are those of distinct
    /// coordinates in order of first appearance. An OBJ of lines may bring its own vertices, which are then
    /// looked for on the mesh by their place.
    ///
    /// Cost: linear; n log n for lines with vertices of their own.
    ///
    /// # Errors
    ///
    /// [`MarkingsError`]: what cannot be read, and what does not fit the mesh, with its place.
    pub fn read(
        bytes: &[u8],
        name_hint: &Path,
        wanted: Wanted<'_>,
        mesh: &Mesh,
    ) -> Result<Self, MarkingsError> {
        let bytes = &*as_eight_bit_text(bytes);
        let is_ply = bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r");
        let ends = |end: &str| {
            let name = name_hint.to_string_lossy().to_lowercase();
            name.ends_with(end)
        };
        match wanted {
            Wanted::Labels(by) if is_ply => ply_faces::read(bytes, by, mesh),
            Wanted::Labels(by) if ends(".obj") => obj_names::read(bytes, by, mesh),
            Wanted::Labels(_) if ends(".selection.txt") => selection::read_faces(bytes, mesh),
            Wanted::Labels(_) => labels::read(bytes, mesh),
            Wanted::Edges if is_ply => Err(MarkingsError::whole(
                "is a PLY, in which edges are not looked for",
                "edges are pairs of vertices as text, lines of an OBJ, or a .selection.txt; for labels use --labels",
            )),
            Wanted::Edges if ends(".obj") => obj_polylines::read(bytes, mesh),
            Wanted::Edges if ends(".selection.txt") => selection::read_edges(bytes, mesh),
            Wanted::Edges => edges::read(bytes, mesh),
        }
    }
}

#[cfg(test)]
pub(crate) mod test_meshes {
    use glam::DVec3;

    use crate::{Format, Mesh, PolygonMesh, weld};

    /// Two squares side by side, four corners each; 6 and 7 of the eight vertices lie on 1 and 2.
    pub(crate) fn two_quads() -> Mesh {
        let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let positions = vec![
            at(0.0, 0.0),
            at(1.0, 0.0),
            at(1.0, 1.0),
            at(0.0, 1.0),
            at(2.0, 0.0),
            at(2.0, 1.0),
            at(1.0, 0.0),
            at(1.0, 1.0),
        ];
        let polygons = PolygonMesh {
            format: Format::Obj,
            positions,
            starts: vec![0, 4, 8],
            corners: vec![0, 1, 2, 3, 6, 4, 5, 7],
        };
        weld(polygons, 0.0)
    }

    /// The same as STL has it: triangles that share nothing.
    pub(crate) fn two_quads_stl() -> Mesh {
        let mesh = two_quads();
        let corners = mesh.triangles.as_flattened();
        let positions = corners
            .iter()
            .map(|&v| mesh.positions()[v as usize])
            .collect();
        let triangles: Vec<[u32; 3]> = (0..mesh.triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect();
        weld(
            PolygonMesh::from_triangles(Format::StlBinary, positions, &triangles),
            0.0,
        )
    }
}
