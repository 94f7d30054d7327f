//! Surfaces told of found patches, against those the parts were made with.

use seamline_ecs::results::{PatchSurface, SurfaceShape};

use crate::cut::Cut;
use crate::text::{digits, of};
use crate::truth::{Sizes, TruePatch};

/// A size is right within this share of it.
const NEAR: f64 = 1e-4;

const TYPES: [&str; 5] = ["plane", "cylinder", "cone", "sphere", "torus"];

pub fn print(cuts: &[Cut]) {
    for (heading, exact_only) in [
        ("patches found exactly", true),
        (
            "all patches, each by the found one it has most area in common with",
            false,
        ),
    ] {
        println!(
            "\n### Surfaces told: {heading}\n\n\
            | surface | type right / patches | share | told free form | another type | sizes within 1e-4 / type right \
            | concave or convex right / type right |\n|---|---|---|---|---|---|---|"
        );
        let told: Vec<_> = cuts.iter().flat_map(|cut| told(cut, exact_only)).collect();
        for kind in TYPES {
            row(kind, told.iter().filter(|told| told.kind == kind));
        }
        row("all", told.iter());
    }
}

/// What was told of a true analytic patch.
struct Told<'a> {
    kind: &'a str,
    type_right: bool,
    free_form: bool,
    /// `None` for planes, which have no size, and where the type is wrong.
    sizes_right: Option<bool>,
    /// The same.
    side_right: Option<bool>,
}

fn told<'a>(cut: &'a Cut, exact_only: bool) -> impl Iterator<Item = Told<'a>> {
    let analytic = |patch: &&TruePatch| TYPES.contains(&patch.kind.as_str());
    let patches = cut.truth.patches.iter().filter(analytic);
    patches.filter_map(move |patch| {
        let partner = cut.partners[&patch.label];
        let surface = cut.surfaces[partner.found as usize];
        (partner.exact || !exact_only).then(|| Told::of(patch, surface.unwrap_or_default()))
    })
}

impl<'a> Told<'a> {
    fn of(patch: &'a TruePatch, surface: PatchSurface) -> Self {
        let type_right = kind(&surface.shape) == Some(&patch.kind);
        let sizes = sizes(&surface.shape, &patch.parameters).filter(|_| type_right);
        let near = |&[told, there]: &[f64; 2]| (told - there).abs() <= NEAR * there.abs();
        let side = patch.concave.filter(|_| type_right);
        Self {
            kind: &patch.kind,
            type_right,
            free_form: surface.shape == SurfaceShape::FreeForm,
            sizes_right: sizes.map(|pairs| pairs.iter().all(near)),
            side_right: side.map(|concave| surface.concave == Some(concave)),
        }
    }
}

/// As the truth has it; `None` for free forms.
fn kind(shape: &SurfaceShape) -> Option<&'static str> {
    let number = usize::from(shape.number());
    number.checked_sub(1).map(|at| TYPES[at])
}

/// Each size as told and as it is. `None` where the two have no size in common.
fn sizes(told: &SurfaceShape, there: &Sizes) -> Option<Vec<[f64; 2]>> {
    Some(match told {
        SurfaceShape::Cylinder { radius, .. } | SurfaceShape::Sphere { radius, .. } => {
            vec![[*radius, there.radius?]]
        }
        SurfaceShape::Cone { half_angle_deg, .. } => {
            vec![[half_angle_deg.to_radians(), there.half_angle?]]
        }
        SurfaceShape::Torus {
            major_radius,
            minor_radius,
            ..
        } => vec![
            // The truth has no sign for the inner half of a tube that meets the axis.
            [major_radius.abs(), there.major_radius?],
            [*minor_radius, there.minor_radius?],
        ],
        SurfaceShape::Plane { .. } | SurfaceShape::FreeForm => return None,
    })
}

/// Where nothing counts there is no row.
fn row<'a>(name: &str, told: impl Iterator<Item = &'a Told<'a>>) {
    let told: Vec<_> = told.collect();
    if told.is_empty() {
        return;
    }
    let types = told.iter().filter(|told| told.type_right).count();
    let share = digits(types as f64 / told.len() as f64);
    let free_forms = told.iter().filter(|told| told.free_form).count();
    let others = told.len() - types - free_forms;
    let rest: [fn(&Told) -> Option<bool>; 2] = [|told| told.sizes_right, |told| told.side_right];
    let rest = rest.map(|right| {
        let known: Vec<bool> = told.iter().filter_map(|told| right(told)).collect();
        let rights = known.iter().filter(|&&right| right).count();
        if known.is_empty() {
            "-".to_owned()
        } else {
            of(rights, known.len())
        }
    });
    println!(
        "| {name} | {} | {share} | {free_forms} | {others} | {} |",
        of(types, told.len()),
        rest.join(" | ")
    );
}
