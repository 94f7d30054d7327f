//! Which format a file is in: by what it holds first, by its name second.

use std::path::Path;

use super::error::{ReadError, quote};
use super::foreign::refuse_foreign;
use super::stl;

/// What kind of reader a file needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    StlBinary,
    StlAscii,
    Obj,
    Ply,
}

/// Words that start a line of an OBJ.
const OBJ_WORDS: [&str; 13] = [
    "v", "vn", "vt", "vp", "f", "l", "p", "o", "g", "s", "mtllib", "usemtl", "cstype",
];

/// Decides by content, then by the extension of `name`.
pub(super) fn sniff(bytes: &[u8], name: &Path) -> Result<Kind, ReadError> {
    // A header may begin with any word at all; a length that fits the count to the byte is no accident.
    if stl::binary_length_fits(bytes) {
        return Ok(Kind::StlBinary);
    }
    refuse_foreign(bytes)?;
    if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
        return Ok(Kind::Ply);
    }
    let extension = name
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default()
        .to_ascii_lowercase();
    let unknown = |reason: String| Err(ReadError::UnknownFormat { reason });
    if !is_text(bytes) {
        return match extension.as_str() {
            "stl" => Ok(Kind::StlBinary),
            "ply" => unknown("not a PLY: it does not begin with `ply`".to_owned()),
            "obj" => unknown("not a Wavefront OBJ: it is binary, not text".to_owned()),
            _ => unknown("binary data in none of the known formats".to_owned()),
        };
    }
    let first = first_word(bytes).to_ascii_lowercase();
    match (first.as_str(), extension.as_str()) {
        ("solid" | "facet", _) => Ok(Kind::StlAscii),
        (word, _) if OBJ_WORDS.contains(&word) => Ok(Kind::Obj),
        (_, "obj") => Ok(Kind::Obj),
        ("ply", "ply") => Ok(Kind::Ply),
        (_, "stl") => unknown(format!(
            "not an STL: text that begins with `{}`, not with `solid`",
            quote(first_line(bytes))
        )),
        (_, "ply") => unknown(format!(
            "not a PLY: it begins with `{}`, not with `ply`",
            quote(first_line(bytes))
        )),
        _ => unknown(format!(
            "text in none of the known formats (`{}`)",
            quote(first_line(bytes))
        )),
    }
}

/// Whether the first bytes can be text in some 8-bit encoding.
fn is_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(4096)];
    !start
        .iter()
        .any(|&b| matches!(b, 0..=8 | 14..=26 | 28..=31 | 127))
}

/// The first word that is not in a comment.
fn first_word(bytes: &[u8]) -> String {
    let start = &bytes[..bytes.len().min(1 << 20)];
    start
        .split(|&b| b == b'\n' || b == b'\r')
        .filter_map(|line| {
            line.split(u8::is_ascii_whitespace)
                .find(|word| !word.is_empty())
        })
        .find(|word| word[0] != b'#')
        .map(|word| String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned())
        .unwrap_or_default()
}

fn first_line(bytes: &[u8]) -> &[u8] {
    bytes
        .split(|&b| b == b'\n')
        .find(|line| !line.trim_ascii().is_empty())
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(bytes: &[u8], name: &str) -> Option<Kind> {
        sniff(bytes, Path::new(name)).ok()
    }

    #[test]
    fn content_beats_the_extension() {
        assert_eq!(
            kind(b"ply\nformat ascii 1.0\n", "part.stl"),
            Some(Kind::Ply)
        );
        assert_eq!(
            kind(b"# made by hand\n\nv 0 0 0\n", "part.stl"),
            Some(Kind::Obj)
        );
        assert_eq!(
            kind(b"\n  SOLID a\n facet normal 0 0 1", "part.obj"),
            Some(Kind::StlAscii)
        );
    }

    #[test]
    fn a_letter_is_no_stl_but_may_be_an_obj_without_faces() {
        assert_eq!(kind(b"Dear all,\n", "part.stl"), None);
        assert_eq!(kind(b"Dear all,\n", "part.obj"), Some(Kind::Obj));
        assert_eq!(kind(b"Dear all,\n", "part"), None);
    }

    #[test]
    fn a_compiled_object_file_is_no_wavefront_obj() {
        assert_eq!(kind(b"\x64\x86\x03\x00\x00\x00\x00\x00", "main.obj"), None);
    }
}
