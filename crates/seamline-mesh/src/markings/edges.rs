//! Edges as text: two vertex numbers a line. And what every list of edges is held against.

use super::labels::text_lines;
use super::{Markings, MarkingsError};
use crate::read::quote;
use crate::{Csr, Format, Mesh, Place};

const HINT: &str = "an edge is two vertex numbers a line, counted from 0, as `17 4`";

/// Reads pairs of vertex numbers.
pub(super) fn read(bytes: &[u8], mesh: &Mesh) -> Result<Markings, MarkingsError> {
    let mut edges = EdgeList::of(mesh);
    for (number, line) in text_lines(bytes) {
        let place = Place::Line(number);
        let words: Vec<i64> = line
            .split(|b| b.is_ascii_whitespace() || *b == b',')
            .filter(|word| !word.is_empty())
            .filter_map(|word| std::str::from_utf8(word).ok()?.parse().ok())
            .collect();
        let [a, b] = words[..] else {
            let reason = format!("`{}` is no edge", quote(line));
            return Err(MarkingsError::at(place, reason, HINT));
        };
        let ends = [edges.vertex(a, place)?, edges.vertex(b, place)?];
        edges.add(ends, [a, b], place)?;
    }
    edges.finish()
}

/// Edges of a mesh, checked one by one.
pub(super) struct EdgeList<'a> {
    mesh: &'a Mesh,
    /// Triangles at each vertex.
    around: Csr,
    found: Vec<[u32; 2]>,
}

impl<'a> EdgeList<'a> {
    pub(super) fn of(mesh: &'a Mesh) -> Self {
        Self {
            mesh,
            around: Csr::inverse_of(mesh.positions().len(), &mesh.triangles),
            found: Vec::new(),
        }
    }

    /// How many vertices the file of the mesh numbers.
    fn numbered(&self) -> usize {
        if self.is_of_coordinates() {
            self.mesh.positions().len()
        } else {
            self.mesh.vertex_of_input.len()
        }
    }

    /// STL has no vertices to be numbered, only coordinates.
    fn is_of_coordinates(&self) -> bool {
        matches!(
            self.mesh.polygons.format,
            Format::StlAscii | Format::StlBinary
        )
    }

    /// The vertex of the mesh that has this number in its file.
    pub(super) fn vertex(&self, number: i64, place: Place) -> Result<u32, MarkingsError> {
        let count = self.numbered();
        match usize::try_from(number).ok().filter(|&v| v < count) {
            Some(v) if self.is_of_coordinates() => Ok(v as u32),
            Some(v) => Ok(self.mesh.vertex_of_input[v]),
            None => Err(MarkingsError::at(
                place,
                format!("vertex {number}, but the mesh has {count} (counted from 0)"),
                "edges name the mesh's own vertices; were they made for another mesh?",
            )),
        }
    }

    /// Adds the edge between two vertices of the mesh, which the file calls `names`.
    pub(super) fn add(
        &mut self,
        [a, b]: [u32; 2],
        names: [i64; 2],
        place: Place,
    ) -> Result<(), MarkingsError> {
        let [name_a, name_b] = names;
        if a == b {
            return Err(MarkingsError::at(
                place,
                format!("vertices {name_a} and {name_b} are one"),
                "an edge joins two vertices at different places",
            ));
        }
        let triangles = self.around.row(a as usize).iter();
        let joined = triangles
            .map(|&t| self.mesh.triangles[t as usize])
            .any(|corners| corners.contains(&b));
        if !joined {
            return Err(MarkingsError::at(
                place,
                format!("vertices {name_a} and {name_b} are not joined by an edge of the mesh"),
                "give the edges one by one; were they made for another mesh, or are they counted from 1?",
            ));
        }
        self.found.push([a.min(b), a.max(b)]);
        Ok(())
    }

    pub(super) fn finish(mut self) -> Result<Markings, MarkingsError> {
        if self.found.is_empty() {
            return Err(MarkingsError::whole("names no edge", HINT));
        }
        self.found.sort_unstable();
        self.found.dedup();
        Ok(Markings::Edges(self.found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::markings::test_meshes::{two_quads, two_quads_stl};

    fn message(text: &str) -> String {
        read(text.as_bytes(), &two_quads()).unwrap_err().to_string()
    }

    #[test]
    fn numbers_are_those_of_the_file_and_twins_are_one_vertex() {
        // Vertices 6 and 7 of the file lie on 1 and 2.
        let read = read(b"6 7\n# the same again\n2, 1\n", &two_quads()).unwrap();
        assert_eq!(read, Markings::Edges(vec![[1, 2]]));
    }

    #[test]
    fn an_stl_numbers_distinct_coordinates_by_first_appearance() {
        let mesh = two_quads_stl();
        let first = mesh.triangles[0];
        let text = format!("{} {}\n", first[0], first[1]);
        assert_eq!(
            read(text.as_bytes(), &mesh).unwrap(),
            Markings::Edges(vec![[first[0], first[1]]])
        );
        let error = read(b"0 6\n", &mesh).unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 1: vertex 6, but the mesh has 6 (counted from 0)"
        );
    }

    #[test]
    fn what_does_not_fit_is_told_with_its_line() {
        assert_eq!(message("1 2\n1 x\n"), "line 2: `1 x` is no edge");
        assert_eq!(
            message("1 2\n\n1 9\n"),
            "line 3: vertex 9, but the mesh has 8 (counted from 0)"
        );
        assert_eq!(
            message("0 5\n"),
            "line 1: vertices 0 and 5 are not joined by an edge of the mesh"
        );
        assert_eq!(message("1 6\n"), "line 1: vertices 1 and 6 are one");
        assert_eq!(message("# nothing\n"), "names no edge");
    }
}
