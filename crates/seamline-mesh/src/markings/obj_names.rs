//! Labels as names in an OBJ: groups, objects, materials, smoothing groups.

use super::labels::numbered;
use super::{Markings, MarkingsError};
use crate::Mesh;
use crate::read::ObjLines;

/// What can tell the faces of an OBJ apart, and the word that begins its lines; in the order in which they are asked.
const KINDS: [(&str, &[u8]); 4] = [
    ("group", b"g"),
    ("object", b"o"),
    ("material", b"usemtl"),
    ("smoothing", b"s"),
];

/// Reads the names in force at each face. `by` says which; without it the first that has more than one.
pub(super) fn read(bytes: &[u8], by: Option<&str>, mesh: &Mesh) -> Result<Markings, MarkingsError> {
    let known = KINDS.map(|(kind, _)| kind).join(", ");
    if let Some(by) = by
        && !KINDS.iter().any(|(kind, _)| *kind == by)
    {
        let reason = format!("an OBJ has no `{by}` to tell faces by");
        return Err(MarkingsError::whole(reason, format!("there is {known}")));
    }
    let mut names: [Vec<Vec<u8>>; 4] = [const { Vec::new() }; 4];
    let mut of_face: [Vec<u32>; 4] = [const { Vec::new() }; 4];
    let mut in_force = [0u32; 4];
    for (_, line) in ObjLines::new(bytes) {
        let line = line.trim_ascii();
        let end = line
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(line.len());
        let (word, rest) = line.split_at(end);
        if word == b"f" {
            for (of_face, at) in of_face.iter_mut().zip(in_force) {
                of_face.push(at);
            }
        } else if let Some(kind) = KINDS.iter().position(|(_, begins)| *begins == word) {
            let name = rest.trim_ascii();
            // `s 0` is another word for `s off`.
            let name = if word == b"s" && name == b"0" {
                b"off"
            } else {
                name
            };
            let known = names[kind].iter().position(|known| known == name);
            in_force[kind] = 1 + known.unwrap_or(names[kind].len()) as u32;
            if known.is_none() {
                names[kind].push(name.to_owned());
            }
        }
    }
    let says_something = |kind: &usize| {
        let labels = &of_face[*kind];
        labels.iter().any(|label| *label != labels[0])
    };
    let chosen = match by {
        Some(by) => KINDS.iter().position(|(kind, _)| *kind == by),
        None => (0..KINDS.len()).find(says_something),
    };
    match chosen {
        Some(kind) => numbered(&of_face[kind], mesh),
        None => Err(MarkingsError::whole(
            "no group, object, material or smoothing group tells its faces apart",
            format!("give each patch one of these ({known}), or labels one a line"),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::markings::test_meshes::two_quads;

    const TEXT: &[u8] =
        b"o part\ng left\nusemtl a\ns 1\nf 1 2 3 4\ng left\ns off\nusemtl b\nf 7 5 6 8\n";

    #[test]
    fn the_first_kind_of_name_that_tells_faces_apart_is_taken() {
        let read = read(TEXT, None, &two_quads()).unwrap();
        assert_eq!(read, Markings::Labels(vec![0, 1]));
    }

    #[test]
    fn a_kind_that_is_named_is_taken() {
        let by = |by| read(TEXT, Some(by), &two_quads()).unwrap();
        assert_eq!(by("group"), Markings::Labels(vec![0, 0]));
        assert_eq!(by("smoothing"), Markings::Labels(vec![0, 1]));
    }

    #[test]
    fn an_obj_without_names_says_what_would_serve() {
        let error = read(b"f 1 2 3 4\nf 7 5 6 8\n", None, &two_quads()).unwrap_err();
        assert!(error.to_string().contains("tells its faces apart"));
        let unknown = read(TEXT, Some("layer"), &two_quads()).unwrap_err();
        assert_eq!(
            unknown.hint(),
            "there is group, object, material, smoothing"
        );
    }
}
