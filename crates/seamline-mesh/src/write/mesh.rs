//! Plain meshes as STL and OBJ.

use std::io::{self, Write};

use glam::DVec3;

use super::in_pieces;
use super::number::Shortest;
use crate::PolygonMesh;

/// Writes a binary STL. Coordinates are rounded to 32 bits.
///
/// # Errors
///
/// Whatever `out` refuses; more than `u32::MAX` triangles.
pub fn write_stl_binary(
    out: &mut impl Write,
    positions: &[DVec3],
    triangles: &[[u32; 3]],
) -> io::Result<()> {
    let mut header = [b' '; 80];
    header[..10].copy_from_slice(b"binary STL");
    out.write_all(&header)?;
    let count = u32::try_from(triangles.len())
        .map_err(|e| io::Error::new(io::ErrorKind::InvalidInput, e))?;
    out.write_all(&count.to_le_bytes())?;
    in_pieces(out, triangles, |bytes, triangle| {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        for row in [normal([a, b, c]), a, b, c] {
            row.to_array()
                .iter()
                .for_each(|&x| bytes.extend((x as f32).to_le_bytes()));
        }
        bytes.extend([0; 2]);
        Ok(())
    })
}

/// Writes an ASCII STL, each coordinate so that it reads back as the same number.
///
/// # Errors
///
/// Whatever `out` refuses.
pub fn write_stl_ascii(
    out: &mut impl Write,
    name: &str,
    positions: &[DVec3],
    triangles: &[[u32; 3]],
) -> io::Result<()> {
    writeln!(out, "solid {name}")?;
    in_pieces(out, triangles, |text, triangle| {
        let corners = triangle.map(|vertex| positions[vertex as usize]);
        let [x, y, z] = normal(corners).to_array().map(Shortest);
        writeln!(text, "  facet normal {x} {y} {z}\n    outer loop")?;
        for corner in corners {
            let [x, y, z] = corner.to_array().map(Shortest);
            writeln!(text, "      vertex {x} {y} {z}")?;
        }
        writeln!(text, "    endloop\n  endfacet")
    })?;
    writeln!(out, "endsolid {name}")
}

/// Writes an OBJ, faces as they are, each coordinate so that it reads back as the same number.
///
/// # Errors
///
/// Whatever `out` refuses.
pub fn write_obj(out: &mut impl Write, mesh: &PolygonMesh) -> io::Result<()> {
    in_pieces(out, &mesh.positions, |text, position| {
        let [x, y, z] = position.to_array().map(Shortest);
        writeln!(text, "v {x} {y} {z}")
    })?;
    let faces: Vec<&[u32]> = (0..mesh.face_count()).map(|face| mesh.face(face)).collect();
    in_pieces(out, &faces, |text, face| {
        text.push(b'f');
        for &vertex in *face {
            write!(text, " {}", u64::from(vertex) + 1)?;
        }
        text.push(b'\n');
        Ok(())
    })
}

/// The unit normal; zero for a triangle without area.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a)
        .normalize_or_zero()
        .cross((c - a).normalize_or_zero())
        .normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, read_bytes};
    use std::path::Path;

    fn prism() -> PolygonMesh {
        let positions = vec![
            DVec3::ZERO,
            DVec3::new(0.1, 0.0, 0.0),
            DVec3::new(0.0, 1e-9, 0.0),
            DVec3::Z / 3.0,
        ];
        PolygonMesh::from_triangles(
            Format::Memory,
            positions,
            &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        )
    }

    fn triangles(mesh: &PolygonMesh) -> Vec<[u32; 3]> {
        mesh.corners.as_chunks().0.to_vec()
    }

    #[test]
    fn text_formats_read_back_to_the_same_numbers() {
        let mesh = prism();
        let (mut obj, mut stl) = (Vec::new(), Vec::new());
        write_obj(&mut obj, &mesh).unwrap();
        write_stl_ascii(&mut stl, "prism", &mesh.positions, &triangles(&mesh)).unwrap();
        let back = read_bytes(&obj, Path::new("")).unwrap();
        assert_eq!(
            (back.positions, back.corners),
            (mesh.positions.clone(), mesh.corners.clone())
        );
        let back = read_bytes(&stl, Path::new("")).unwrap();
        let expected: Vec<DVec3> = mesh
            .corners
            .iter()
            .map(|&v| mesh.positions[v as usize])
            .collect();
        assert_eq!((back.format, back.positions), (Format::StlAscii, expected));
    }

    #[test]
    fn binary_stl_reads_back_in_32_bits() {
        let mesh = prism();
        let mut out = Vec::new();
        write_stl_binary(&mut out, &mesh.positions, &triangles(&mesh)).unwrap();
        let back = read_bytes(&out, Path::new("")).unwrap();
        let expected: Vec<DVec3> = mesh
            .corners
            .iter()
            .map(|&v| mesh.positions[v as usize].as_vec3().as_dvec3())
            .collect();
        assert_eq!((back.format, back.positions), (Format::StlBinary, expected));
    }
}
