//! Mesh files in: STL, OBJ and PLY, told apart by what they hold.
//!
//! Whatever a file says of itself (counts, indices, names of other files) is a claim: it is held against
//! the bytes that are there before memory is set aside for it, and no other file is ever opened.

mod check;
mod error;
mod foreign;
mod obj;
mod obj_lines;
mod ply;
mod ply_rows;
mod sniff;
mod stl;
mod stl_ascii;

use std::borrow::Cow;
use std::fs;
use std::path::Path;

pub use error::{Place, ReadError};

use crate::PolygonMesh;
use sniff::Kind;

pub(crate) use error::quote;
pub(crate) use obj_lines::Lines as ObjLines;
pub(crate) use ply::open as open_ply;

/// Reads a mesh file.
///
/// # Errors
///
/// [`ReadError`], whose text does not name the file.
pub fn read(path: &Path) -> Result<PolygonMesh, ReadError> {
    read_bytes(&fs::read(path)?, path)
}

/// Reads a mesh from the bytes of a file. `name_hint` is asked for its extension where the bytes leave
/// the format open; nothing is opened under that name.
///
/// # Errors
///
/// [`ReadError`], whose text does not name the file.
pub fn read_bytes(bytes: &[u8], name_hint: &Path) -> Result<PolygonMesh, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::Empty);
    }
    let bytes = &*as_eight_bit_text(bytes);
    match sniff::sniff(bytes, name_hint)? {
        Kind::StlBinary => stl::read(bytes),
        Kind::StlAscii => stl_ascii::read(bytes),
        Kind::Obj => obj::read(bytes),
        Kind::Ply => ply::read(bytes),
    }
}

/// Drops a UTF-8 byte-order mark and turns UTF-16 with a mark into UTF-8; anything else stays.
pub(crate) fn as_eight_bit_text(bytes: &[u8]) -> Cow<'_, [u8]> {
    let utf16 = |unit: fn([u8; 2]) -> u16| {
        let units = bytes[2..].as_chunks().0.iter().map(|&pair| unit(pair));
        let text: String = char::decode_utf16(units)
            .map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER))
            .collect();
        Cow::Owned(text.into_bytes())
    };
    match bytes {
        _ if stl::binary_length_fits(bytes) => Cow::Borrowed(bytes),
        [0xEF, 0xBB, 0xBF, rest @ ..] => Cow::Borrowed(rest),
        [0xFF, 0xFE, ..] => utf16(u16::from_le_bytes),
        [0xFE, 0xFF, ..] => utf16(u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    #[test]
    fn byte_order_marks_are_understood() {
        let marked: Vec<u8> = [b"\xEF\xBB\xBF", OBJ.as_bytes()].concat();
        let little: Vec<u8> = "\u{feff}"
            .encode_utf16()
            .chain(OBJ.encode_utf16())
            .flat_map(u16::to_le_bytes)
            .collect();
        let big: Vec<u8> = "\u{feff}"
            .encode_utf16()
            .chain(OBJ.encode_utf16())
            .flat_map(u16::to_be_bytes)
            .collect();
        for bytes in [marked, little, big] {
            let mesh = read_bytes(&bytes, Path::new("part.obj")).unwrap();
            assert_eq!(mesh.corners, [0, 1, 2]);
        }
    }

    #[test]
    fn a_missing_file_is_an_error_of_the_file_system() {
        let error = read(Path::new("no/such/part.stl")).unwrap_err();
        assert!(matches!(error, ReadError::Io(_)));
        assert!(!error.is_truncated());
    }
}
