//! Boundary curves as OBJ polylines.

use std::io::{self, Write};

use glam::DVec3;

use super::in_pieces;
use super::number::Shortest;

/// Curves that belong together.
#[derive(Clone, Debug)]
pub struct CurveGroup<'a> {
    /// Names of the group, with blanks between them; `patch_A_patch_B` for the curves two patches share.
    pub names: String,
    /// Vertices along each curve, two at least; a closed one repeats its first at the end.
    pub polylines: &'a [Vec<u32>],
}

/// Writes an OBJ of lines, group by group. Only vertices on a curve are
/// written, in order of first use, each coordinate so that it reads back as the same number.
///
/// # Errors
///
/// Whatever `out` refuses.
pub fn write_polylines(
    out: &mut impl Write,
    positions: &[DVec3],
    groups: &[CurveGroup<'_>],
) -> io::Result<()> {
    let mut number_of = vec![0u32; positions.len()];
    let mut used = Vec::new();
    for &vertex in groups.iter().flat_map(|group| group.polylines).flatten() {
        let number = &mut number_of[vertex as usize];
        if *number == 0 {
            used.push(vertex);
            *number = used.len() as u32;
        }
    }
    in_pieces(out, &used, |text, &vertex| {
        let [x, y, z] = positions[vertex as usize].to_array().map(Shortest);
        writeln!(text, "v {x} {y} {z}")
    })?;
    in_pieces(out, groups, |text, group| {
        writeln!(text, "g {}", group.names)?;
        for polyline in group.polylines {
            text.push(b'l');
            for &vertex in polyline {
                write!(text, " {}", number_of[vertex as usize])?;
            }
            text.push(b'\n');
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_vertices_on_a_curve_are_written() {
        let positions = [
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(0.1, 1e-20, -3.0),
            DVec3::Z,
        ];
        let (open, closed) = ([vec![3, 1]], [vec![1, 2, 3, 1], vec![2, 1]]);
        let groups = [
            CurveGroup {
                names: "patch_0_patch_4 old".to_owned(),
                polylines: &open,
            },
            CurveGroup {
                names: "patch_2_patch_3".to_owned(),
                polylines: &closed,
            },
        ];
        let mut out = Vec::new();
        write_polylines(&mut out, &positions, &groups).unwrap();
        let expected = "v 0 0 1\nv 1 0 0\nv 0.1 1e-20 -3\ng patch_0_patch_4 old\nl 1 2\ng patch_2_patch_3\nl 2 3 1 2\nl 3 2\n";
        assert_eq!(String::from_utf8(out).unwrap(), expected);
    }
}
