//! Shapes whose patches anyone can name: the basic elements of the paper's Fig. 11, and the coarse
//! tessellations the `cad` profile is made for.

use seamline_mesh::shapes::{self, Diagonals, Shape};
use seamline_tests::{same_partition, segment};

fn assert_exact(name: &str, shape: &Shape, settings: &[&str]) {
    let found = segment(shape.polygons(), settings);
    assert!(
        same_partition(&found.face_patches, &shape.patches),
        "{name}: {} patches, {} are right",
        found.patches.len(),
        shape.patch_count()
    );
}

fn patches(shape: &Shape, settings: &[&str]) -> usize {
    segment(shape.polygons(), settings).patches.len()
}

fn cylinder(sides: usize) -> Shape {
    shapes::cylinder(1.0, 2.0, sides, 1, Diagonals::Alternating)
}

#[test]
fn cad_cuts_every_basic_shape_into_its_surfaces() {
    for (name, shape) in [
        ("cylinder", cylinder(24)),
        ("coarse cylinder", cylinder(12)),
        ("cone", shapes::cone(1.0, 2.0, 24)),
        ("cube", shapes::cuboid(glam::DVec3::ONE)),
        ("smooth cube", shapes::smooth_cube(0.2, 1, 4)),
        ("smooth cube, fine", shapes::smooth_cube(0.2, 12, 8)),
        ("shaft", shapes::shaft(24, 4)),
        ("bracket", shapes::bracket(6)),
        ("stadium", shapes::stadium(2.0, 0.5, 0.5, 8)),
        (
            "two radii",
            shapes::rounded_box(glam::dvec3(2.0, 2.0, 1.0), [0.2, 0.0, 0.6, 0.0], 6),
        ),
        (
            "filleted box",
            shapes::rounded_box(glam::dvec3(2.0, 1.0, 1.0), [0.2, 0.0, 0.0, 0.0], 4),
        ),
    ] {
        assert_exact(name, &shape, &["pipeline.profile=cad"]);
    }
}

#[test]
fn lavoue2005_cuts_the_papers_basic_elements_as_its_figure_11_does() {
    let profile = "pipeline.profile=lavoue2005";
    for (name, shape, right) in [
        ("coarse cylinder", cylinder(24), 3),
        (
            "fine cylinder",
            shapes::cylinder(1.0, 2.0, 64, 16, Diagonals::Uniform),
            3,
        ),
        ("cone", shapes::cone(1.0, 2.0, 24), 2),
        ("cube", shapes::cuboid(glam::DVec3::ONE), 6),
    ] {
        assert_eq!(
            patches(&shape, &[profile, "pipeline.rectifier=none"]),
            right,
            "{name}"
        );
        assert_eq!(patches(&shape, &[profile]), right, "{name}, rectified");
    }
}

#[test]
fn a_smooth_cube_has_26_natural_parts_and_the_papers_seven_by_its_rectifier_or_by_two_clusters() {
    let cube = shapes::smooth_cube(0.2, 12, 8);
    let with = |more: &[&str]| {
        patches(
            &cube,
            &[&["pipeline.profile=lavoue2005", "merge.threshold=1"], more].concat(),
        )
    };
    assert_eq!(with(&["pipeline.rectifier=none"]), 26);
    assert_eq!(with(&["contour-tracking.correct_below_deg=5"]), 7);
    assert_eq!(with(&["kmeans.clusters=2", "pipeline.rectifier=none"]), 7);
}
