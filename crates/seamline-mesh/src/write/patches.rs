//! The segmented mesh as PLY: patches on faces, curvature on vertices.

use std::io::{self, Write};

use glam::DVec3;
use ply_rs::ply::{
    Addable, ElementDef, Encoding, Header, PropertyAccess, PropertyDef, PropertyType, ScalarType,
};
use ply_rs::writer::Writer;

use super::{PIECE, patch_colour};
use crate::PolygonMesh;

/// What is known of every vertex; each column has one value a vertex.
#[derive(Clone, Copy, Debug)]
pub struct VertexQuantities<'a> {
    /// Principal curvature of lesser size.
    pub k_min: &'a [f32],
    /// Principal curvature of greater size.
    pub k_max: &'a [f32],
    /// Unit directions that go with `k_min`.
    pub d_min: &'a [[f32; 3]],
    /// Unit directions that go with `k_max`.
    pub d_max: &'a [[f32; 3]],
}

/// Writes a binary little-endian PLY: the welded faces as the file had them, each with `int patch` and a
/// colour; each vertex with its coordinates (`float` if that is exact for all of them, else `double`) and
/// its `quantities`. With `surface_types` faces have `uchar surface_type` as well.
///
/// `patches` has one number a face, `surface_types` one a patch.
///
/// # Errors
///
/// Whatever `out` refuses; columns of the wrong length; vertex or patch numbers above `i32::MAX`.
pub fn write_ply(
    out: &mut impl Write,
    mesh: &PolygonMesh,
    quantities: VertexQuantities<'_>,
    patches: &[u32],
    surface_types: Option<&[u8]>,
) -> io::Result<()> {
    let vertices = mesh.positions.len();
    let VertexQuantities {
        k_min,
        k_max,
        d_min,
        d_max,
    } = quantities;
    let lengths = [k_min.len(), k_max.len(), d_min.len(), d_max.len()];
    if lengths != [vertices; 4] || patches.len() != mesh.face_count() {
        return Err(invalid("a column does not have one value a vertex or face"));
    }
    if let Some(types) = surface_types
        && patches.iter().any(|&patch| patch as usize >= types.len())
    {
        return Err(invalid("a patch has no surface type"));
    }
    if vertices > i32::MAX as usize || patches.iter().any(|&patch| patch > i32::MAX as u32) {
        return Err(invalid("a number is too large for the `int` of a PLY"));
    }

    let mut header = Header::new();
    header.encoding = Encoding::BinaryLittleEndian;
    let vertex = vertex_element(mesh);
    let face = face_element(mesh, surface_types.is_some());
    header.elements.add(vertex.clone());
    header.elements.add(face.clone());

    let mut bytes = Vec::with_capacity(2 * PIECE);
    let writer = Writer::<VertexRow>::new();
    writer.write_header(&mut bytes, &header)?;
    for v in 0..vertices {
        let ([a, b, c], [d, e, f]) = (d_min[v], d_max[v]);
        let row = VertexRow {
            position: mesh.positions[v],
            floats: [k_min[v], k_max[v], a, b, c, d, e, f],
        };
        writer.write_little_endian_element(&mut bytes, &row, &vertex)?;
        hand_on(out, &mut bytes)?;
    }
    let writer = Writer::<FaceRow>::new();
    let mut row = FaceRow::new();
    for (f, &patch) in patches.iter().enumerate() {
        row.corners.clear();
        row.corners
            .extend(mesh.face(f).iter().map(|&vertex| vertex as i32));
        row.patch = patch as i32;
        row.colour = patch_colour(patch);
        row.surface_type = surface_types.map_or(0, |types| types[patch as usize]);
        writer.write_little_endian_element(&mut bytes, &row, &face)?;
        hand_on(out, &mut bytes)?;
    }
    out.write_all(&bytes)
}

fn hand_on(out: &mut impl Write, bytes: &mut Vec<u8>) -> io::Result<()> {
    if bytes.len() >= PIECE {
        out.write_all(bytes)?;
        bytes.clear();
    }
    Ok(())
}

fn invalid(reason: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, reason)
}

const FLOATS: [&str; 8] = [
    "k_min", "k_max", "d_min_x", "d_min_y", "d_min_z", "d_max_x", "d_max_y", "d_max_z",
];

fn vertex_element(mesh: &PolygonMesh) -> ElementDef {
    let is_float = |p: &DVec3| p.as_vec3().as_dvec3() == *p;
    let coordinate = if mesh.positions.iter().all(is_float) {
        ScalarType::Float
    } else {
        ScalarType::Double
    };
    let mut element = ElementDef::new("vertex".to_owned());
    element.count = mesh.positions.len();
    for name in ["x", "y", "z"] {
        add(&mut element, name, PropertyType::Scalar(coordinate.clone()));
    }
    for name in FLOATS {
        add(&mut element, name, PropertyType::Scalar(ScalarType::Float));
    }
    element
}

