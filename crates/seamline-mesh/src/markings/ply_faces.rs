//! Labels as a property of the faces of a PLY, or their colour.

use ply_rs::ply::{
    ElementDef, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

use super::labels::numbered;
use super::{Markings, MarkingsError};
use crate::read::open_ply;
use crate::{Mesh, Place, ReadError};

/// Names that labels go by, in the order in which they are asked; after them, the one whole number a face has, its colour,
/// its selection, or the one fraction it has, since some programs store every number as one.
const LABEL_NAMES: [&str; 8] = [
    "patch",
    "label",
    "labels",
    "segment",
    "region",
    "face_id",
    "group",
    "material_index",
];

const COLOUR: [&str; 3] = ["red", "green", "blue"];

/// MeshLab and other programs on VCGlib keep the selection of a face in this bit of its `flags`.
const VCG_SELECTED: u32 = 0x20;

/// Reads one label a face. `by` names the property, or is `colour`.
pub(super) fn read(bytes: &[u8], by: Option<&str>, mesh: &Mesh) -> Result<Markings, MarkingsError> {
    let (header, mut rows) = open_ply(bytes, |_| Ok(()))?;
    let Some(face) = header.elements.get("face") else {
        return Err(MarkingsError::whole(
            "the PLY has no faces",
            "labels are a property of its faces",
        ));
    };
    let numbers: Vec<&str> = face
        .properties
        .values()
        .filter(|p| matches!(p.data_type, PropertyType::Scalar(_)))
        .map(|p| p.name.as_str())
        .collect();
    let has_colour = COLOUR.iter().all(|part| numbers.contains(part));
    let chosen = match by {
        Some("colour" | "color") if has_colour => COLOUR.to_vec(),
        Some(name) if numbers.contains(&name) => vec![name],
        Some(name) => {
            let reason = format!("its faces have no `{name}`");
            return Err(MarkingsError::whole(
                reason,
                format!("they have {}", said(&numbers, has_colour)),
            ));
        }
        None => by_name(face, &numbers, has_colour)?,
    };
    let columns: Vec<usize> = chosen
        .iter()
        .filter_map(|name| numbers.iter().position(|number| number == name))
        .collect();
    let mut labels: Vec<[i64; 3]> = Vec::new();
    for element in header.elements.values() {
        if element.name != "face" {
            rows.skip(element)?;
            continue;
        }
        rows.read(element, |FaceNumbers(row), place| {
            let mut label = [0; 3];
            for (to, &column) in label.iter_mut().zip(&columns) {
                let value = row.get(column).copied().unwrap_or(f64::NAN);
                *to = whole(value, place)?;
            }
            labels.push(label);
            Ok(())
        })?;
    }
    if chosen == ["flags"] {
        for label in &mut labels {
            label[0] &= i64::from(VCG_SELECTED);
        }
    }
    numbered(&labels, mesh)
}

fn by_name<'a>(
    face: &ElementDef,
    numbers: &[&'a str],
    has_colour: bool,
) -> Result<Vec<&'a str>, MarkingsError> {
    let called = LABEL_NAMES
        .iter()
        .find_map(|name| numbers.iter().find(|number| *number == name));
    if let Some(name) = called {
        return Ok(vec![name]);
    }
    let is_whole = |name: &&&str| {
        let data_type = face.properties.get(**name).map(|p| &p.data_type);
        let fraction = matches!(
            data_type,
            Some(PropertyType::Scalar(ScalarType::Float | ScalarType::Double))
        );
        !fraction && !COLOUR.contains(*name) && !["alpha", "flags"].contains(*name)
    };
    let fractions: Vec<&&str> = numbers
        .iter()
        .filter(|name| !is_whole(name) && !COLOUR.contains(*name))
        .filter(|name| !["alpha", "flags"].contains(*name))
        .collect();
    match numbers.iter().filter(is_whole).collect::<Vec<_>>()[..] {
        [name] => Ok(vec![name]),
        [] if has_colour => Ok(numbers
            .iter()
            .copied()
            .filter(|n| COLOUR.contains(n))
            .collect()),
        [] if numbers.contains(&"flags") => Ok(vec!["flags"]),
        [] if fractions.len() == 1 => Ok(vec![*fractions[0]]),
        _ => Err(MarkingsError::whole(
            "it is not said what tells its faces apart",
            format!(
                "choose with --labels-by: they have {}",
                said(numbers, has_colour)
            ),
        )),
    }
}

fn said(numbers: &[&str], has_colour: bool) -> String {
    let parts = |name: &&&str| !(has_colour && (COLOUR.contains(*name) || **name == "alpha"));
    let mut names: Vec<&str> = numbers.iter().filter(parts).copied().collect();
    names.extend(has_colour.then_some("colour"));
    if names.is_empty() {
        "no number and no colour".to_owned()
    } else {
        names.join(", ")
    }
}

