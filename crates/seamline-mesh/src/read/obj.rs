//! Wavefront OBJ, parsed by `tobj`.
//!
//! `tobj` numbers vertices anew: model by model, by first use, and drops those no face uses. Seamline needs
//! the file's own numbers (edges given by the user name them) and all of its faces in file order. So
//! `tobj` is fed with one model only, whose first face names every vertex of the file in order: then the
//! order of first use is the order of the file, and its own first face is taken off again. Names,
//! materials, normals and texture coordinates are not handed to it at all, so that they can be in any
//! encoding and no other file is ever asked for.
//!
//! Of `v x y z ...` the three coordinates are read; a weight or a colour behind them is not. `l` and `p`
//! elements are no faces and are skipped.

use std::io::Write;

use glam::DVec3;
use tobj::{LoadError, LoadOptions};

use super::check::{Fault, check, check_count};
use super::error::{Place, ReadError, quote};
use super::obj_lines::{Feed, Lines, Statement, words};
use crate::{Format, PolygonMesh};

const HINT: &str =
    "a vertex is `v x y z`, a face is `f a b c ...` with indices from 1, or negative from the last";

/// Reads an OBJ.
pub(super) fn read(bytes: &[u8]) -> Result<PolygonMesh, ReadError> {
    let is_vertex = |line: &[u8]| matches!(Statement::of(line), Statement::Vertex(_));
    let vertices = Lines::new(bytes)
        .filter(|(_, line)| is_vertex(line))
        .count();
    check_count(vertices, "vertices")?;

    let options = LoadOptions {
        single_index: false,
        triangulate: false,
        ..LoadOptions::default()
    };
    let mut feed = Feed::new(face_of_all(vertices), bytes);
    let loaded = tobj::load_obj_buf(&mut feed, &options, |_| Err(LoadError::OpenFileFailed));
    let model = match loaded {
        Ok((models, _)) => models
            .into_iter()
            .next()
            .map(|model| model.mesh)
            .unwrap_or_default(),
        Err(LoadError::FaceVertexOutOfBounds) => return Err(out_of_range(bytes, vertices)),
        Err(_) => return Err(unreadable(bytes, feed.line)),
    };

    check_count(model.indices.len() - vertices, "corners")?;
    let mut starts = vec![0];
    if model.face_arities.is_empty() {
        // Without arities every face is a triangle, the one of all vertices too.
        starts.extend((3..=(model.indices.len() - vertices) as u32).step_by(3));
    } else {
        starts.extend(model.face_arities[1..].iter().scan(0, |end, arity| {
            *end += arity;
            Some(*end)
        }));
    }
    let mesh = PolygonMesh {
        format: Format::Obj,
        positions: model
            .positions
            .as_chunks()
            .0
            .iter()
            .map(|&xyz| DVec3::from_array(xyz))
            .collect(),
        starts,
        corners: model.indices[vertices..].to_vec(),
    };
    check(&mesh).map_err(|fault| located(bytes, fault, &mesh))?;
    Ok(mesh)
}

/// `f 1 2 3 ...` up to the last vertex.
fn face_of_all(vertices: usize) -> Vec<u8> {
    let mut line = b"f".to_vec();
    for vertex in 1..=vertices {
        // Writing to memory does not fail.
        let _ = write!(line, " {vertex}");
    }
    line.push(b'\n');
    line
}

/// The error for a line that `tobj` could not parse.
fn unreadable(bytes: &[u8], number: usize) -> ReadError {
    let line = Lines::new(bytes)
        .find(|(at, _)| *at == number)
        .map(|(_, line)| line)
        .unwrap_or_default();
    let what = match Statement::of(&line) {
        Statement::Face(_) => "a face",
        _ => "a vertex",
    };
    let reason = format!("`{}` is not {what}", quote(&line));
    ReadError::Syntax {
        place: Place::Line(number),
        reason,
        hint: HINT,
    }
}

/// The error for the first face that names a vertex that is not there.
fn out_of_range(bytes: &[u8], vertices: usize) -> ReadError {
    let mut above = 0;
    for (number, line) in Lines::new(bytes) {
        match Statement::of(&line) {
            Statement::Vertex(_) => above += 1,
            Statement::Face(corners) => {
                for index in words(corners).filter_map(vertex_index) {
                    let absolute = if index < 0 { above + index + 1 } else { index };
                    if absolute < 1 || absolute > vertices as i64 {
                        let numbering = "counted from 1";
                        return ReadError::OutOfRange {
                            place: Place::Line(number),
                            index,
                            vertices,
                            numbering,
                        };
                    }
                }
            }
            Statement::Other => {}
        }
    }
    ReadError::Syntax {
        place: Place::Line(0),
        reason: "a face names a vertex that is not there".to_owned(),
        hint: HINT,
    }
}

/// The vertex of a corner: `7`, `7/1`, `7//3` or `7/1/3`.
fn vertex_index(corner: &[u8]) -> Option<i64> {
    let vertex = corner.split(|&b| b == b'/').next()?;
    std::str::from_utf8(vertex).ok()?.parse().ok()
}

