//! What is saved or sent under the name of a mesh and is none: archives, CAD models, pictures, web pages.
//!
//! Only told apart, never opened: an archive is not unpacked.

use super::error::ReadError;

const UNPACK: &str = "unpack it, and give the mesh that is in it";
const EXPORT: &str = "open it in a CAD program, and export the part as STL, OBJ or PLY";
const FETCH_AGAIN: &str =
    "something else was saved under the name of the mesh; fetch the file itself";

/// Bytes at a fixed place, what they are the mark of, and what to do about it.
const MARKS: [(usize, &[u8], &str, &str); 18] = [
    (0, b"\x1F\x8B\x08", "a gzip archive", UNPACK),
    (
        0,
        b"PK\x03\x04",
        "a zip archive (as 3MF files are, too)",
        UNPACK,
    ),
    (0, b"PK\x05\x06", "an empty zip archive", FETCH_AGAIN),
    (0, b"7z\xBC\xAF\x27\x1C", "a 7z archive", UNPACK),
    (0, b"\xFD7zXZ\0", "an xz archive", UNPACK),
    // Behind `BZh` and a digit.
    (4, b"1AY&SY", "a bzip2 archive", UNPACK),
    (0, b"\x28\xB5\x2F\xFD", "a Zstandard archive", UNPACK),
    (0, b"Rar!\x1A\x07", "a RAR archive", UNPACK),
    (257, b"ustar", "a tar archive", UNPACK),
    // The first line of IGES, from column 73: section and number.
    (72, b"S      1", "an IGES model", EXPORT),
    (72, b"S0000001", "an IGES model", EXPORT),
    (
        0,
        b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1",
        "a compound document (some CAD and office programs write them)",
        EXPORT,
    ),
    (0, b"glTF", "a binary glTF scene", EXPORT),
    (0, b"Kaydara FBX Binary", "an FBX scene", EXPORT),
    (0, b"\xFF\xD8\xFF", "a JPEG picture", FETCH_AGAIN),
    (0, b"\x89PNG\r\n\x1A\n", "a PNG picture", FETCH_AGAIN),
    (0, b"%PDF-", "a PDF document", FETCH_AGAIN),
    (0, b"GIF8", "a GIF picture", FETCH_AGAIN),
];

