//! How much memory a mesh takes on its way through the pipeline.
//!
//! Peak resident memory of `seamline segment` (release build, two cores, one mesh a process, all outputs),
//! less the 12 MB of a process without a mesh, in bytes a triangle:
//!
//! | mesh, format | triangles | vertices a triangle | `cad` | `lavoue2005` |
//! |---|---|---|---|---|
//! | flange, STL binary | 108,248 | 0.5 | 885 | 974 |
//! | flange, STL binary | 432,992 | 0.5 | 905 | 990 |
//! | flange, STL binary | 1,731,968 | 0.5 | 881 | 948 |
//! | flange, STL text | 1,731,968 | 0.5 | 881 | 957 |
//! | flange, OBJ | 1,731,968 | 0.5 | 867 | 939 |
//! | flange, PLY text | 1,731,968 | 0.5 | 862 | 937 |
//! | flange, PLY binary | 1,731,968 | 0.5 | 866 | 956 |
//! | 35,937 cubes, STL binary | 431,244 | 0.67 | 1,254 | 2,984 |
//! | flange with noise, STL binary | 432,992 | 0.5 | 1,179 | 2,226 |
//! | each triangle by itself, STL binary | 432,992 | 3 | 2,605 | 4,317 |
//! | strip and many unused vertices, OBJ | 100,000 | 4 | 3,102 | 4,842 |
//!
//! All that with the allocator of the C library and without surfaces. With surfaces and the program's own allocator,
//! which gives pages back a moment later (the same 12 MB less): 1,349, 1,105 and 1,055 for the three flanges by `cad`,
//! 1,751 for 72,156 triangles of free form and 3,490 for 14,586; 1,510 for an ellipsoid of 327,680 (an icosahedron
//! each of whose triangles is split in four seven times). So a mesh takes some 35 MB besides, however small it is, and
//! one large free form a quarter more; both come out of the quarter of the limit that is left free (`bounded_memory`).
//!
//! The format does not matter: the bytes of the file are gone before the peak. 530 bytes a triangle and 700
//! a vertex give the flanges and the two last rows of `cad` within 7 percent. Cubes and noise, whose patches
//! are nearly as many as their triangles, take up to 34 percent more, which is the margin taken. Where
//! triangles are enriched, up to three take the place of one, with one vertex more, which the last four rows
//! of `lavoue2005` show.
//!
//! `report.json` adds nothing, however many patches there are: the cubes, each of which is six, take the same with
//! it and without.
//!
//! Reading alone (`seamline inspect`, the length of the file subtracted): 117 to 180 bytes a triangle for the
//! flanges, 567 for triangles by themselves.
//!
//! What a worker holds between two meshes (`seamline watch`, after a flange): 570 to 824 bytes a triangle, of
//! which up to 150 are the allocator's.

/// Of the start of a file, this much is enough for [`estimate()`].
pub const START_BYTES: usize = 64 << 10;

/// 530 and the margin.
const A_TRIANGLE: u64 = 720;
/// 700 and the margin.
const A_VERTEX: u64 = 930;
const READING_A_TRIANGLE: u64 = 160;
const READING_A_VERTEX: u64 = 200;

/// The memory a mesh of so many triangles and distinct vertices takes, from its being read to its results being
/// written; in bytes, a third more than was measured. `enriched`: whether triangles may be enriched
/// (`sharp.enrich`, with curvature at vertices).
pub fn bytes_for_mesh(triangles: u64, vertices: u64, enriched: bool) -> u64 {
    let (triangles, vertices) = if enriched {
        (
            triangles.saturating_mul(3),
            vertices.saturating_add(triangles),
        )
    } else {
        (triangles, vertices)
    };
    sum(triangles, A_TRIANGLE, vertices, A_VERTEX)
}

/// The part of [`bytes_for_mesh`] that a worker keeps when it is done, until it gets a mesh of less than half
/// the triangles or is dropped.
pub fn bytes_kept(triangles: u64, vertices: u64, enriched: bool) -> u64 {
    bytes_for_mesh(triangles, vertices, enriched) / 4 * 3
}

fn sum(triangles: u64, a_triangle: u64, vertices: u64, a_vertex: u64) -> u64 {
    let [triangles, vertices] = [(triangles, a_triangle), (vertices, a_vertex)]
        .map(|(count, each)| count.saturating_mul(each));
    triangles.saturating_add(vertices)
}

