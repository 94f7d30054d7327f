//! The degrees of freedom of each kind of surface, in a frame of its own: as many numbers as determine it, so that
//! every step of a fit is determined, too.
//!
//! Points are looked at four at a time: nearly all time of a search goes into fits.

use glam::DVec3;
use wide::f64x4;

use crate::surface::Surface;

/// The frame of a surface: its point, two directions across its axis, and the axis.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    origin: DVec3,
    across: [DVec3; 2],
    axis: DVec3,
}

impl Frame {
    pub fn of(surface: &Surface) -> Self {
        let (u, v) = surface.axis.any_orthonormal_pair();
        Self {
            origin: surface.point,
            across: [u, v],
            axis: surface.axis,
        }
    }

    /// Points in this frame: across the axis, and along it.
    pub fn seen(&self, [x, y, z]: [f64x4; 3]) -> Seen {
        let [x, y, z] = [x - self.origin.x, y - self.origin.y, z - self.origin.z];
        let along = |d: DVec3| x * d.x + y * d.y + z * d.z;
        Seen {
            x: along(self.across[0]),
            y: along(self.across[1]),
            height: along(self.axis),
        }
    }

    /// The surface after a step.
    pub fn stepped(&self, surface: &Surface, step: Step) -> Surface {
        let [u, v] = self.across;
        let [x, y, along] = step.point;
        let [tilt_u, tilt_v] = step.tilt;
        Surface {
            kind: surface.kind,
            point: surface.point + x * u + y * v + along * self.axis,
            axis: (surface.axis + tilt_u * u + tilt_v * v).normalize_or(surface.axis),
            a: surface.a + step.a,
            b: surface.b + step.b,
        }
    }
}

/// Points in a surface's frame.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    x: f64x4,
    y: f64x4,
    height: f64x4,
}

impl Seen {
    /// Distance from the axis, and the direction of that, none on the axis.
    fn outward(self) -> (f64x4, [f64x4; 2]) {
        let distance = (self.x * self.x + self.y * self.y).sqrt();
        let over = reciprocal(distance);
        (distance, [self.x * over, self.y * over])
    }
}

/// One over a length; of none a number so large that only its product with nothing is one.
fn reciprocal(length: f64x4) -> f64x4 {
    f64x4::ONE / length.max(f64x4::splat(f64::MIN_POSITIVE))
}

/// A change of a surface, in its frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Step {
    pub point: [f64; 3],
    /// How far the tip of the unit axis moves across it.
    pub tilt: [f64; 2],
    pub a: f64,
    pub b: f64,
}

/// A kind of surface with `N` degrees of freedom, at one of its surfaces.
pub(crate) trait Freedom<const N: usize>: Copy {
    fn at(surface: &Surface) -> Self;

    /// Signed distances of points, and their derivatives by each degree of freedom.
    fn distances(self, seen: Seen) -> (f64x4, [f64x4; N]);

    /// The step that changes the degrees of freedom by these numbers.
    fn step(by: [f64; N]) -> Step;
}

#[derive(Clone, Copy)]
pub(crate) struct Plane;

impl Freedom<3> for Plane {
    fn at(_: &Surface) -> Self {
        Self
    }

    fn distances(self, Seen { x, y, height }: Seen) -> (f64x4, [f64x4; 3]) {
        (height, [-f64x4::ONE, x, y])
    }