/// A label may be stored as a fraction, as MeshLab's `quality` is, but must be a whole number.
fn whole(value: f64, place: Place) -> Result<i64, ReadError> {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        return Ok(value as i64);
    }
    Err(ReadError::Syntax {
        place,
        reason: format!("{value} is no label"),
        hint: "labels are whole numbers; choose another property with --labels-by",
    })
}

/// The numbers of a face, in the order of the header; lists are left out.
#[derive(Default)]
struct FaceNumbers(Vec<f64>);

impl PropertyAccess for FaceNumbers {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, _: &str, property: Property) -> PropertyAccessResult {
        let value = match property {
            Property::Char(v) => f64::from(v),
            Property::UChar(v) => f64::from(v),
            Property::Short(v) => f64::from(v),
            Property::UShort(v) => f64::from(v),
            Property::Int(v) => f64::from(v),
            Property::UInt(v) => f64::from(v),
            Property::Float(v) => f64::from(v),
            Property::Double(v) => v,
            _ => return PropertyAccessResult::Ignored,
        };
        self.0.push(value);
        PropertyAccessResult::Set
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::markings::test_meshes::two_quads;

    fn ply(properties: &str, rows: [&str; 2]) -> Vec<u8> {
        let vertices = "0 0 0\n".repeat(8);
        let [a, b] = rows;
        format!(
            "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
             element face 2\nproperty list uchar int vertex_indices\n{properties}end_header\n{vertices}\
             4 0 1 2 3 {a}\n4 6 4 5 7 {b}\n"
        )
        .into_bytes()
    }

    fn of(properties: &str, rows: [&str; 2], by: Option<&str>) -> Result<Markings, String> {
        read(&ply(properties, rows), by, &two_quads()).map_err(|e| format!("{e}; {}", e.hint()))
    }

    /// As MeshLab 2025 saves a cube with its first three faces selected: coordinates in double precision, another flag set
    /// on every face, a blank at the end of each line.
    #[test]
    fn faces_selected_in_meshlab_are_one_patch_and_the_rest_another() {
        let saved = "ply\nformat ascii 1.0\ncomment VCGLIB generated\nelement vertex 8\nproperty double x\n\
                     property double y\nproperty double z\nelement face 2\n\
                     property list uchar int vertex_indices\nproperty int flags\nend_header\n";
        let rows = "-0.5 0.5 0.5 \n".repeat(8) + "4 0 1 2 3 262176 \n4 6 4 5 7 262144 \n";
        for by in [None, Some("flags")] {
            let read = read((saved.to_owned() + &rows).as_bytes(), by, &two_quads());
            assert_eq!(read.unwrap(), Markings::Labels(vec![0, 1]));
        }
    }

    const COLOURED: &str = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

    #[test]
    fn a_whole_number_of_any_name_is_the_label() {
        let read = of("property int part_no\n", ["9", "4"], None);
        assert_eq!(read, Ok(Markings::Labels(vec![0, 1])));
    }

    #[test]
    fn each_colour_is_a_patch() {
        let read = of(COLOURED, ["255 0 0", "254 0 0"], None);
        assert_eq!(read, Ok(Markings::Labels(vec![0, 1])));
        let same = of(COLOURED, ["1 2 3", "1 2 3"], Some("colour"));
        assert_eq!(same, Ok(Markings::Labels(vec![0, 0])));
    }

    #[test]
    fn a_selection_of_meshlab_is_the_sixth_bit_of_the_flags() {
        // Other bits are borders and edges that are not drawn.
        let read = of("property int flags\n", ["262176", "448"], None);
        assert_eq!(read, Ok(Markings::Labels(vec![0, 1])));
        let none = of("property int flags\n", ["0", "448"], None);
        assert_eq!(none, Ok(Markings::Labels(vec![0, 0])));
    }

    #[test]
    fn a_quality_serves_where_it_is_named_and_whole() {
        let property = "property float quality\n";
        assert_eq!(
            of(property, ["3", "7"], Some("quality")),
            Ok(Markings::Labels(vec![0, 1]))
        );
        let broken = of(property, ["3", "7.5"], Some("quality")).unwrap_err();
        assert!(broken.contains("7.5 is no label"), "{broken}");
    }

    #[test]
    fn what_is_no_number_is_no_label_and_no_coordinate() {
        for kind in ["int", "float"] {
            let property = format!("property {kind} part_no\n");
            let read = of(&property, ["nan", "4"], Some("part_no")).unwrap_err();
            assert!(
                read.contains("line 19: `nan` is not a finite number;"),
                "{read}"
            );
        }
    }

    #[test]
    fn where_more_than_one_thing_could_be_meant_they_are_named() {
        let two = of("property int a\nproperty int b\n", ["1 2", "1 3"], None).unwrap_err();
        assert!(two.ends_with("they have a, b"), "{two}");
        let unknown = of(COLOURED, ["1 2 3", "1 2 3"], Some("patch")).unwrap_err();
        assert_eq!(unknown, "its faces have no `patch`; they have colour");
    }
}