/// What a file will take, told before it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// Probably, in bytes.
    pub bytes: u64,
    /// At least, in bytes: less is not to be expected of any file that begins like this. The same as `bytes`
    /// where the file says how many triangles it has.
    pub least_bytes: u64,
}

/// Estimates by the length of a file and its first bytes ([`START_BYTES`], or all there are) what it takes to
/// read it and to cut it. What a file claims to hold is believed as far as its length allows.
///
/// In an ordinary CAD mesh vertices are half as many as triangles, which is taken for granted where the file
/// does not say; [`bytes_for_mesh`] knows once it is read.
pub fn estimate(length: u64, start: &[u8], enriched: bool) -> Estimate {
    let needed = |Size {
                      triangles,
                      vertices,
                  }: Size| {
        let reading = sum(triangles, READING_A_TRIANGLE, vertices, READING_A_VERTEX);
        bytes_for_mesh(triangles, vertices, enriched).max(length.saturating_add(reading))
    };
    let [likely, least] = sizes(length, start);
    Estimate {
        bytes: needed(likely),
        least_bytes: needed(least),
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Size {
    triangles: u64,
    vertices: u64,
}

impl Size {
    fn of_triangles(triangles: u64) -> Self {
        Self {
            triangles,
            vertices: triangles / 2,
        }
    }
}

/// The likely size and the least.
fn sizes(length: u64, start: &[u8]) -> [Size; 2] {
    let records = length.saturating_sub(84) / 50;
    let declared = start.get(80..84).and_then(<[u8]>::first_chunk);
    let declared = declared.map_or(0, |count| u64::from(u32::from_le_bytes(*count)));
    if declared > 0 && declared == records && length == 84 + 50 * records {
        return [Size::of_triangles(declared); 2];
    }
    if let Some(size) = ply_size(length, start) {
        return [size; 2];
    }
    if start.contains(&0) {
        return [Size::of_triangles(declared.min(records)); 2];
    }
    let [likely, least] = match facets_in(start) {
        // Later facets may be a little shorter than the first.
        Some(facets) => {
            let likely = times(length, facets * 10, start.len() as u64 * 9);
            [likely, likely / 2]
        }
        // Large OBJ without normals have 26 bytes a triangle and more; with normals and many digits, 200.
        None => [length / 24, length / 200],
    };
    [likely, least].map(Size::of_triangles)
}

/// How many facets of a text STL lie here; none if it is none.
fn facets_in(start: &[u8]) -> Option<u64> {
    let first = start.trim_ascii_start().get(..5)?.to_ascii_lowercase();
    if first != b"solid" && first != b"facet" {
        return None;
    }
    let ends = start
        .windows(8)
        .filter(|word| word.eq_ignore_ascii_case(b"endfacet"));
    Some(ends.count() as u64)
}

fn times(length: u64, by: u64, of: u64) -> u64 {
    let product = u128::from(length) * u128::from(by) / u128::from(of.max(1));
    u64::try_from(product).unwrap_or(u64::MAX)
}

/// What the header of a PLY declares, as far as the length allows: a vertex and a face have three numbers at
/// the least.
fn ply_size(length: u64, start: &[u8]) -> Option<Size> {
    let header = start.strip_prefix(b"ply")?;
    let of = |name: &[u8]| {
        let lines = header.split(|&byte| byte == b'\n' || byte == b'\r');
        let mut lines = lines.take_while(|line| line.trim_ascii() != b"end_header");
        lines.find_map(|line| {
            let mut words = line
                .split(u8::is_ascii_whitespace)
                .filter(|word| !word.is_empty());
            let is_it = words.next()? == b"element" && words.next()? == name;
            let count: u64 = std::str::from_utf8(words.next()?).ok()?.parse().ok()?;
            is_it.then_some(count.min(length / 3))
        })
    };
    let (faces, vertices) = (of(b"face")?, of(b"vertex")?);
    // Quads, of which there are as many as vertices, are two triangles each. Far more vertices than faces
    // are triangles apart.
    let together = 2 * vertices <= 3 * faces;
    Some(Size {
        triangles: if together {
            faces.max(2 * vertices)
        } else {
            faces
        },
        vertices,
    })
}

#[cfg(test)]
mod tests;