    fn step([along, u, v]: [f64; 3]) -> Step {
        Step {
            point: [0.0, 0.0, along],
            tilt: [u, v],
            ..Step::default()
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Sphere {
    radius: f64,
}

impl Freedom<4> for Sphere {
    fn at(surface: &Surface) -> Self {
        Self { radius: surface.a }
    }

    fn distances(self, Seen { x, y, height }: Seen) -> (f64x4, [f64x4; 4]) {
        let length = (x * x + y * y + height * height).sqrt();
        let over = reciprocal(length);
        (
            length - self.radius,
            [-x * over, -y * over, -height * over, -f64x4::ONE],
        )
    }

    fn step([x, y, along, a]: [f64; 4]) -> Step {
        Step {
            point: [x, y, along],
            a,
            ..Step::default()
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Cylinder {
    radius: f64,
}

impl Freedom<5> for Cylinder {
    fn at(surface: &Surface) -> Self {
        Self { radius: surface.a }
    }

    fn distances(self, seen: Seen) -> (f64x4, [f64x4; 5]) {
        let (distance, [x, y]) = seen.outward();
        (
            distance - self.radius,
            [-x, -y, -seen.height * x, -seen.height * y, -f64x4::ONE],
        )
    }

    fn step([x, y, u, v, a]: [f64; 5]) -> Step {
        Step {
            point: [x, y, 0.0],
            tilt: [u, v],
            a,
            b: 0.0,
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Cone {
    radius: f64,
    sin: f64,
    cos: f64,
}

impl Freedom<6> for Cone {
    fn at(surface: &Surface) -> Self {
        let (sin, cos) = surface.b.sin_cos();
        Self {
            radius: surface.a,
            sin,
            cos,
        }
    }

    fn distances(self, seen: Seen) -> (f64x4, [f64x4; 6]) {
        let Self { radius, sin, cos } = self;
        let (distance, [x, y]) = seen.outward();
        let over = distance - radius;
        let tilt = -seen.height * cos - distance * sin;
        (
            over * cos - seen.height * sin,
            [
                -x * cos,
                -y * cos,
                tilt * x,
                tilt * y,
                f64x4::splat(-cos),
                -over * sin - seen.height * cos,
            ],
        )
    }

    fn step([x, y, u, v, a, b]: [f64; 6]) -> Step {
        Step {
            point: [x, y, 0.0],
            tilt: [u, v],
            a,
            b,
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Torus {
    major: f64,
    minor: f64,
}

impl Freedom<7> for Torus {
    fn at(surface: &Surface) -> Self {
        Self {
            major: surface.a,
            minor: surface.b,
        }
    }

    fn distances(self, seen: Seen) -> (f64x4, [f64x4; 7]) {
        let (distance, [x, y]) = seen.outward();
        let over = distance - self.major;
        let tube = (over * over + seen.height * seen.height).sqrt();
        let per = reciprocal(tube);
        let (over, height) = (over * per, seen.height * per);
        let tilt = height * distance - over * seen.height;
        (
            tube - self.minor,
            [
                -over * x,
                -over * y,
                -height,
                tilt * x,
                tilt * y,
                -over,
                -f64x4::ONE,
            ],
        )
    }

    fn step([x, y, along, u, v, a, b]: [f64; 7]) -> Step {
        Step {
            point: [x, y, along],
            tilt: [u, v],
            a,
            b,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Kind;
    use crate::surface::tests::{near_a_singular_place, surface, vector};
    use proptest::prelude::*;

    const STEP: f64 = 1e-6;

    fn holds<const N: usize, F: Freedom<N>>(surface: &Surface, x: DVec3) {
        assert_eq!(N, surface.kind.degrees_of_freedom());
        let frame = Frame::of(surface);
        let (distances, row) = F::at(surface).distances(frame.seen(x.to_array().map(f64x4::splat)));
        let distance = distances.to_array()[0];
        let row = row.map(|of_points| of_points.to_array()[0]);
        assert!((distance - surface.distance(x)).abs() < 1e-12);
        for (i, derivative) in row.into_iter().enumerate() {
            let stepped = |by: f64| {
                let mut change = [0.0; N];
                change[i] = by;
                frame.stepped(surface, F::step(change)).distance(x)
            };
            let slope = (stepped(STEP) - stepped(-STEP)) / (2.0 * STEP);
            assert!(
                (slope - derivative).abs() < 1e-5,
                "{i}: {slope} {derivative}"
            );
        }
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_the_distance(surface in surface(), x in vector()) {
            prop_assume!(!near_a_singular_place(&surface, x));
            match surface.kind {
                Kind::Plane => holds::<3, Plane>(&surface, x),
                Kind::Sphere => holds::<4, Sphere>(&surface, x),
                Kind::Cylinder => holds::<5, Cylinder>(&surface, x),
                Kind::Cone => holds::<6, Cone>(&surface, x),
                Kind::Torus => holds::<7, Torus>(&surface, x),
            }
        }
    }
}
