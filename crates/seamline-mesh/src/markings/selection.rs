//! A selection as CGAL saves it, `NAME.selection.txt`: three lines with the numbers of the selected vertices, of the
//! selected faces, and of the ends of the selected edges, two an edge, as CGAL's `Seam_mesh::add_seams` reads them. The demo
//! of 2014 numbered edges in the order of its own halfedges instead, which nobody else knows: such a file does not fit.

use super::edges::EdgeList;
use super::{Markings, MarkingsError};
use crate::markings::labels::numbered;
use crate::read::quote;
use crate::{Mesh, Place};

const HINT: &str = "a selection has three lines: vertices, faces, and edges as pairs of vertices, all counted from 0";

/// The selected faces against the rest.
pub(super) fn read_faces(bytes: &[u8], mesh: &Mesh) -> Result<Markings, MarkingsError> {
    let [_, faces, edges] = lines(bytes)?;
    let count = mesh.polygons.face_count();
    let mut selected = vec![false; count];
    for &face in &faces {
        let at = usize::try_from(face).ok().filter(|&face| face < count);
        let at = at.ok_or_else(|| {
            MarkingsError::at(
                Place::Line(2),
                format!("face {face}, but the mesh has {count} (counted from 0)"),
                "the selection was made on another mesh",
            )
        })?;
        selected[at] = true;
    }
    if faces.is_empty() {
        let hint = match edges.len() / 2 {
            0 => "select the faces of one patch and save the selection anew".to_owned(),
            count => format!("it selects edges ({count}): use --edges"),
        };
        return Err(MarkingsError::whole("selects no face", hint));
    }
    numbered(&selected, mesh)
}

/// The selected edges.
pub(super) fn read_edges(bytes: &[u8], mesh: &Mesh) -> Result<Markings, MarkingsError> {
    let [_, faces, ends] = lines(bytes)?;
    let place = Place::Line(3);
    if ends.is_empty() {
        let hint = match faces.len() {
            0 => "select edges and save the selection anew".to_owned(),
            count => format!("it selects faces ({count}): use --labels"),
        };
        return Err(MarkingsError::whole("selects no edge", hint));
    }
    let (pairs, []) = ends.as_chunks::<2>() else {
        let reason = format!("{} numbers, which are no pairs", ends.len());
        return Err(MarkingsError::at(place, reason, HINT));
    };
    let mut edges = EdgeList::of(mesh);
    for &names in pairs {
        let [a, b] = names;
        let vertices = [edges.vertex(a, place)?, edges.vertex(b, place)?];
        edges.add(vertices, names, place)?;
    }
    edges.finish()
}

/// The numbers of the first three lines.
fn lines(bytes: &[u8]) -> Result<[Vec<i64>; 3], MarkingsError> {
    let mut found = [const { Vec::new() }; 3];
    for (at, line) in bytes.split(|&b| b == b'\n').enumerate() {
        for word in line
            .split(u8::is_ascii_whitespace)
            .filter(|w| !w.is_empty())
        {
            let number = std::str::from_utf8(word)
                .ok()
                .and_then(|word| word.parse().ok());
            let (Some(number), Some(numbers)) = (number, found.get_mut(at)) else {
                let reason = format!("`{}` does not belong in a selection", quote(word));
                return Err(MarkingsError::at(Place::Line(at + 1), reason, HINT));
            };
            numbers.push(number);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::markings::test_meshes::two_quads;

    #[test]
    fn selected_faces_are_one_patch_and_the_rest_another() {
        let read = read_faces(b"0 1 \n1 \n\n", &two_quads()).unwrap();
        assert_eq!(read, Markings::Labels(vec![0, 1]));
    }

    #[test]
    fn selected_edges_are_pairs_of_vertices() {
        let read = read_edges(b"\n\n1 2 4 1 \n", &two_quads()).unwrap();
        assert_eq!(read, Markings::Edges(vec![[1, 2], [1, 4]]));
    }

    #[test]
    fn a_selection_of_the_other_kind_says_so() {
        let faces = read_faces(b"\n\n1 2\n", &two_quads()).unwrap_err();
        assert_eq!(faces.hint(), "it selects edges (1): use --edges");
        let edges = read_edges(b"\n0\n\n", &two_quads()).unwrap_err();
        assert_eq!(edges.hint(), "it selects faces (1): use --labels");
    }

    #[test]
    fn numbers_that_do_not_fit_are_told_with_their_line() {
        let face = read_faces(b"\n0 2\n\n", &two_quads()).unwrap_err();
        assert_eq!(
            face.to_string(),
            "line 2: face 2, but the mesh has 2 (counted from 0)"
        );
        let odd = read_edges(b"\n\n1 2 3\n", &two_quads()).unwrap_err();
        assert_eq!(odd.to_string(), "line 3: 3 numbers, which are no pairs");
        let word = read_edges(b"\n\n1 2\n4\n", &two_quads()).unwrap_err();
        assert_eq!(
            word.to_string(),
            "line 4: `4` does not belong in a selection"
        );
    }
}
