//! A mesh as a file holds it, before welding and triangulation.

use glam::DVec3;

/// The file format a mesh came in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// STL, binary.
    StlBinary,
    /// STL, text.
    StlAscii,
    /// Wavefront OBJ.
    Obj,
    /// PLY, text.
    PlyAscii,
    /// PLY, binary, least significant byte first.
    PlyLittleEndian,
    /// PLY, binary, most significant byte first.
    PlyBigEndian,
    /// Not from a file: built in memory.
    Memory,
}

impl Format {
    /// The name used in reports: `"stl-binary"`, `"obj"`, ...
    pub fn name(self) -> &'static str {
        match self {
            Self::StlBinary => "stl-binary",
            Self::StlAscii => "stl-ascii",
            Self::Obj => "obj",
            Self::PlyAscii => "ply-ascii",
            Self::PlyLittleEndian => "ply-binary-little-endian",
            Self::PlyBigEndian => "ply-binary-big-endian",
            Self::Memory => "memory",
        }
    }
}

/// Vertices and faces in file order. Faces are polygons of any size; face `f` has the corners
/// `corners[starts[f]..starts[f + 1]]`, each an index into `positions`.
///
/// Every position is finite, every corner is in range and every face has three corners at least: the
/// readers refuse anything else.
#[derive(Clone, Debug)]
pub struct PolygonMesh {
    /// Where it came from.
    pub format: Format,
    /// One a vertex, in the file's own unit. STL has three vertices a face and shares none.
    pub positions: Vec<DVec3>,
    /// First corner of each face, and one past the last: `face count + 1` numbers.
    pub starts: Vec<u32>,
    /// The corners of all faces, one face after the other.
    pub corners: Vec<u32>,
}

impl PolygonMesh {
    /// A mesh of triangles.
    pub fn from_triangles(format: Format, positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        Self {
            format,
            positions,
            starts: (0..=triangles.len() as u32).map(|face| face * 3).collect(),
            corners: triangles.as_flattened().to_vec(),
        }
    }

    /// How many faces the file has.
    pub fn face_count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The corners of one face.
    pub fn face(&self, face: usize) -> &[u32] {
        &self.corners[self.starts[face] as usize..self.starts[face + 1] as usize]
    }
}
