//! Meshes, labels and curves out. Every writer fills a stream and knows nothing of files.
//!
//! The same input gives the same bytes. Streams are written in large pieces, so that they need no buffer of
//! their own.

mod colour;
mod mesh;
mod number;
mod patches;
mod polylines;

use std::io::{self, Write};

pub use colour::patch_colour;
pub use mesh::{write_obj, write_stl_ascii, write_stl_binary};
pub use patches::{VertexQuantities, write_ply};
pub use polylines::{CurveGroup, write_polylines};

/// Pieces in which text is handed on.
const PIECE: usize = 1 << 16;

/// Writes one label a line, in order.
///
/// # Errors
///
/// Whatever `out` refuses.
pub fn write_labels(out: &mut impl Write, labels: &[u32]) -> io::Result<()> {
    in_pieces(out, labels, |text, label| writeln!(text, "{label}"))
}

/// Writes what `each` makes of every item, in pieces.
fn in_pieces<T>(
    out: &mut impl Write,
    items: &[T],
    mut each: impl FnMut(&mut Vec<u8>, &T) -> io::Result<()>,
) -> io::Result<()> {
    let mut text = Vec::with_capacity(2 * PIECE);
    for item in items {
        each(&mut text, item)?;
        if text.len() >= PIECE {
            out.write_all(&text)?;
            text.clear();
        }
    }
    out.write_all(&text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_one_a_line() {
        let labels: Vec<u32> = (0..50_000).chain([u32::MAX]).collect();
        let mut out = Vec::new();
        write_labels(&mut out, &labels).unwrap();
        let back: Vec<u32> = String::from_utf8(out)
            .unwrap()
            .lines()
            .map(|line| line.parse().unwrap())
            .collect();
        assert_eq!(back, labels);
    }
}
