//! Shapes and motions drawn at random.

use std::env;
use std::f64::consts::TAU;

use glam::{DQuat, DVec3, dvec3};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, RngSeed, TestRng};
use seamline_mesh::shapes::{self, Diagonals, Shape};

/// `few` cases, always the same, unless the environment wants more or others.
pub fn cases(few: u32) -> ProptestConfig {
    let mut config = ProptestConfig::default();
    if env::var_os("PROPTEST_CASES").is_none() {
        config.cases = few;
    }
    if env::var_os("PROPTEST_RNG_SEED").is_none() {
        config.rng_seed = RngSeed::Fixed(2005);
    }
    // A case that fails once becomes a test of its own, by name.
    config.failure_persistence = None;
    config
}

/// A shape, and the call that made it.
#[derive(Clone)]
pub struct Drawn {
    pub shape: Shape,
    name: String,
}

impl std::fmt::Debug for Drawn {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.name)
    }
}

macro_rules! drawn {
    ($call:expr, $($value:expr),*) => {
        Drawn {
            shape: $call,
            name: format!("{} with {}{:?}", stringify!($call), stringify!(($($value),*)), ($($value,)*)),
        }
    };
}

fn diagonals() -> impl Strategy<Value = Diagonals> {
    prop_oneof![
        Just(Diagonals::None),
        Just(Diagonals::Uniform),
        Just(Diagonals::Alternating)
    ]
}

/// Any of the shapes whose patches are known, coarse or fine, slim or flat.
pub fn shape() -> impl Strategy<Value = Drawn> {
    let cylinder = (0.2..3.0, 0.2..3.0, 8usize..40, 1usize..4, diagonals()).prop_map(
        |(radius, height, sides, rows, diagonals)| {
            drawn!(
                shapes::cylinder(radius, height, sides, rows, diagonals),
                radius,
                height,
                sides,
                rows,
                diagonals
            )
        },
    );
    let cone = (0.2..2.0, 0.5..3.0, 8usize..40).prop_map(|(radius, height, sides)| {
        drawn!(shapes::cone(radius, height, sides), radius, height, sides)
    });
    let cuboid = [0.2..3.0, 0.2..3.0, 0.2..3.0]
        .prop_map(|[x, y, z]| drawn!(shapes::cuboid(dvec3(x, y, z)), x, y, z));
    let torus =
        (1.0..2.0, 0.2..0.8, 8usize..32, 6usize..20).prop_map(|(major, minor, sides, rows)| {
            drawn!(
                shapes::torus(major, minor, sides, rows),
                major,
                minor,
                sides,
                rows
            )
        });
    let sphere = (1usize..4).prop_map(|levels| drawn!(shapes::icosphere(levels), levels));
    let smooth_cube = (0.05..0.4, 1usize..5, 1usize..4).prop_map(|(radius, flat, half)| {
        drawn!(
            shapes::smooth_cube(radius, flat, 2 * half),
            radius,
            flat,
            half
        )
    });
    let stadium =
        (0.5..3.0, 0.2..1.0, 0.1..2.0, 3usize..16).prop_map(|(length, radius, height, steps)| {
            drawn!(
                shapes::stadium(length, radius, height, steps),
                length,
                radius,
                height,
                steps
            )
        });
    let rounded_box = (
        [1.0..3.0, 1.0..3.0, 0.2..3.0],
        prop::array::uniform4(prop_oneof![Just(0.0), 0.05..0.45]),
        2usize..10,
    )
        .prop_map(|([x, y, z], radii, steps)| {
            drawn!(
                shapes::rounded_box(dvec3(x, y, z), radii, steps),
                x,
                y,
                z,
                radii,
                steps
            )
        });
    let bracket = (2usize..10).prop_map(|steps| drawn!(shapes::bracket(steps), steps));
    let shaft = (8usize..40, 2usize..8)
        .prop_map(|(sides, steps)| drawn!(shapes::shaft(sides, steps), sides, steps));
    prop_oneof![
        cylinder,
        cone,
        cuboid,
        torus,
        sphere,
        smooth_cube,
        stadium,
        rounded_box,
        bracket,
        shaft,
    ]
}

/// An order of `count` faces. By a number rather than drawn as such, so that a failing case can be read.
pub fn order(count: usize, number: u64) -> Vec<usize> {
    let mut rng = TestRng::from_seed(
        RngAlgorithm::XorShift,
        &[number; 2].map(u64::to_le_bytes).concat(),
    );
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        order.swap(last, rng.random_range(0..=last));
    }
    order
}

/// A turn about any axis.
pub fn rotation() -> impl Strategy<Value = DQuat> {
    (-1.0..1.0, 0.0..TAU, 0.0..TAU).prop_map(|(z, around, angle): (f64, f64, f64)| {
        let across = (1.0 - z * z).sqrt();
        let axis = dvec3(across * around.cos(), across * around.sin(), z);
        DQuat::from_axis_angle(axis, angle)
    })
}

/// A way of a few times the size of the shapes.
pub fn translation() -> impl Strategy<Value = DVec3> {
    [-10.0..10.0, -10.0..10.0, -10.0..10.0].prop_map(DVec3::from_array)
}

/// A factor from a millionth to a million, small and large alike.
pub fn factor() -> impl Strategy<Value = f64> {
    (-6.0..=6.0).prop_map(|digits: f64| 10f64.powf(digits))
}