fn face_element(mesh: &PolygonMesh, with_types: bool) -> ElementDef {
    let most = mesh
        .starts
        .windows(2)
        .map(|w| w[1] - w[0])
        .max()
        .unwrap_or(0);
    let length = if most <= u32::from(u8::MAX) {
        ScalarType::UChar
    } else {
        ScalarType::UInt
    };
    let mut element = ElementDef::new("face".to_owned());
    element.count = mesh.face_count();
    add(
        &mut element,
        "vertex_indices",
        PropertyType::List(length, ScalarType::Int),
    );
    add(&mut element, "patch", PropertyType::Scalar(ScalarType::Int));
    for name in ["red", "green", "blue"] {
        add(&mut element, name, PropertyType::Scalar(ScalarType::UChar));
    }
    if with_types {
        let name = "surface_type";
        add(&mut element, name, PropertyType::Scalar(ScalarType::UChar));
    }
    element
}

fn add(element: &mut ElementDef, name: &str, data_type: PropertyType) {
    element
        .properties
        .add(PropertyDef::new(name.to_owned(), data_type));
}

struct VertexRow {
    position: DVec3,
    /// In the order of [`FLOATS`].
    floats: [f32; 8],
}

impl PropertyAccess for VertexRow {
    fn new() -> Self {
        Self {
            position: DVec3::ZERO,
            floats: [0.0; 8],
        }
    }

    fn get_float(&self, name: &str) -> Option<f32> {
        match FLOATS.iter().position(|&float| float == name) {
            Some(place) => Some(self.floats[place]),
            None => self.get_double(name).map(|x| x as f32),
        }
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        match name {
            "x" => Some(self.position.x),
            "y" => Some(self.position.y),
            "z" => Some(self.position.z),
            _ => None,
        }
    }
}

struct FaceRow {
    corners: Vec<i32>,
    patch: i32,
    colour: [u8; 3],
    surface_type: u8,
}

impl PropertyAccess for FaceRow {
    fn new() -> Self {
        Self {
            corners: Vec::new(),
            patch: 0,
            colour: [0; 3],
            surface_type: 0,
        }
    }

    fn get_list_int(&self, _: &str) -> Option<&[i32]> {
        Some(&self.corners)
    }

    fn get_int(&self, _: &str) -> Option<i32> {
        Some(self.patch)
    }

    fn get_uchar(&self, name: &str) -> Option<u8> {
        match name {
            "red" => Some(self.colour[0]),
            "green" => Some(self.colour[1]),
            "blue" => Some(self.colour[2]),
            "surface_type" => Some(self.surface_type),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, read_bytes};
    use std::path::Path;

    fn written(mesh: &PolygonMesh, patches: &[u32]) -> io::Result<Vec<u8>> {
        let n = mesh.positions.len();
        let (k, d) = (vec![0.5; n], vec![[1.0, 0.0, 0.0]; n]);
        let mut out = Vec::new();
        write_ply(
            &mut out,
            mesh,
            VertexQuantities {
                k_min: &k,
                k_max: &k,
                d_min: &d,
                d_max: &d,
            },
            patches,
            None,
        )?;
        Ok(out)
    }

    fn mesh(step: f64, sides: u32) -> PolygonMesh {
        let positions = (0..sides)
            .map(|i| DVec3::new(f64::from(i) * step, f64::from(i * i), 0.0))
            .collect();
        PolygonMesh {
            format: Format::Memory,
            positions,
            starts: vec![0, sides, sides + 3],
            corners: (0..sides).chain([2, 1, 0]).collect(),
        }
    }

    #[test]
    fn polygons_and_coordinates_read_back() {
        for (step, sides) in [(0.5, 5), (0.1, 4), (0.25, 300)] {
            let mesh = mesh(step, sides);
            let back = read_bytes(&written(&mesh, &[7, 0]).unwrap(), Path::new("")).unwrap();
            assert_eq!(
                (back.positions, back.starts, back.corners),
                (mesh.positions, mesh.starts, mesh.corners)
            );
        }
    }

    #[test]
    fn the_header_says_what_there_is() {
        let bytes = written(&mesh(0.5, 4), &[0, 1]).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        let header = &text[..text.find("end_header").unwrap()];
        assert!(header.starts_with(
            "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
        ));
        assert!(header.contains("property float d_max_z\nelement face 2\nproperty list uchar int vertex_indices\nproperty int patch\nproperty uchar red\n"));
        assert_eq!(
            bytes.len(),
            header.len() + "end_header\n".len() + 4 * 44 + (1 + 16 + 7) + (1 + 12 + 7)
        );
        let text =
            String::from_utf8_lossy(&written(&mesh(0.1, 300), &[0, 1]).unwrap()).into_owned();
        assert!(text.contains("property double x\n") && text.contains("list uint int"));
    }

    #[test]
    fn a_column_of_the_wrong_length_is_refused() {
        assert_eq!(
            written(&mesh(1.0, 4), &[0]).unwrap_err().kind(),
            io::ErrorKind::InvalidInput
        );
    }
}
