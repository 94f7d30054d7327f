//! What every reader promises of a mesh, checked in one place.

use glam::DVec3;
use rayon::prelude::*;

use super::error::{Place, ReadError};
use crate::{Format, PolygonMesh};

/// The first thing found wrong, by number; the reader knows where that is in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    NoFaces,
    NotFinite { vertex: usize },
    FewCorners { face: usize },
    OutOfRange { face: usize, index: u32 },
}

/// Indices stay below this, so that `u32::MAX` is free to mean "none".
const LIMIT: usize = u32::MAX as usize - 1;

/// Refuses more than 32-bit numbers can count; for readers that know the count before they set memory aside.
pub(super) fn check_count(count: usize, what: &'static str) -> Result<(), ReadError> {
    if count > LIMIT {
        Err(ReadError::TooLarge {
            count,
            what,
            limit: LIMIT as u32,
        })
    } else {
        Ok(())
    }
}

/// The error for the first coordinate of `position` that is not finite.
pub(super) fn not_finite(place: Place, position: DVec3) -> ReadError {
    let value = position
        .to_array()
        .into_iter()
        .find(|c| !c.is_finite())
        .unwrap_or(f64::NAN);
    ReadError::NotFinite {
        place,
        value: value.to_string().to_lowercase(),
    }
}

/// Refuses a mesh that breaks a promise of [`PolygonMesh`], or has no face.
pub(super) fn check(mesh: &PolygonMesh) -> Result<(), Fault> {
    if mesh.face_count() == 0 {
        return Err(Fault::NoFaces);
    }
    if let Some(vertex) = mesh.positions.par_iter().position_first(|p| !p.is_finite()) {
        return Err(Fault::NotFinite { vertex });
    }
    if let Some(face) = mesh
        .starts
        .par_windows(2)
        .position_first(|w| w[1] - w[0] < 3)
    {
        return Err(Fault::FewCorners { face });
    }
    let vertices = mesh.positions.len();
    if let Some(corner) = mesh
        .corners
        .par_iter()
        .position_first(|&v| v as usize >= vertices)
    {
        let face = mesh
            .starts
            .partition_point(|&start| start as usize <= corner)
            - 1;
        return Err(Fault::OutOfRange {
            face,
            index: mesh.corners[corner],
        });
    }
    Ok(())
}

impl Fault {
    /// The error, for a format that can only number vertices and faces.
    pub(super) fn in_numbers(self, mesh: &PolygonMesh) -> ReadError {
        match self {
            Self::NoFaces => ReadError::NoFaces {
                format: family(mesh.format),
                vertices: mesh.positions.len(),
            },
            Self::NotFinite { vertex } => {
                not_finite(Place::Vertex(vertex + 1), mesh.positions[vertex])
            }
            Self::FewCorners { face } => ReadError::FewCorners {
                place: Place::Face(face + 1),
                corners: mesh.face(face).len(),
            },
            Self::OutOfRange { face, index } => ReadError::OutOfRange {
                place: Place::Face(face + 1),
                index: i64::from(index),
                vertices: mesh.positions.len(),
                numbering: "counted from 0",
            },
        }
    }
}

/// The name of a format for people.
fn family(format: Format) -> &'static str {
    match format {
        Format::StlBinary => "binary STL",
        Format::StlAscii => "ASCII STL",
        Format::Obj => "OBJ",
        Format::PlyAscii | Format::PlyLittleEndian | Format::PlyBigEndian => "PLY",
        Format::Memory => "mesh",
    }
}
