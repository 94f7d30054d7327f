//! The five surfaces of mechanical parts, each with its signed distance, its gradient and what a distance
//! owes to each parameter.

use glam::DVec3;

/// What kind of surface it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A plane.
    Plane,
    /// A cylinder of revolution.
    Cylinder,
    /// A cone of revolution.
    Cone,
    /// A sphere.
    Sphere,
    /// A torus.
    Torus,
}

impl Kind {
    /// The curved ones, those of fewer degrees of freedom first.
    pub const CURVED: [Self; 4] = [Self::Sphere, Self::Cylinder, Self::Cone, Self::Torus];

    /// How many numbers determine a surface of this kind.
    pub fn degrees_of_freedom(self) -> usize {
        match self {
            Self::Plane => 3,
            Self::Sphere => 4,
            Self::Cylinder => 5,
            Self::Cone => 6,
            Self::Torus => 7,
        }
    }
}

/// A surface in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Its kind.
    pub kind: Kind,
    /// A point of the plane, a point of the axis (for a cone near the data, not its apex), or the centre.
    pub point: DVec3,
    /// Unit normal of the plane, unit direction of the axis; no meaning for a sphere.
    pub axis: DVec3,
    /// Radius: of the cylinder, of the cone at `point`, of the sphere; major radius of the torus.
    pub a: f64,
    /// Half angle of the cone in radians (the radius grows along `axis`), minor radius of the torus.
    pub b: f64,
}

/// A point as a surface of revolution sees it: height along the axis, distance from it, direction there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AboutAxis {
    pub from_point: DVec3,
    pub height: f64,
    pub distance: f64,
    pub outward: DVec3,
}

impl Surface {
    /// Root mean square distance of points; 0 of none.
    pub(crate) fn rms(&self, points: &[DVec3]) -> f64 {
        let squares: f64 = points.iter().map(|&x| self.distance(x).powi(2)).sum();
        (squares / points.len().max(1) as f64).sqrt()
    }

    pub(crate) fn about_axis(&self, x: DVec3) -> AboutAxis {
        let from_point = x - self.point;
        let height = from_point.dot(self.axis);
        let across = from_point - height * self.axis;
        let distance = across.length();
        AboutAxis {
            from_point,
            height,
            distance,
            outward: if distance > 0.0 {
                across / distance
            } else {
                self.axis.any_orthonormal_vector()
            },
        }
    }

    /// The same surface with a cone's radius growing along its axis and no negative radius but a spindle's.
    pub(crate) fn with_positive_radii(self) -> Self {
        match self.kind {
            Kind::Cone if self.b < 0.0 => Self {
                axis: -self.axis,
                b: -self.b,
                ..self
            },
            Kind::Torus => Self {
                b: self.b.abs(),
                ..self
            },
            _ => self,
        }
    }

    /// Signed distance of a point: positive away from the axis, from the centre of the sphere, from the
    /// circle in the tube of the torus, or on the normal's side of the plane.
    #[inline]
    pub fn distance(&self, x: DVec3) -> f64 {
        match self.kind {
            Kind::Plane => (x - self.point).dot(self.axis),
            Kind::Sphere => (x - self.point).length() - self.a,
            Kind::Cylinder => self.about_axis(x).distance - self.a,
            Kind::Cone => {
                let at = self.about_axis(x);
                let (sin, cos) = self.b.sin_cos();
                (at.distance - self.a) * cos - at.height * sin
            }
            Kind::Torus => {
                let at = self.about_axis(x);
                ((at.distance - self.a).powi(2) + at.height.powi(2)).sqrt() - self.b
            }
        }
    }

    /// Unit direction in which the distance grows: the normal, where `x` is on the surface.
    pub fn gradient(&self, x: DVec3) -> DVec3 {
        match self.kind {
            Kind::Plane => self.axis,
            Kind::Sphere => (x - self.point).normalize_or(DVec3::Z),
            Kind::Cylinder => self.about_axis(x).outward,
            Kind::Cone => self.about_axis(x).outward * self.b.cos() - self.axis * self.b.sin(),
            Kind::Torus => {
                let at = self.about_axis(x);
                ((at.distance - self.a) * at.outward + at.height * self.axis)
                    .normalize_or(at.outward)
            }
        }
    }

