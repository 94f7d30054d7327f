//! Rows of a PLY payload: one a vertex, one a face, read one by one into place.

use glam::DVec3;
use ply_rs::parser::{ParseError, Parser};
use ply_rs::ply::{
    BeginList, ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};

use super::error::{Place, ReadError, quote};

/// A vertex: three of its numbers.
pub(super) struct VertexRow(pub(super) DVec3);

impl VertexRow {
    fn set(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        match name {
            "x" => self.0.x = value,
            "y" => self.0.y = value,
            "z" => self.0.z = value,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for VertexRow {
    fn new() -> Self {
        Self(DVec3::ZERO)
    }

    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set(name, f64::from(value))
    }

    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        self.set(name, value)
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        match property {
            Property::Char(v) => self.set(name, f64::from(v)),
            Property::UChar(v) => self.set(name, f64::from(v)),
            Property::Short(v) => self.set(name, f64::from(v)),
            Property::UShort(v) => self.set(name, f64::from(v)),
            Property::Int(v) => self.set(name, f64::from(v)),
            Property::UInt(v) => self.set(name, f64::from(v)),
            _ => PropertyAccessResult::Ignored,
        }
    }
}

/// Whether a list of this name holds the corners of a face.
pub(super) fn is_corner_list(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

/// A face: its corners, in the one list the header declares for them.
#[derive(Default)]
pub(super) struct FaceRow {
    signed: Vec<i32>,
    unsigned: Vec<u32>,
}

impl FaceRow {
    /// The corners. A negative one becomes `u32::MAX`, which is out of range in any mesh.
    pub(super) fn corners(&self) -> impl Iterator<Item = u32> {
        let signed = self
            .signed
            .iter()
            .map(|&corner| u32::try_from(corner).unwrap_or(u32::MAX));
        signed.chain(self.unsigned.iter().copied())
    }
}

impl PropertyAccess for FaceRow {
    fn new() -> Self {
        Self::default()
    }

    fn begin_list_int(&mut self, name: &str, _: usize) -> BeginList<'_, i32> {
        if is_corner_list(name) {
            BeginList::Fill(&mut self.signed)
        } else {
            BeginList::UseSetter
        }
    }

    fn begin_list_uint(&mut self, name: &str, _: usize) -> BeginList<'_, u32> {
        if is_corner_list(name) {
            BeginList::Fill(&mut self.unsigned)
        } else {
            BeginList::UseSetter
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !is_corner_list(name) {
            return PropertyAccessResult::Ignored;
        }
        match property {
            Property::ListChar(list) => self.signed.extend(list.into_iter().map(i32::from)),
            Property::ListShort(list) => self.signed.extend(list.into_iter().map(i32::from)),
            Property::ListUChar(list) => self.unsigned.extend(list.into_iter().map(u32::from)),
            Property::ListUShort(list) => self.unsigned.extend(list.into_iter().map(u32::from)),
            _ => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

/// A row of an element nobody asked for.
pub(super) struct SkippedRow;

impl PropertyAccess for SkippedRow {
    fn new() -> Self {
        Self
    }
}

/// The fewest bytes a row can have.
pub(super) fn least_size(element: &ElementDef, encoding: Encoding) -> usize {
    let least = |data_type: &PropertyType| match (encoding, data_type) {
        // A digit, and the blank or line end behind it.
        (Encoding::Ascii, _) => 2,
        (_, PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) => size(scalar),
    };
    element
        .properties
        .values()
        .map(|property| least(&property.data_type))
        .sum()
}

fn size(scalar: &ScalarType) -> usize {
    match scalar {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// Walks through the payload.
pub(crate) struct Rows<'a> {
    pub(super) bytes: &'a [u8],
    /// The next byte to read.
    pub(super) at: usize,
    pub(super) encoding: Encoding,
    /// The line of that byte, in a text file.
    pub(super) line: usize,
}

impl Rows<'_> {
    /// Reads all rows of an element and hands each to `take`, with its place.
    pub(crate) fn read<E: PropertyAccess>(
        &mut self,
        element: &ElementDef,
        mut take: impl FnMut(E, Place) -> Result<(), ReadError>,
    ) -> Result<(), ReadError> {
        let parser = Parser::<E>::new();
        for row in 0..element.count {
            let (parsed, place) = match self.encoding {
                Encoding::Ascii => (
                    self.text_row(&parser, element, row)?,
                    Place::Line(self.line - 1),
                ),
                _ => (
                    self.binary_row(&parser, element, row)?,
                    row_place(element, row),
                ),
            };
            take(parsed, place)?;
        }
        Ok(())
    }

    /// Passes over all rows of an element.
    pub(crate) fn skip(&mut self, element: &ElementDef) -> Result<(), ReadError> {
        let has_list = element
            .properties
            .values()
            .any(|p| matches!(p.data_type, PropertyType::List(..)));
        if element.properties.is_empty() {
            Ok(())
        } else if self.encoding == Encoding::Ascii || has_list {
            self.read(element, |_: SkippedRow, _| Ok(()))
        } else {
            self.at += element
                .count
                .saturating_mul(least_size(element, self.encoding));
            if self.at > self.bytes.len() {
                Err(cut_off(element, element.count))
            } else {
                Ok(())
            }
        }
    }

    fn binary_row<E: PropertyAccess>(
        &mut self,
        parser: &Parser<E>,
        element: &ElementDef,
        row: usize,
    ) -> Result<E, ReadError> {
        let mut rest = &self.bytes[self.at..];
        let parsed = match self.encoding {
            Encoding::BinaryBigEndian => parser.read_big_endian_element(&mut rest, element),
            _ => parser.read_little_endian_element(&mut rest, element),
        };
        let parsed = parsed.map_err(|e: ParseError| match e.kind() {
            std::io::ErrorKind::UnexpectedEof => cut_off(element, row),
            _ => ReadError::Syntax {
                place: Place::Byte(self.at),
                reason: format!("row {} of element `{}` cannot be read", row + 1, element.name),
                hint: "a list has a count that is not negative; all numbers are whole where declared so",
            },
        })?;
        self.at = self.bytes.len() - rest.len();
        Ok(parsed)
    }

    fn text_row<E: PropertyAccess>(
        &mut self,
        parser: &Parser<E>,
        element: &ElementDef,
        row: usize,
    ) -> Result<E, ReadError> {
        let line = loop {
            let rest = &self.bytes[self.at..];
            if rest.is_empty() {
                return Err(cut_off(element, row));
            }
            let end = rest
                .iter()
                .position(|&b| b == b'\n' || b == b'\r')
                .unwrap_or(rest.len());
            let line_end = if rest[end..].starts_with(b"\r\n") {
                2
            } else {
                1
            };
            self.at = (self.at + end + line_end).min(self.bytes.len());
            self.line += 1;
            if !rest[..end].trim_ascii().is_empty() {
                break rest[..end].trim_ascii();
            }
        };
        let parsed = std::str::from_utf8(line)
            .ok()
            .and_then(|text| parser.read_ascii_element(text, element).ok());
        parsed.ok_or_else(|| self.bad_text_row(line, element, row))
    }

    fn bad_text_row(&self, line: &[u8], element: &ElementDef, row: usize) -> ReadError {
        let place = Place::Line(self.line - 1);
        let is_not_finite = |word: &&[u8]| {
            std::str::from_utf8(word)
                .ok()
                .and_then(|w| w.parse::<f64>().ok())
                .is_some_and(|x| !x.is_finite())
        };
        if let Some(word) = line.split(u8::is_ascii_whitespace).find(is_not_finite) {
            if element.name == "face" {
                return ReadError::Syntax {
                    place,
                    reason: format!("`{}` is not a finite number", quote(word)),
                    hint: "numbers of a face, its vertices and its labels, are finite",
                };
            }
            return ReadError::NotFinite {
                place,
                value: quote(word),
            };
        }
        if self.at == self.bytes.len() && !self.bytes.ends_with(b"\n") {
            return cut_off(element, row);
        }
        let names: Vec<&str> = element.properties.keys().map(String::as_str).collect();
        ReadError::Syntax {
            place,
            reason: format!(
                "`{}` does not hold {}",
                quote(line),
                quote(names.join(" ").as_bytes())
            ),
            hint: "a row has one word for each number, and for a list its length and as many words",
        }
    }
}

fn row_place(element: &ElementDef, row: usize) -> Place {
    if element.name == "face" {
        Place::Face(row + 1)
    } else {
        Place::Vertex(row + 1)
    }
}

fn cut_off(element: &ElementDef, row: usize) -> ReadError {
    let name = quote(element.name.as_bytes());
    ReadError::Truncated {
        what: format!("PLY ends inside {name} {} of {}", row + 1, element.count),
    }
}
