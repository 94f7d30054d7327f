//! Edges as the lines of an OBJ: its `l` elements, each a run of vertices.

use glam::DVec3;

use super::edges::EdgeList;
use super::{Markings, MarkingsError};
use crate::read::{ObjLines, quote};
use crate::{Mesh, Place};

/// Vertices of an OBJ of lines lie this near to those of the mesh, as a share of the diagonal of its bounding box: what
/// writing coordinates in single precision, or with seven digits, moves them by.
const SAME_PLACE_SHARE: f64 = 1e-6;

/// Reads `l` elements. Where the file has vertices of its own, they are looked for on the mesh by their place; else
/// numbers are those of the mesh's file, from 1.
pub(super) fn read(bytes: &[u8], mesh: &Mesh) -> Result<Markings, MarkingsError> {
    let mut edges = EdgeList::of(mesh);
    let mut own: Vec<(DVec3, usize)> = Vec::new();
    let mut runs: Vec<(Vec<i64>, usize)> = Vec::new();
    for (number, line) in ObjLines::new(bytes) {
        let mut words = line
            .split(u8::is_ascii_whitespace)
            .filter(|w| !w.is_empty());
        match words.next() {
            Some(b"v") => own.push((place_of(words), number)),
            Some(b"l") => {
                let run = words
                    .take_while(|word| !word.starts_with(b"#"))
                    .map(|word| vertex_number(word, own.len(), number))
                    .collect::<Result<Vec<i64>, _>>()?;
                runs.push((run, number));
            }
            _ => {}
        }
    }
    let of_own = (!own.is_empty()).then(|| Places::of(mesh));
    for (run, number) in runs {
        let place = Place::Line(number);
        let vertex = |name: &i64| match &of_own {
            None => edges.vertex(name - 1, place),
            Some(places) => {
                let at = usize::try_from(name - 1).ok().and_then(|v| own.get(v));
                let (at, line) = at.ok_or_else(|| {
                    MarkingsError::at(
                        place,
                        format!(
                            "vertex {name}, but the file has {} (counted from 1)",
                            own.len()
                        ),
                        "a line is `l a b ...` with vertices of its own file",
                    )
                })?;
                places.nearest(*at, Place::Line(*line))
            }
        };
        let vertices: Vec<u32> = run.iter().map(vertex).collect::<Result<_, _>>()?;
        for (ends, names) in vertices.windows(2).zip(run.windows(2)) {
            edges.add([ends[0], ends[1]], [names[0], names[1]], place)?;
        }
    }
    edges.finish()
}

fn place_of<'a>(words: impl Iterator<Item = &'a [u8]>) -> DVec3 {
    let number = |word: &[u8]| std::str::from_utf8(word).ok()?.parse::<f64>().ok();
    let mut at = words.map(|word| number(word).unwrap_or(f64::NAN));
    let mut next = || at.next().unwrap_or(f64::NAN);
    DVec3::new(next(), next(), next())
}

/// `7` or `7/1`; negative numbers count back from the vertex before the line.
fn vertex_number(word: &[u8], above: usize, line: usize) -> Result<i64, MarkingsError> {
    let number = word.split(|&b| b == b'/').next().unwrap_or_default();
    let number = std::str::from_utf8(number)
        .ok()
        .and_then(|n| n.parse::<i64>().ok());
    match number {
        Some(back) if back < 0 => Ok(above as i64 + back + 1),
        Some(number) => Ok(number),
        None => Err(MarkingsError::at(
            Place::Line(line),
            format!("`{}` is no vertex", quote(word)),
            "a line is `l a b ...` with vertex numbers from 1",
        )),
    }
}

/// The vertices of a mesh by their place.
struct Places<'a> {
    mesh: &'a Mesh,
    by_x: Vec<u32>,
    reach: f64,
}

impl<'a> Places<'a> {
    fn of(mesh: &'a Mesh) -> Self {
        let mut by_x: Vec<u32> = (0..mesh.positions().len() as u32).collect();
        by_x.sort_by(|&a, &b| {
            let x = |v: u32| mesh.positions()[v as usize].x;
            x(a).total_cmp(&x(b))
        });
        let [low, high] = mesh.bounding_box();
        Self {
            mesh,
            by_x,
            reach: SAME_PLACE_SHARE * low.distance(high),
        }
    }

    fn nearest(&self, at: DVec3, place: Place) -> Result<u32, MarkingsError> {
        if !at.is_finite() {
            return Err(MarkingsError::at(
                place,
                "the vertex is not three finite numbers",
                "a vertex is `v x y z`, in the mesh's own coordinates",
            ));
        }
        let position = |v: &u32| self.mesh.positions()[*v as usize];
        let from = self
            .by_x
            .partition_point(|v| position(v).x < at.x - self.reach);
        let near = self.by_x[from..]
            .iter()
            .take_while(|v| position(v).x <= at.x + self.reach)
            .filter(|v| position(v).distance(at) <= self.reach);
        let by_distance = |a: &&u32, b: &&u32| {
            let distance = |v: &u32| position(v).distance(at);
            distance(a).total_cmp(&distance(b))
        };
        near.min_by(by_distance).copied().ok_or_else(|| {
            let nearest = self.by_x.iter().min_by(by_distance);
            let far = nearest.map_or(f64::INFINITY, |v| position(v).distance(at));
            MarkingsError::at(
                place,
                format!("the mesh has no vertex there; the nearest is {far:.3e} away"),
                "lines with vertices of their own run along edges of the mesh, in its own coordinates",
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::markings::test_meshes::two_quads;

    fn message(text: &str) -> String {
        read(text.as_bytes(), &two_quads()).unwrap_err().to_string()
    }

    #[test]
    fn lines_without_vertices_number_those_of_the_mesh() {
        let read = read(b"g seam\nl 2 3/1 # why\nl 2 5\n", &two_quads()).unwrap();
        assert_eq!(read, Markings::Edges(vec![[1, 2], [1, 4]]));
    }

    #[test]
    fn lines_with_vertices_are_looked_for_by_place() {
        let text = b"v 1.0000003 0 0\nv 1 1 0\nv 2 0 0\nl 3 -3 2\n";
        let read = read(text, &two_quads()).unwrap();
        assert_eq!(read, Markings::Edges(vec![[1, 2], [1, 4]]));
    }

    #[test]
    fn what_does_not_fit_is_told_with_its_line() {
        assert_eq!(
            message("v 0 0 0\nv 1 0 0.5\nl 1 2\n"),
            "line 2: the mesh has no vertex there; the nearest is 5.000e-1 away"
        );
        assert_eq!(
            message("v 0 0 0\nv nan 0 0\nl 1 2\n"),
            "line 2: the vertex is not three finite numbers"
        );
        assert_eq!(
            message("v 0 0 0\nl 1 2\n"),
            "line 2: vertex 2, but the file has 1 (counted from 1)"
        );
        assert_eq!(
            message("l 1 6\n"),
            "line 1: vertices 1 and 6 are not joined by an edge of the mesh"
        );
        assert_eq!(message("l 1 x\n"), "line 1: `x` is no vertex");
        assert_eq!(message("v 0 0 0\n"), "names no edge");
    }
}