    /// Distance of `x`, and its derivatives by point (3), axis (3), `a` and `b`.
    #[inline]
    pub(crate) fn derivatives(&self, x: DVec3) -> (f64, [f64; 8]) {
        let row = |point: DVec3, axis: DVec3, a: f64, b: f64| {
            [point.x, point.y, point.z, axis.x, axis.y, axis.z, a, b]
        };
        match self.kind {
            Kind::Plane => {
                let from_point = x - self.point;
                (
                    from_point.dot(self.axis),
                    row(-self.axis, from_point, 0.0, 0.0),
                )
            }
            Kind::Sphere => {
                let from_point = x - self.point;
                let length = from_point.length().max(f64::MIN_POSITIVE);
                (
                    length - self.a,
                    row(-from_point / length, DVec3::ZERO, -1.0, 0.0),
                )
            }
            Kind::Cylinder => {
                let at = self.about_axis(x);
                (
                    at.distance - self.a,
                    row(-at.outward, -at.height * at.outward, -1.0, 0.0),
                )
            }
            Kind::Cone => {
                let at = self.about_axis(x);
                let (sin, cos) = self.b.sin_cos();
                let over = at.distance - self.a;
                (
                    over * cos - at.height * sin,
                    row(
                        -at.outward * cos + self.axis * sin,
                        -at.height * at.outward * cos - at.from_point * sin,
                        -cos,
                        -over * sin - at.height * cos,
                    ),
                )
            }
            Kind::Torus => {
                let at = self.about_axis(x);
                let over = at.distance - self.a;
                let tube = (over * over + at.height * at.height)
                    .sqrt()
                    .max(f64::MIN_POSITIVE);
                let (over, height) = (over / tube, at.height / tube);
                (
                    tube - self.b,
                    row(
                        -over * at.outward - height * self.axis,
                        -over * at.height * at.outward + height * at.from_point,
                        -over,
                        -1.0,
                    ),
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-2.0..2.0f64).prop_map(DVec3::from_array)
    }

    fn surface() -> impl Strategy<Value = Surface> {
        let kinds = prop::sample::select(vec![
            Kind::Plane,
            Kind::Cylinder,
            Kind::Cone,
            Kind::Sphere,
            Kind::Torus,
        ]);
        (kinds, vector(), vector(), 0.5..2.0f64, 0.1..1.2f64).prop_map(
            |(kind, point, axis, a, b)| Surface {
                kind,
                point,
                axis: axis.normalize_or(DVec3::X),
                a,
                b,
            },
        )
    }

    const STEP: f64 = 1e-6;

    proptest! {
        #[test]
        fn the_distance_grows_along_the_gradient_as_fast_as_one_goes(
            surface in surface(),
            x in vector(),
        ) {
            let gradient = surface.gradient(x);
            let ahead = surface.distance(x + STEP * gradient);
            let behind = surface.distance(x - STEP * gradient);
            let near_a_singular_place = surface.about_axis(x).distance < 0.05
                || surface.off_tube(x) < 0.05
                || (x - surface.point).length() < 0.05;
            prop_assume!(!near_a_singular_place);
            prop_assert!(((ahead - behind) / (2.0 * STEP) - 1.0).abs() < 1e-5);
        }

        #[test]
        fn derivatives_are_those_of_the_distance(surface in surface(), x in vector()) {
            let near_a_singular_place = surface.about_axis(x).distance < 0.05
                || surface.off_tube(x) < 0.05
                || (x - surface.point).length() < 0.05;
            prop_assume!(!near_a_singular_place);
            let (distance, row) = surface.derivatives(x);
            prop_assert!((distance - surface.distance(x)).abs() < 1e-12);
            for (i, derivative) in row.into_iter().enumerate() {
                // The axis is a direction: steps along it do not count.
                if (3..6).contains(&i) {
                    continue;
                }
                let stepped = |by: f64| {
                    let mut next = surface;
                    match i {
                        0..3 => next.point[i] += by,
                        6 => next.a += by,
                        _ => next.b += by,
                    }
                    next.distance(x)
                };
                let slope = (stepped(STEP) - stepped(-STEP)) / (2.0 * STEP);
                prop_assert!((slope - derivative).abs() < 1e-5, "{i}: {slope} {derivative}");
            }
            let across = surface.axis.any_orthonormal_vector();
            let turned = |by: f64| {
                let axis = (surface.axis + by * across).normalize();
                Surface { axis, ..surface }.distance(x)
            };
            let slope = (turned(STEP) - turned(-STEP)) / (2.0 * STEP);
            let derivative = DVec3::new(row[3], row[4], row[5]).dot(across);
            prop_assert!((slope - derivative).abs() < 1e-5, "axis: {slope} {derivative}");
        }
    }

    impl Surface {
        /// Distance from the circle in a torus' tube.
        fn off_tube(&self, x: DVec3) -> f64 {
            let at = self.about_axis(x);
            (at.distance - self.a).hypot(at.height)
        }
    }
}
