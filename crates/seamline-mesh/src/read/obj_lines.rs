//! The lines of an OBJ that make its geometry, one by one, as a reader can be fed with them.

use std::borrow::Cow;
use std::io::{self, BufRead, Read};

/// The logical lines of an OBJ, each with the number of its first line: a backslash at the end of a line
/// joins it to the next.
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    next_number: usize,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            next_number: 1,
        }
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self
            .rest
            .iter()
            .position(|&b| b == b'\n')
            .unwrap_or(self.rest.len());
        let line = &self.rest[..end];
        self.rest = self.rest.get(end + 1..).unwrap_or_default();
        self.next_number += 1;
        Some(line.trim_ascii_end())
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let number = self.next_number;
        let mut line = Cow::Borrowed(self.physical()?);
        while let Some(start) = line.strip_suffix(b"\\")
            && continues(start)
        {
            let mut joined = start.to_vec();
            joined.push(b' ');
            joined.extend_from_slice(self.physical().unwrap_or_default());
            line = Cow::Owned(joined);
        }
        Some((number, line))
    }
}

/// Whether a backslash behind `start` can join the next line to it: a path in a comment or a name may well
/// end with one.
fn continues(start: &[u8]) -> bool {
    !start.contains(&b'#') && !matches!(Statement::of(start), Statement::Other)
}

/// What a line says.
pub(super) enum Statement<'a> {
    /// `v x y z ...`: the words after `v`.
    Vertex(&'a [u8]),
    /// `f ...`: the words after `f`.
    Face(&'a [u8]),
    /// Names, normals, texture coordinates, points, lines, curves, comments.
    Other,
}

impl<'a> Statement<'a> {
    pub(super) fn of(line: &'a [u8]) -> Self {
        let line = line.trim_ascii_start();
        match line {
            [b'v' | b'f', next, ..] if next.is_ascii_whitespace() => {}
            b"v" | b"f" => {}
            _ => return Self::Other,
        }
        let end = line.iter().position(|&b| b == b'#').unwrap_or(line.len());
        let words = line[1..end].trim_ascii();
        if line[0] == b'v' {
            Self::Vertex(words)
        } else {
            Self::Face(words)
        }
    }
}

/// Words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// Hands an OBJ over line by line: one given line first, then the vertices (three coordinates each) and
/// the faces of the file in file order, and nothing else.
pub(super) struct Feed<'a> {
    lines: Lines<'a>,
    current: Vec<u8>,
    taken: usize,
    /// The line of the file that was handed over last; 0 before the first.
    pub(super) line: usize,
}

impl<'a> Feed<'a> {
    pub(super) fn new(first_line: Vec<u8>, bytes: &'a [u8]) -> Self {
        Self {
            lines: Lines::new(bytes),
            current: first_line,
            taken: 0,
            line: 0,
        }
    }

    fn refill(&mut self) {
        self.current.clear();
        self.taken = 0;
        for (number, line) in self.lines.by_ref() {
            match Statement::of(&line) {
                Statement::Vertex(coordinates) => {
                    self.current.extend_from_slice(b"v");
                    for word in words(coordinates).take(3) {
                        self.current.push(b' ');
                        self.current.extend_from_slice(word);
                    }
                }
                Statement::Face(corners) => {
                    self.current.extend_from_slice(b"f ");
                    self.current.extend_from_slice(corners);
                }
                Statement::Other => continue,
            }
            if !self.current.is_ascii() {
                self.current = String::from_utf8_lossy(&self.current)
                    .into_owned()
                    .into_bytes();
            }
            self.current.push(b'\n');
            self.line = number;
            return;
        }
    }
}

impl Read for Feed<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(out)?;
        self.consume(count);
        Ok(count)
    }
}

impl BufRead for Feed<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.taken == self.current.len() {
            self.refill();
        }
        Ok(&self.current[self.taken..])
    }

    fn consume(&mut self, amount: usize) {
        self.taken = (self.taken + amount).min(self.current.len());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fed(text: &str) -> String {
        let mut out = String::new();
        Feed::new(b"first\n".to_vec(), text.as_bytes())
            .read_to_string(&mut out)
            .unwrap();
        out
    }

    #[test]
    fn only_vertices_and_faces_come_through() {
        let text = "mtllib a.mtl\r\n v 1 2 3 0.5 0.5 0.5\r\nvn 0 0 1\ng x\nf 1/1 2 3 # why\nl 1 2\n#f 1 1 1\n";
        assert_eq!(fed(text), "first\nv 1 2 3\nf 1/1 2 3\n");
    }

    #[test]
    fn a_backslash_joins_lines_and_the_count_goes_on() {
        let text = "f 1 2 \\\r\n 3\nv 0 0 0\\";
        let numbers: Vec<usize> = Lines::new(text.as_bytes())
            .map(|(number, _)| number)
            .collect();
        assert_eq!(numbers, [1, 3]);
        assert_eq!(fed(text), "first\nf 1 2   3\nv 0 0 0\n");
    }

    #[test]
    fn a_path_that_ends_with_a_backslash_swallows_nothing() {
        assert_eq!(
            fed("# C:\\parts\\\nv 1 2 3\ng C:\\\nf 1 2 3"),
            "first\nv 1 2 3\nf 1 2 3\n"
        );
    }
}
