//! Why a file could not be read, where, and what to do about it.

use std::fmt;
use std::io;

/// Why a mesh file was refused.
///
/// `Display` is one line without the name of the file: the caller puts `path: ` before it. What to do
/// about it is in [`ReadError::hint`].
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file system refused.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// Not a single byte.
    #[error("the file is empty (0 bytes)")]
    Empty,
    /// Neither STL nor OBJ nor PLY.
    #[error("{reason}")]
    UnknownFormat {
        /// What was found instead.
        reason: String,
    },
    /// Something else that is known: an archive, a CAD model, a picture, a web page.
    #[error("is {what}, not a mesh")]
    NotAMesh {
        /// What it is, with its article.
        what: &'static str,
        /// What would be right.
        hint: &'static str,
    },
    /// Shorter than its own header or grammar promises.
    #[error("{what}: the copy is incomplete")]
    Truncated {
        /// What ends where, and how much is missing.
        what: String,
    },
    /// Something that is not what the format says it must be.
    #[error("{place}: {reason}")]
    Syntax {
        /// Where.
        place: Place,
        /// What is there, and what was expected.
        reason: String,
        /// What would be right.
        hint: &'static str,
    },
    /// A coordinate that is `nan`, infinite, or too large for 64 bits.
    #[error("{place}: coordinate `{value}` is not a finite number")]
    NotFinite {
        /// Where.
        place: Place,
        /// The coordinate as the file has it.
        value: String,
    },
    /// A face names a vertex that is not there.
    #[error("{place}: the face names vertex {index}, but the file has {vertices} ({numbering})")]
    OutOfRange {
        /// Where.
        place: Place,
        /// The index as the file has it.
        index: i64,
        /// How many vertices there are.
        vertices: usize,
        /// How the format counts.
        numbering: &'static str,
    },
    /// A face that is a point or a line.
    #[error("{place}: a face with {corners} corners; three are needed at least")]
    FewCorners {
        /// Where.
        place: Place,
        /// How many it has.
        corners: usize,
    },
    /// There is nothing to segment.
    #[error("{format} without a face ({vertices} vertices)")]
    NoFaces {
        /// Name of the format, for people.
        format: &'static str,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More than 32-bit numbers can count.
    #[error("{count} {what}: more than the {limit} that can be numbered")]
    TooLarge {
        /// How many.
        count: usize,
        /// Of what.
        what: &'static str,
        /// How many are possible.
        limit: u32,
    },
}

impl ReadError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Io(_) => "check that the file exists and may be read",
            Self::Empty => "the export or the copy wrote nothing; export it again",
            Self::UnknownFormat { .. } => {
                "STL, OBJ and PLY can be read; export the mesh as one of them"
            }
            Self::Truncated { .. } => "wait until the copy is complete, or copy the file again",
            Self::Syntax { hint, .. } | Self::NotAMesh { hint, .. } => hint,
            Self::NotFinite { .. } => "repair the vertex in the program that wrote the file",
            Self::OutOfRange { .. } => {
                "vertices may be missing, or the indices count from a different start; export it again"
            }
            Self::FewCorners { .. } => "remove points and lines from the faces of the export",
            Self::NoFaces { .. } => {
                "export a surface: points and curves alone cannot be cut into patches"
            }
            Self::TooLarge { .. } => "cut the mesh in pieces, or export it coarser",
        }
    }

    /// Whether the file is shorter than it says it is, so that it may be a copy still under way.
    pub fn is_truncated(&self) -> bool {
        matches!(self, Self::Truncated { .. } | Self::Empty)
    }
}

/// Where in a file something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line of a text file, from 1.
    Line(usize),
    /// A face in file order, from 1.
    Face(usize),
    /// A vertex in file order, from 1.
    Vertex(usize),
    /// A byte from the start of the file, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Face(face) => write!(f, "face {face}"),
            Self::Vertex(vertex) => write!(f, "vertex {vertex}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// A piece of a file for an error message: one line, printable, at most 40 characters.
pub(crate) fn quote(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let start = &bytes[..bytes.len().min(4 * LONGEST)];
    let text: String = String::from_utf8_lossy(start)
        .trim()
        .chars()
        .flat_map(char::escape_debug)
        .collect();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quotation_stays_on_one_short_line() {
        assert_eq!(quote(b"  v 1 2\t3\r\n"), "v 1 2\\t3");
        let long = quote(&[b'x'; 10_000]);
        assert_eq!(long.len(), 43);
        assert!(quote(b"a\nb\0\x1b[31m").chars().all(|c| !c.is_control()));
    }

    #[test]
    fn only_short_files_may_still_be_under_way() {
        assert!(ReadError::Empty.is_truncated());
        assert!(
            ReadError::Truncated {
                what: String::new()
            }
            .is_truncated()
        );
        assert!(
            !ReadError::NoFaces {
                format: "OBJ",
                vertices: 3
            }
            .is_truncated()
        );
    }
}
