//! Binary STL: 80 bytes of header, a count, and 50 bytes a triangle, all little-endian.
//!
//! Three vertices a triangle, none shared. The normals in the file are not read: they follow from the
//! vertices, and where they do not, the vertices are right.

use glam::DVec3;
use rayon::prelude::*;

use super::check::{Fault, check, check_count, not_finite};
use super::error::{Place, ReadError};
use crate::{Format, PolygonMesh};

const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// How many triangles the header counts. `None` if the header itself is cut off.
fn declared(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER)?.first_chunk()?;
    Some(u32::from_le_bytes(*count) as usize)
}

/// Whether the length of the file is just what the count asks for.
pub(super) fn binary_length_fits(bytes: &[u8]) -> bool {
    declared(bytes).is_some_and(|count| count > 0 && bytes.len() == HEADER + TRIANGLE * count)
}

/// Reads a binary STL. More bytes than the count asks for are left alone.
pub(super) fn read(bytes: &[u8]) -> Result<PolygonMesh, ReadError> {
    let Some(count) = declared(bytes) else {
        let what = format!(
            "binary STL ends inside its header ({} bytes, {HEADER} needed)",
            bytes.len()
        );
        return Err(ReadError::Truncated { what });
    };
    let needed = HEADER + TRIANGLE * count;
    let body = &bytes[HEADER..];
    if bytes.len() < needed {
        let inside = body.len() / TRIANGLE + 1;
        let what = format!(
            "binary STL ends inside triangle {inside} of {count} ({} bytes, {needed} needed)",
            bytes.len()
        );
        return Err(ReadError::Truncated { what });
    }

    check_count(3 * count, "corners")?;
    let triangles: &[[u8; TRIANGLE]] = &body.as_chunks().0[..count];
    let mut positions = vec![DVec3::ZERO; 3 * count];
    positions
        .as_chunks_mut()
        .0
        .par_iter_mut()
        .zip(triangles)
        .with_min_len(4096)
        .for_each(|(corners, record): (&mut [DVec3; 3], _)| {
            for (corner, xyz) in corners.iter_mut().zip(record[12..48].as_chunks::<12>().0) {
                *corner = position(xyz);
            }
        });
    let mesh = PolygonMesh {
        format: Format::StlBinary,
        positions,
        starts: (0..=count as u32).map(|face| 3 * face).collect(),
        corners: (0..3 * count as u32).collect(),
    };
    check(&mesh).map_err(|fault| match fault {
        Fault::NotFinite { vertex } => {
            not_finite(Place::Face(vertex / 3 + 1), mesh.positions[vertex])
        }
        other => other.in_numbers(&mesh),
    })?;
    Ok(mesh)
}

fn position(xyz: &[u8; 12]) -> DVec3 {
    let [x, y, z] = [0, 4, 8].map(|at| {
        f64::from(f32::from_le_bytes([
            xyz[at],
            xyz[at + 1],
            xyz[at + 2],
            xyz[at + 3],
        ]))
    });
    DVec3::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(declared: u32, triangles: usize) -> Vec<u8> {
        let mut bytes = vec![b' '; 80];
        bytes.extend(declared.to_le_bytes());
        for i in 0..triangles {
            bytes.extend([0; 12]);
            bytes.extend((0..9).flat_map(|k| ((i * 9 + k) as f32).to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    #[test]
    fn corners_come_in_file_order() {
        let mesh = read(&file(2, 2)).unwrap();
        assert_eq!(mesh.positions[4], DVec3::new(12.0, 13.0, 14.0));
        assert_eq!(mesh.face(1), [3, 4, 5]);
    }

    #[test]
    fn bytes_after_the_last_triangle_are_left_alone() {
        assert_eq!(read(&file(1, 3)).unwrap().face_count(), 1);
    }

    #[test]
    fn a_count_beyond_the_bytes_is_a_truncated_file() {
        let error = read(&file(u32::MAX, 2)).unwrap_err();
        assert!(error.is_truncated(), "{error}");
        assert_eq!(
            error.to_string(),
            "binary STL ends inside triangle 3 of 4294967295 (184 bytes, 214748364834 needed): the copy is incomplete"
        );
    }

    #[test]
    fn a_coordinate_that_is_not_finite_is_found() {
        let mut bytes = file(2, 2);
        bytes[84 + 50 + 12 + 4..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
        assert_eq!(
            read(&bytes).unwrap_err().to_string(),
            "face 2: coordinate `inf` is not a finite number"
        );
    }

    #[test]
    fn no_triangles_are_refused() {
        assert!(matches!(
            read(&file(0, 0)).unwrap_err(),
            ReadError::NoFaces { .. }
        ));
    }
}