/// First words of a text, in any case of letters and behind any white space.
const WORDS: [(&str, &str, &str); 6] = [
    ("ISO-10303-21;", "a STEP model", EXPORT),
    ("**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "a Parasolid model", EXPORT),
    ("<!DOCTYPE html", "a web page", WEB_PAGE),
    ("<html", "a web page", WEB_PAGE),
    ("<?xml", "an XML document", EXPORT_OR_FETCH),
    ("<!--", "an HTML or XML document", EXPORT_OR_FETCH),
];

const WEB_PAGE: &str = "a page, perhaps one that asks to log in, was saved under the name of the mesh; fetch the file itself";
const EXPORT_OR_FETCH: &str = "if it is a model (AMF, COLLADA), export it as STL, OBJ or PLY; if it is a web page, fetch the file itself";

/// Refuses what bears the mark of something else. Not to be asked of a binary STL whose length is right: its
/// header may hold any bytes.
pub(super) fn refuse_foreign(bytes: &[u8]) -> Result<(), ReadError> {
    let has_mark = |at: usize, mark: &[u8]| bytes.get(at..).is_some_and(|b| b.starts_with(mark));
    let marked = MARKS
        .iter()
        .find(|(at, mark, ..)| has_mark(*at, mark))
        .map(|&(_, _, what, hint)| (what, hint));
    let text = bytes[..bytes.len().min(4096)].trim_ascii_start();
    let begins = |word: &str| {
        text.get(..word.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(word.as_bytes()))
    };
    let worded = || {
        let found = WORDS.iter().find(|(word, ..)| begins(word));
        found.map(|&(_, what, hint)| (what, hint))
    };
    match marked.or_else(worded) {
        Some((what, hint)) => Err(ReadError::NotAMesh { what, hint }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::read_bytes;
    use super::*;

    /// Real beginnings, with something behind them.
    fn samples() -> Vec<(&'static str, Vec<u8>)> {
        let iges = ["S      1", "S0000001"].map(|end| format!("{:<72}{end}\n", "part of 1996"));
        let tar = [&b"part.stl\0"[..], &[0; 248], b"ustar\x0000"].concat();
        let starts: [(&str, &[u8]); 23] = [
            ("gzip", b"\x1F\x8B\x08\x08\xA1\x02part.stl\0"),
            ("zip", b"PK\x03\x04\x14\0\0\0\x08\0"),
            ("zip", b"PK\x05\x06\0\0\0\0"),
            ("7z", b"7z\xBC\xAF\x27\x1C\0\x04"),
            ("xz", b"\xFD7zXZ\0\0\x04\xE6"),
            ("bzip2", b"BZh91AY&SY\xB1"),
            ("Zstandard", b"\x28\xB5\x2F\xFD\x04\x58"),
            ("RAR", b"Rar!\x1A\x07\x01\0"),
            ("tar", &tar),
            ("STEP", b"ISO-10303-21;\r\nHEADER;\r\n"),
            ("IGES", iges[0].as_bytes()),
            ("IGES", iges[1].as_bytes()),
            ("compound", b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0\0"),
            ("Parasolid", b"**ABCDEFGHIJKLMNOPQRSTUVWXYZabc\n"),
            ("glTF", b"glTF\x02\0\0\0"),
            ("FBX", b"Kaydara FBX Binary  \0\x1A\0"),
            ("JPEG", b"\xFF\xD8\xFF\xE0\0\x10JFIF"),
            ("PNG", b"\x89PNG\r\n\x1A\n\0\0\0\rIHDR"),
            ("GIF", b"GIF89a\x01\0\x01\0"),
            ("PDF", b"%PDF-1.7\n%\xE2\xE3\n"),
            ("web page", b"\n\n <!doctype HTML>\n<head><title>Log in"),
            ("web page", b"<HTML lang=\"en\">"),
            ("XML", b"<?xml version=\"1.0\"?><amf>"),
        ];
        starts.map(|(what, start)| (what, start.to_vec())).into()
    }

    #[test]
    fn what_is_no_mesh_is_told_by_name_whatever_the_extension() {
        for (what, start) in samples() {
            for length in [start.len(), 70_000] {
                let mut bytes = start.clone();
                bytes.resize(length, b'7');
                for name in ["part.stl", "part.obj", "part.ply", "part"] {
                    let error = read_bytes(&bytes, Path::new(name)).unwrap_err();
                    let said = error.to_string();
                    assert!(
                        said.starts_with("is a") && said.contains(what),
                        "{name}: {said}"
                    );
                    assert!(said.ends_with(", not a mesh"), "{said}");
                    assert!(!error.is_truncated() && !error.hint().is_empty());
                }
            }
        }
    }

    #[test]
    fn a_byte_order_mark_does_not_hide_a_web_page() {
        let page = b"\xEF\xBB\xBF<!DOCTYPE html><title>Log in</title>";
        assert_eq!(
            read_bytes(page, Path::new("part.stl"))
                .unwrap_err()
                .to_string(),
            "is a web page, not a mesh"
        );
    }

    #[test]
    fn a_binary_stl_may_bear_any_mark_in_its_header() {
        for (what, start) in samples().into_iter().filter(|(_, s)| s.len() <= 80) {
            let mut bytes = start;
            bytes.resize(80, b' ');
            bytes.extend(1u32.to_le_bytes());
            bytes.extend([0; 12]);
            bytes.extend(
                [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
                    .map(f32::to_le_bytes)
                    .concat(),
            );
            bytes.extend([0; 2]);
            let mesh = read_bytes(&bytes, Path::new("part.stl"));
            assert_eq!(mesh.unwrap().face_count(), 1, "{what}");
        }
    }

    #[test]
    fn words_of_a_mesh_are_no_marks() {
        for text in ["solid <html\nendsolid\n", "# %PDF-\nv 0 0 0\n", "ply\n"] {
            assert!(refuse_foreign(text.as_bytes()).is_ok(), "{text}");
        }
    }
}
