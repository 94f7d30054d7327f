//! ASCII STL: `solid`, `facet`, `outer loop`, three times `vertex x y z`, and the same words backwards.
//!
//! Words are in either case and apart by any white space; several solids in one file are one mesh. What
//! stands after `facet` up to `outer` is not read (a needle's normal is often `nan`). A file that does not
//! end with `endsolid` is refused as cut off: half a part would be worse than none.

use glam::DVec3;

use super::check::{check, check_count};
use super::error::{Place, ReadError, quote};
use crate::{Format, PolygonMesh};

const HINT: &str =
    "a facet is `facet normal x y z`, `outer loop`, three `vertex x y z`, `endloop`, `endfacet`";

/// Reads an ASCII STL.
pub(super) fn read(bytes: &[u8]) -> Result<PolygonMesh, ReadError> {
    let mut words = Words {
        rest: bytes,
        line: 1,
    };
    let mut positions = Vec::new();
    let mut in_solid = false;
    while let Some(word) = words.next() {
        if is(word, "solid") {
            words.skip_line();
            in_solid = true;
        } else if is(word, "facet") {
            facet(&mut words, &mut positions)?;
            in_solid = true;
        } else if is(word, "endsolid") {
            words.skip_line();
            in_solid = false;
        } else {
            return Err(words.unexpected(word, "`facet`, `endsolid` or `solid`"));
        }
    }
    if in_solid {
        let what = format!(
            "ASCII STL ends after line {} without `endsolid`",
            words.line
        );
        return Err(ReadError::Truncated { what });
    }

    check_count(positions.len(), "corners")?;
    let count = positions.len() as u32;
    let mesh = PolygonMesh {
        format: Format::StlAscii,
        positions,
        starts: (0..=count / 3).map(|face| 3 * face).collect(),
        corners: (0..count).collect(),
    };
    check(&mesh).map_err(|fault| fault.in_numbers(&mesh))?;
    Ok(mesh)
}

/// The rest of a facet, after the word `facet`.
fn facet(words: &mut Words<'_>, positions: &mut Vec<DVec3>) -> Result<(), ReadError> {
    let normal_line = words.line;
    loop {
        let word = words.require("`outer loop`")?;
        if is(word, "outer") {
            break;
        }
        if words.line > normal_line + 1 || is(word, "vertex") {
            return Err(words.unexpected(word, "`outer loop`"));
        }
    }
    words.keyword("loop")?;
    for _ in 0..3 {
        words.keyword("vertex")?;
        positions.push(DVec3::new(
            words.coordinate()?,
            words.coordinate()?,
            words.coordinate()?,
        ));
    }
    words.keyword("endloop")?;
    words.keyword("endfacet")
}

fn is(word: &[u8], keyword: &str) -> bool {
    word.eq_ignore_ascii_case(keyword.as_bytes())
}

/// The words of a file, and the line of the last one.
struct Words<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self
            .rest
            .iter()
            .position(|b| !b.is_ascii_whitespace())
            .unwrap_or(self.rest.len());
        self.line += self.rest[..start].iter().filter(|&&b| b == b'\n').count();
        let rest = &self.rest[start..];
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        if word.is_empty() { None } else { Some(word) }
    }

    /// Passes over a name: whatever stands in the rest of the line.
    fn skip_line(&mut self) {
        let end = self
            .rest
            .iter()
            .position(|&b| b == b'\n' || b == b'\r')
            .unwrap_or(self.rest.len());
        self.rest = &self.rest[end..];
    }

    fn require(&mut self, expected: &str) -> Result<&'a [u8], ReadError> {
        self.next().ok_or_else(|| ReadError::Truncated {
            what: format!(
                "ASCII STL ends in line {} where {expected} should follow",
                self.line
            ),
        })
    }

    fn keyword(&mut self, keyword: &str) -> Result<(), ReadError> {
        let expected = format_args!("`{keyword}`");
        let word = self.require(keyword)?;
        if is(word, keyword) {
            Ok(())
        } else {
            Err(self.unexpected(word, &expected.to_string()))
        }
    }

    fn coordinate(&mut self) -> Result<f64, ReadError> {
        let word = self.require("a coordinate")?;
        let number = std::str::from_utf8(word)
            .ok()
            .and_then(|text| text.parse::<f64>().ok());
        match number {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => Err(ReadError::NotFinite {
                place: Place::Line(self.line),
                value: quote(word),
            }),
            // The last word of a file may be half a word.
            None if self.rest.is_empty() => Err(ReadError::Truncated {
                what: format!("ASCII STL ends in line {} inside a coordinate", self.line),
            }),
            None => Err(self.unexpected(word, "a number")),
        }
    }

    fn unexpected(&self, word: &[u8], expected: &str) -> ReadError {
        if self.rest.is_empty() {
            let what = format!(
                "ASCII STL ends in line {} with `{}`",
                self.line,
                quote(word)
            );
            return ReadError::Truncated { what };
        }
        let reason = format!("`{}` where {expected} should stand", quote(word));
        ReadError::Syntax {
            place: Place::Line(self.line),
            reason,
            hint: HINT,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACET: &str = "facet normal nan 0 1\n outer loop\n vertex 0 0 0\n vertex 1e0 0 0\n vertex 0 +1.0 -0\n endloop\n endfacet\n";

    fn message(text: &str) -> String {
        read(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn several_solids_are_one_mesh() {
        let text =
            format!("solid a facet\n{FACET}endsolid a facet\nsolid\n{FACET}{FACET}endsolid\n\n");
        assert_eq!(read(text.as_bytes()).unwrap().face_count(), 3);
    }

    #[test]
    fn case_line_ends_and_indents_do_not_matter() {
        let text = format!("solid\n{FACET}endsolid")
            .to_uppercase()
            .replace('\n', "\r\n\t");
        assert_eq!(read(text.as_bytes()).unwrap().positions[1], DVec3::X);
    }

    #[test]
    fn a_normal_may_stand_in_a_line_of_its_own_or_be_missing() {
        let text = format!("solid\n{FACET}endsolid").replace("facet normal nan 0 1", "facet");
        assert!(read(text.as_bytes()).is_ok());
    }

    #[test]
    fn a_bad_number_is_named_with_its_line() {
        let text = format!("solid\n{FACET}endsolid\n");
        assert_eq!(
            message(&text.replace("1e0", "l.0")),
            "line 5: `l.0` where a number should stand"
        );
        assert_eq!(
            message(&text.replace("1e0", "1e999")),
            "line 5: coordinate `1e999` is not a finite number"
        );
    }

    #[test]
    fn a_facet_of_four_vertices_is_refused() {
        let text = format!("solid\n{FACET}endsolid\n").replace("endloop", "vertex 1 1 1\nendloop");
        assert_eq!(
            message(&text),
            "line 7: `vertex` where `endloop` should stand"
        );
    }

    #[test]
    fn every_shorter_copy_is_seen_to_be_incomplete() {
        let text = format!("solid a\n{FACET}{FACET}endsolid a\n");
        let complete = text.rfind("endsolid").unwrap() + "endsolid".len();
        for end in 6..complete {
            let error = read(&text.as_bytes()[..end]).unwrap_err();
            assert!(error.is_truncated(), "cut at {end}: {error}");
        }
    }
}
