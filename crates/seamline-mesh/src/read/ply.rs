//! PLY, text and both binary orders, parsed by `ply-rs`.
//!
//! Elements other than `vertex` and `face`, and properties other than `x`, `y`, `z` and the list
//! `vertex_indices` (or `vertex_index`), are skipped. The header's counts are held against the bytes behind
//! it before memory is set aside. Bytes after the last element are left alone.

use ply_rs::parser::{Parser, Reader};
use ply_rs::ply::{ElementDef, Encoding, Header, KeyMap, PropertyType, ScalarType};

use super::check::{check, check_count};
use super::error::{Place, ReadError, quote};
use super::ply_rows::{FaceRow, Rows, SkippedRow, VertexRow, is_corner_list, least_size};
use crate::{Format, PolygonMesh};

const HEADER_HINT: &str = "a header is `ply`, `format ... 1.0`, `element NAME COUNT` with its `property` lines, `end_header`";
const ELEMENTS_HINT: &str = "needed are `element vertex` with x, y, z and `element face` with `property list ... vertex_indices`";

/// Reads a PLY.
pub(super) fn read(bytes: &[u8]) -> Result<PolygonMesh, ReadError> {
    let (header, mut rows) = open(bytes, require_elements)?;
    let mut positions = Vec::new();
    let mut starts = vec![0];
    let mut corners: Vec<u32> = Vec::new();
    for element in header.elements.values() {
        match element.name.as_str() {
            "vertex" => {
                positions.reserve_exact(element.count);
                rows.read(element, |VertexRow(position), place| {
                    positions.push(position);
                    if position.is_finite() {
                        Ok(())
                    } else {
                        Err(super::check::not_finite(place, position))
                    }
                })?;
            }
            "face" => {
                starts.reserve_exact(element.count);
                rows.read(element, |face: FaceRow, place| {
                    let count = face.corners().map(|corner| corners.push(corner)).count();
                    if count < 3 {
                        return Err(ReadError::FewCorners {
                            place,
                            corners: count,
                        });
                    }
                    check_count(corners.len(), "corners")?;
                    starts.push(corners.len() as u32);
                    Ok(())
                })?;
            }
            _ => rows.skip(element)?,
        }
    }

    let format = match header.encoding {
        Encoding::Ascii => Format::PlyAscii,
        Encoding::BinaryLittleEndian => Format::PlyLittleEndian,
        Encoding::BinaryBigEndian => Format::PlyBigEndian,
    };
    let mesh = PolygonMesh {
        format,
        positions,
        starts,
        corners,
    };
    check(&mesh).map_err(|fault| fault.in_numbers(&mesh))?;
    Ok(mesh)
}

/// The header, held against what is `required` of it and against the bytes there are, and the rows behind it.
pub(crate) fn open(
    bytes: &[u8],
    required: fn(&Header) -> Result<(), ReadError>,
) -> Result<(Header, Rows<'_>), ReadError> {
    let (header_text, payload) = split_header(bytes)?;
    let header = parse_header(&header_text)?;
    required(&header)?;
    require_bytes(&header, bytes.len() - payload)?;
    let rows = Rows {
        bytes,
        at: payload,
        encoding: header.encoding,
        line: header_text.lines().count() + 1,
    };
    Ok((header, rows))
}

/// The header with `\n` line ends, and where the payload starts. Comments may be in any encoding.
fn split_header(bytes: &[u8]) -> Result<(String, usize), ReadError> {
    // What ends the first line ends them all; in binary data a `\r` may well be followed by a `\n` of its own.
    let line_end: &[u8] = match &bytes[3..] {
        [b'\r', b'\n', ..] => b"\r\n",
        [b'\r', ..] => b"\r",
        _ => b"\n",
    };
    let mut text = String::new();
    let mut at = 0;
    while let Some(length) = bytes[at..]
        .windows(line_end.len())
        .position(|w| w == line_end)
    {
        let line = bytes[at..at + length].trim_ascii();
        at += length + line_end.len();
        text.push_str(&String::from_utf8_lossy(line));
        text.push('\n');
        if line == b"end_header" {
            return Ok((text, at));
        }
        if !line.is_ascii() && !line.starts_with(b"comment") && !line.starts_with(b"obj_info") {
            return Err(bad_header_line(&text, text.lines().count()));
        }
    }
    Err(ReadError::Truncated {
        what: "PLY ends inside its header, before `end_header`".to_owned(),
    })
}

