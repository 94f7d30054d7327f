//! Labels as text: one whole number a line, one line a face.

use foldhash::HashMap;

use super::{Markings, MarkingsError};
use crate::read::quote;
use crate::{Mesh, Place};

/// Reads labels in the order of the faces. Blank lines and `#` comments do not count.
pub(super) fn read(bytes: &[u8], mesh: &Mesh) -> Result<Markings, MarkingsError> {
    let mut values = Vec::new();
    for (number, line) in text_lines(bytes) {
        let value = std::str::from_utf8(line)
            .ok()
            .and_then(|word| word.parse::<i64>().ok());
        values.push(value.ok_or_else(|| {
            MarkingsError::at(
                Place::Line(number),
                format!("`{}` is no label", quote(line)),
                "a label is one whole number a line, one line for each face of the mesh",
            )
        })?);
    }
    numbered(&values, mesh)
}

/// The lines of a text that say something, each with its number from 1.
pub(super) fn text_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    bytes
        .split(|&b| b == b'\n')
        .enumerate()
        .map(|(at, line)| {
            let end = line.iter().position(|&b| b == b'#').unwrap_or(line.len());
            (at + 1, line[..end].trim_ascii())
        })
        .filter(|(_, line)| !line.is_empty())
}

/// Labels of any values, one a face of the mesh, numbered by first face.
pub(super) fn numbered<T: Copy + Eq + std::hash::Hash>(
    values: &[T],
    mesh: &Mesh,
) -> Result<Markings, MarkingsError> {
    let faces = mesh.polygons.face_count();
    if values.len() != faces {
        let triangles = mesh.triangles.len();
        let hint = if values.len() == triangles {
            format!(
                "the mesh has {faces} faces, which make {triangles} triangles; give one label for each face as \
                 the file has it, or a mesh of triangles"
            )
        } else {
            "one label for each face of the mesh, in the order of its file; were they made for another mesh?"
                .to_owned()
        };
        return Err(MarkingsError::whole(
            format!("{} labels for {faces} faces", values.len()),
            hint,
        ));
    }
    let mut numbers: HashMap<T, u32> = HashMap::default();
    let number = |value: &T| {
        let next = numbers.len() as u32;
        *numbers.entry(*value).or_insert(next)
    };
    Ok(Markings::Labels(values.iter().map(number).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::markings::test_meshes::two_quads;

    #[test]
    fn labels_of_any_values_are_numbered_by_first_face() {
        let read = read(b"# made by hand\n-7\n\n 40 # the other\n", &two_quads()).unwrap();
        assert_eq!(read, Markings::Labels(vec![0, 1]));
    }

    #[test]
    fn a_wrong_number_of_labels_says_how_many_would_fit() {
        let error = read(b"1\n2\n3\n", &two_quads()).unwrap_err();
        assert_eq!(error.to_string(), "3 labels for 2 faces");
        let of_triangles = read(b"1\n1\n2\n2\n", &two_quads()).unwrap_err();
        assert!(
            of_triangles
                .hint()
                .contains("2 faces, which make 4 triangles"),
            "{}",
            of_triangles.hint()
        );
    }

    #[test]
    fn a_line_that_is_no_label_is_named() {
        let error = read(b"1\n\nwall\n", &two_quads()).unwrap_err();
        assert_eq!(error.to_string(), "line 3: `wall` is no label");
    }
}
