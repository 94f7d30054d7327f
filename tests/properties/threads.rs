//! The number of threads says nothing of the result, to the last bit.

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use seamline_ecs::Segmentation;
use seamline_mesh::shapes::{self, Diagonals, Shape};
use seamline_tests::segment;

use crate::drawn::{cases, shape};

const PROFILES: [&str; 2] = ["pipeline.profile=cad", "pipeline.profile=lavoue2005"];

/// The shape with every corner moved a little, by where it is: no two sums of such numbers come out alike if
/// they are added up in another order.
fn rough(shape: &Shape, by: f64) -> Shape {
    let noise = |x: f64| (x * 1e4).sin();
    shape.map(|p| {
        let [a, b, c] = [
            p.dot(DVec3::ONE),
            p.dot(dvec3(0.7, -0.3, 1.9)),
            p.dot(dvec3(-1.1, 2.3, 0.2)),
        ];
        p + by * dvec3(noise(a), noise(b), noise(c))
    })
}

/// Everything that is told of a mesh but the time it took, bit for bit.
fn bits(cut: &Segmentation) -> (Vec<u32>, Vec<u32>, String) {
    let of = &cut.vertices;
    let directions = of.d_min.iter().chain(&of.d_max).flatten();
    let floats = of.k_min.iter().chain(&of.k_max).chain(directions);
    let stages: Vec<_> = cut
        .stages
        .iter()
        .map(|stage| (stage.stage, &stage.counts))
        .collect();
    // `Debug` writes as many digits as tell a number from its neighbours.
    let rest = format!(
        "{:?} {:?} {:?} {stages:?}",
        cut.patches, cut.boundaries, cut.findings
    );
    (
        cut.face_patches.clone(),
        floats.map(|x| x.to_bits()).collect(),
        rest,
    )
}

fn differing(shape: &Shape, profile: &str) -> Option<usize> {
    let with = |threads: usize| {
        let threads = format!("pipeline.threads={threads}");
        bits(&segment(shape.polygons(), &[profile, &threads]))
    };
    let alone = with(1);
    [2, 8].into_iter().find(|&threads| with(threads) != alone)
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn one_two_and_eight_threads_give_the_same_bits(drawn in shape(), by in 0.0..0.05) {
        for profile in PROFILES {
            prop_assert_eq!(differing(&rough(&drawn.shape, by), profile), None, "{}", profile);
        }
    }
}

/// Small meshes are not worth a second thread; these are.
#[test]
fn one_two_and_eight_threads_give_the_same_bits_where_there_is_work_for_all() {
    let large = [
        ("torus", shapes::torus(1.0, 0.3, 240, 120)),
        ("smooth cube", shapes::smooth_cube(0.2, 40, 20)),
        (
            "cylinder",
            shapes::cylinder(1.0, 2.0, 300, 100, Diagonals::Alternating),
        ),
    ];
    for (name, shape) in large {
        for by in [0.0, 2e-4] {
            for profile in PROFILES {
                let differing = differing(&rough(&shape, by), profile);
                assert_eq!(differing, None, "{name}, roughened by {by}, {profile}");
            }
        }
    }
}
