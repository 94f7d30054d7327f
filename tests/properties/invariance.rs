//! How a part lies, how large it is and in which order its faces come says nothing of its patches.

use proptest::prelude::*;
use seamline_mesh::shapes::Shape;
use seamline_tests::{same_partition, segment};

use crate::drawn::{cases, factor, order, rotation, shape, translation};

const CAD: &str = "pipeline.profile=cad";
const LAVOUE2005: &str = "pipeline.profile=lavoue2005";

fn cut(shape: &Shape, profile: &str) -> Vec<u32> {
    segment(shape.polygons(), &[profile]).face_patches
}

/// Fails unless both labellings cut the faces alike; says how many patches each has.
fn check_same(as_it_was: &[u32], as_it_is: &[u32]) -> Result<(), TestCaseError> {
    let patches = |labels: &[u32]| labels.iter().max().map_or(0, |&last| last + 1);
    prop_assert!(
        same_partition(as_it_was, as_it_is),
        "the partition changes: {} patches, then {}",
        patches(as_it_was),
        patches(as_it_is)
    );
    Ok(())
}

fn check_moved(
    shape: &Shape,
    moved: impl Fn(glam::DVec3) -> glam::DVec3,
    profile: &str,
) -> Result<(), TestCaseError> {
    check_same(&cut(shape, profile), &cut(&shape.map(moved), profile))
}

fn check_shuffled(shape: &Shape, order: &[usize], profile: &str) -> Result<(), TestCaseError> {
    let as_it_was = cut(shape, profile);
    let in_order: Vec<u32> = order.iter().map(|&face| as_it_was[face]).collect();
    check_same(&in_order, &cut(&shape.reordered(order), profile))
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn cad_cuts_a_part_alike_however_it_is_turned_and_wherever_it_lies(
        drawn in shape(), turn in rotation(), way in translation(),
    ) {
        check_moved(&drawn.shape, |p| turn * p + way, CAD)?;
    }

    #[test]
    fn cad_cuts_a_part_alike_whatever_its_size(drawn in shape(), factor in factor()) {
        check_moved(&drawn.shape, |p| p * factor, CAD)?;
    }

    #[test]
    fn cad_cuts_a_part_alike_in_whatever_order_its_faces_come(drawn in shape(), number in 1u64..) {
        check_shuffled(&drawn.shape, &order(drawn.shape.face_count(), number), CAD)?;
    }

    #[test]
    fn lavoue2005_cuts_a_part_alike_wherever_it_lies(drawn in shape(), way in translation()) {
        check_moved(&drawn.shape, |p| p + way, LAVOUE2005)?;
    }

    #[test]
    fn lavoue2005_cuts_a_part_alike_whatever_its_size(drawn in shape(), factor in factor()) {
        check_moved(&drawn.shape, |p| p * factor, LAVOUE2005)?;
    }

    #[test]
    fn lavoue2005_cuts_a_part_alike_in_whatever_order_its_faces_come(drawn in shape(), number in 1u64..) {
        check_shuffled(&drawn.shape, &order(drawn.shape.face_count(), number), LAVOUE2005)?;
    }
}