fn parse_header(text: &str) -> Result<Header, ReadError> {
    let parsed = Parser::<SkippedRow>::new().read_header(&mut Reader::new(text.as_bytes()));
    let header = parsed.map_err(|e| match e.line() {
        Some(line) => bad_header_line(text, line),
        None => ReadError::Syntax {
            place: Place::Line(2),
            reason: "no `format` line with a version".to_owned(),
            hint: HEADER_HINT,
        },
    })?;

    // A name given twice replaces its forerunner there, and every byte after it would be read wrong.
    let said = |word: &str| text.lines().filter(|line| line.starts_with(word)).count();
    let properties: usize = header.elements.values().map(|e| e.properties.len()).sum();
    if said("element ") + said("element\t") != header.elements.len()
        || said("property ") + said("property\t") != properties
    {
        return Err(ReadError::Syntax {
            place: Place::Line(text.lines().count()),
            reason: "the header declares an element or a property twice".to_owned(),
            hint: HEADER_HINT,
        });
    }
    Ok(header)
}

fn bad_header_line(text: &str, line: usize) -> ReadError {
    let content = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
    let reason = format!("`{}` is no line of a PLY header", quote(content.as_bytes()));
    ReadError::Syntax {
        place: Place::Line(line),
        reason,
        hint: HEADER_HINT,
    }
}

/// Refuses a header without the elements and properties a mesh needs.
fn require_elements(header: &Header) -> Result<(), ReadError> {
    let missing = |reason: &str| {
        let place = Place::Line(1);
        Err(ReadError::Syntax {
            place,
            reason: reason.to_owned(),
            hint: ELEMENTS_HINT,
        })
    };
    let elements: &KeyMap<ElementDef> = &header.elements;
    let Some(vertex) = elements.get("vertex") else {
        return missing("the header declares no `element vertex`");
    };
    let is_scalar = |name: &&str| {
        vertex
            .properties
            .get(*name)
            .is_some_and(|p| matches!(p.data_type, PropertyType::Scalar(_)))
    };
    if let Some(absent) = ["x", "y", "z"].iter().find(|name| !is_scalar(name)) {
        return missing(&format!("the vertices have no number `{absent}`"));
    }
    let Some(face) = elements.get("face") else {
        if elements.contains_key("tristrips") {
            return missing(
                "the faces are triangle strips (`element tristrips`), which cannot be read",
            );
        }
        return Err(ReadError::NoFaces {
            format: "PLY",
            vertices: vertex.count,
        });
    };
    let mut lists = face.properties.values().filter(|p| is_corner_list(&p.name));
    let corners_are_whole = lists.next().is_some_and(|p| match &p.data_type {
        PropertyType::List(_, item) => !matches!(item, ScalarType::Float | ScalarType::Double),
        PropertyType::Scalar(_) => false,
    });
    if !corners_are_whole || lists.next().is_some() {
        return missing(
            "the faces have no list of whole numbers `vertex_indices`, or more than one",
        );
    }
    Ok(())
}