/// The error for a fault, with the line it is in.
fn located(bytes: &[u8], fault: Fault, mesh: &PolygonMesh) -> ReadError {
    let line_of = |wanted: usize, counts: fn(&Statement<'_>) -> bool| {
        let line = Lines::new(bytes)
            .filter(|(_, line)| counts(&Statement::of(line)))
            .nth(wanted);
        let (number, line) = line.unwrap_or_default();
        (Place::Line(number), line)
    };
    match fault {
        Fault::NotFinite { vertex } => {
            let (place, line) = line_of(vertex, |s| matches!(s, Statement::Vertex(_)));
            let is_finite = |word: &&[u8]| {
                std::str::from_utf8(word)
                    .ok()
                    .and_then(|w| w.parse::<f64>().ok())
                    .is_some_and(f64::is_finite)
            };
            let value = words(&line)
                .skip(1)
                .find(|word| !is_finite(word))
                .unwrap_or_default();
            ReadError::NotFinite {
                place,
                value: quote(value),
            }
        }
        Fault::FewCorners { face } => {
            let (place, _) = line_of(face, |s| matches!(s, Statement::Face(_)));
            ReadError::FewCorners {
                place,
                corners: mesh.face(face).len(),
            }
        }
        Fault::OutOfRange { .. } => out_of_range(bytes, mesh.positions.len()),
        Fault::NoFaces => fault.in_numbers(mesh),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERTICES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\n";

    fn obj(faces: &str) -> Result<PolygonMesh, ReadError> {
        read(format!("{VERTICES}{faces}").as_bytes())
    }

    fn message(faces: &str) -> String {
        obj(faces).unwrap_err().to_string()
    }

    #[test]
    fn vertices_keep_the_numbers_of_the_file() {
        let mesh = obj("f 4 3 1\nf 3 2 1\n").unwrap();
        assert_eq!(mesh.corners, [3, 2, 0, 2, 1, 0]);
        assert_eq!(mesh.positions.len(), 5);
        assert_eq!(mesh.positions[4], DVec3::splat(5.0));
    }

    #[test]
    fn a_file_of_three_vertices_and_triangles_only_reads_the_same() {
        let mesh = read(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 3 2 1\n").unwrap();
        assert_eq!((mesh.starts, mesh.corners), (vec![0, 3], vec![2, 1, 0]));
    }

    #[test]
    fn groups_and_materials_do_not_change_the_order_of_faces() {
        let faces = "mtllib /dev/zero\no b\nusemtl x\nf 1 2 3\ng a\nf 2 3 4\nusemtl x\nf 3 4 5\no b\nf 4 5 1 2\n";
        let mesh = obj(faces).unwrap();
        assert_eq!(mesh.corners, [0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 0, 1]);
        assert_eq!(mesh.starts, [0, 3, 6, 9, 13]);
    }

    #[test]
    fn negative_indices_count_from_the_vertices_above() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 2 2 2\nv 3 3 3\nf -1 -2 -5\n";
        assert_eq!(read(text.as_bytes()).unwrap().corners, [0, 1, 2, 4, 3, 0]);
    }

    #[test]
    fn a_face_may_come_before_its_vertices() {
        assert_eq!(
            read(b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n")
                .unwrap()
                .corners,
            [0, 1, 2]
        );
    }

    #[test]
    fn normals_texture_and_colours_are_passed_over() {
        let text = "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0\nvn x\nvt\nf 1/9/9 2//9 3/9\nl 1 2\np 1\n";
        assert_eq!(read(text.as_bytes()).unwrap().corners, [0, 1, 2]);
    }

    #[test]
    fn errors_name_the_line() {
        assert_eq!(
            message("f 1 2 3\nf 1 2 9\n"),
            "line 7: the face names vertex 9, but the file has 5 (counted from 1)"
        );
        assert_eq!(
            message("f 1 0 2\n"),
            "line 6: the face names vertex 0, but the file has 5 (counted from 1)"
        );
        assert_eq!(
            message("f -6 1 2\n"),
            "line 6: the face names vertex -6, but the file has 5 (counted from 1)"
        );
        assert_eq!(
            message("\ng x\nf 1 2 a\n"),
            "line 8: `f 1 2 a` is not a face"
        );
        assert_eq!(
            message("f 1 2 3\nf 1 2\n"),
            "line 7: a face with 2 corners; three are needed at least"
        );
        assert_eq!(message("v 1 2\n"), "line 6: `v 1 2` is not a vertex");
        assert_eq!(
            message("v 1 -inf 2\nf 1 2 3"),
            "line 6: coordinate `-inf` is not a finite number"
        );
        assert_eq!(message("# nothing\n"), "OBJ without a face (5 vertices)");
    }

    #[test]
    fn enormous_indices_are_out_of_range_and_nothing_worse() {
        for index in [i64::MAX, i64::MIN, i64::MAX / 3, 1 << 32] {
            assert!(matches!(
                obj(&format!("f 1 2 {index}\n")),
                Err(ReadError::OutOfRange { .. })
            ));
        }
    }
}
