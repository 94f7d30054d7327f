//! The five surfaces of mechanical parts, each with its signed distance and its gradient.

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
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use proptest::prelude::*;

    pub fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-2.0..2.0f64).prop_map(DVec3::from_array)
    }

    pub fn surface() -> impl Strategy<Value = Surface> {
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

    pub fn near_a_singular_place(surface: &Surface, x: DVec3) -> bool {
        surface.about_axis(x).distance < 0.05
            || surface.off_tube(x) < 0.05
            || (x - surface.point).length() < 0.05
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
            prop_assume!(!near_a_singular_place(&surface, x));
            prop_assert!(((ahead - behind) / (2.0 * STEP) - 1.0).abs() < 1e-5);
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