/// Refuses counts that cannot fit in the bytes there are.
fn require_bytes(header: &Header, there: usize) -> Result<(), ReadError> {
    let of_element = |e: &ElementDef| e.count.saturating_mul(least_size(e, header.encoding));
    let least = header
        .elements
        .values()
        .map(of_element)
        .fold(0usize, usize::saturating_add);
    // The last word of a text file needs no line end behind it.
    if least <= there + usize::from(header.encoding == Encoding::Ascii) {
        return Ok(());
    }
    let declared: Vec<String> = header
        .elements
        .values()
        .map(|e| format!("{} x {}", e.count, quote(e.name.as_bytes())))
        .collect();
    let what = format!(
        "PLY header declares {} (at least {least} bytes), but {there} bytes follow",
        declared.join(", ")
    );
    Err(ReadError::Truncated { what })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ply(vertex: &str, face: &str, body: &str) -> String {
        format!("ply\nformat ascii 1.0\n{vertex}{face}end_header\n{body}")
    }

    const VERTEX: &str = "element vertex 3\nproperty float x\nproperty double y\nproperty int z\n";
    const FACE: &str = "element face 1\nproperty list uchar int vertex_indices\n";

    fn message(text: &str) -> String {
        read(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn numbers_of_any_type_are_coordinates() {
        let mesh =
            read(ply(VERTEX, FACE, "0 0 0\n1.5 0 0\n0 1e-1 7\n3 2 1 0\n").as_bytes()).unwrap();
        assert_eq!(mesh.positions[2].to_array(), [0.0, 0.1, 7.0]);
        assert_eq!(mesh.corners, [2, 1, 0]);
    }

    #[test]
    fn faces_may_come_before_vertices() {
        let text = ply(FACE, VERTEX, "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
        assert_eq!(read(text.as_bytes()).unwrap().face_count(), 1);
    }

    #[test]
    fn line_ends_may_be_crlf_or_cr_and_comments_in_any_encoding() {
        let text = ply(VERTEX, FACE, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2");
        for line_end in ["\r\n", "\r"] {
            assert!(
                read(text.replace('\n', line_end).as_bytes()).is_ok(),
                "{line_end:?}"
            );
        }
        let text = ply(
            "comment caf@\n",
            &format!("{VERTEX}{FACE}"),
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        );
        let bytes: Vec<u8> = text
            .bytes()
            .map(|b| if b == b'@' { 0xE9 } else { b })
            .collect();
        assert!(read(&bytes).is_ok());
    }

    #[test]
    fn errors_name_the_line() {
        let body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
        let text = |from, to| ply(VERTEX, FACE, &body.replace(from, to));
        assert_eq!(
            message(&text("1 0 0", "1 nan 0")),
            "line 11: coordinate `nan` is not a finite number"
        );
        assert_eq!(
            message(&text("1 0 0", "1 x 0")),
            "line 11: `1 x 0` does not hold x y z"
        );
        assert_eq!(
            message(&text("3 0 1 2", "2 0 1")),
            "line 13: a face with 2 corners; three are needed at least"
        );
        assert_eq!(
            message(&text("3 0 1 2", "3 0 1 3")),
            "face 1: the face names vertex 3, but the file has 3 (counted from 0)"
        );
        assert_eq!(
            message(&text("3 0 1 2", "3 0 1 -1")),
            "face 1: the face names vertex 4294967295, but the file has 3 (counted from 0)"
        );
        assert_eq!(
            message("ply\nformat ascii 1.0\nelement vertex\nend_header\n"),
            "line 3: `element vertex` is no line of a PLY header"
        );
    }

    #[test]
    fn what_a_mesh_needs_is_asked_for() {
        assert!(message(&ply(FACE, "", "")).contains("no `element vertex`"));
        assert!(
            message(&ply(
                "element vertex 1\nproperty float x\nproperty float y\n",
                FACE,
                ""
            ))
            .contains("`z`")
        );
        assert!(
            message(&ply(
                VERTEX,
                "element face 1\nproperty list uchar float vertex_indices\n",
                ""
            ))
            .contains("whole")
        );
        let strips = "element tristrips 1\nproperty list int int vertex_indices\n";
        assert!(message(&ply(VERTEX, strips, "")).contains("triangle strips"));
        assert_eq!(
            message(&ply(VERTEX, "", "0 0 0\n1 0 0\n0 1 0\n")),
            "PLY without a face (3 vertices)"
        );
        let twice = format!("{VERTEX}property float x\n");
        assert!(message(&ply(&twice, FACE, "")).contains("twice"));
    }

    #[test]
    fn a_shorter_copy_is_seen_to_be_incomplete() {
        let text = ply(VERTEX, FACE, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        for end in 4..text.len() - 2 {
            let error = read(&text.as_bytes()[..end]).unwrap_err();
            assert!(error.is_truncated(), "cut at {end}: {error}");
        }
    }
}
