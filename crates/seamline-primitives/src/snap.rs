//! What was designed equal comes out equal: directions of axes, common axes and radii of surfaces that agree as
//! far as their vertices can tell.
//!
//! Of those that agree the one of most evidence is taken at its word, and another follows it only if its own
//! vertices still lie on it exactly.

use glam::DVec3;

use crate::Fitted;
use crate::surface::{Kind, Surface};

/// Angle between axes, in radians, and distance between them or between radii, in diagonals, up to which two may be
/// meant to be equal. A fillet of a hundredth of a diagonal tells the direction of its axis to some 1e-5.
const SAME_ANGLE: f64 = 1e-4;
const SAME_LENGTH: f64 = 5e-6;

/// Makes equal what agrees. `points` has vertices of each patch.
pub(crate) fn snap(fitted: &mut [Option<Fitted>], points: &[Vec<DVec3>], precision: f64) {
    let mut exact: Vec<usize> = (0..fitted.len())
        .filter(|&i| fitted[i].is_some_and(|f| f.exact && f.surface.kind != Kind::Plane))
        .collect();
    exact.sort_by_key(|&i| std::cmp::Reverse(fitted[i].map_or(0, |f| f.evidence)));
    let mut snapper = Snapper {
        fitted,
        points,
        precision,
    };
    snapper.directions(&exact);
    snapper.lines(&exact);
    for radius in [Radius::First, Radius::Second] {
        snapper.radii(&exact, radius);
    }
}

/// Which of a surface's lengths: the radius, or the minor radius of a torus.
#[derive(Clone, Copy)]
enum Radius {
    First,
    Second,
}

impl Radius {
    fn of(self, surface: &mut Surface) -> Option<&mut f64> {
        match (self, surface.kind) {
            (Self::First, Kind::Cylinder | Kind::Sphere | Kind::Torus) => Some(&mut surface.a),
            (Self::Second, Kind::Torus) => Some(&mut surface.b),
            _ => None,
        }
    }
}

struct Snapper<'a> {
    fitted: &'a mut [Option<Fitted>],
    points: &'a [Vec<DVec3>],
    precision: f64,
}

impl Snapper<'_> {
    fn surface(&self, patch: usize) -> Option<Surface> {
        self.fitted[patch].map(|f| f.surface)
    }

    /// Puts `surface` in the place of a patch's own if its vertices lie on it exactly too.
    fn follow(&mut self, patch: usize, surface: Surface) -> bool {
        let rms = surface.rms(&self.points[patch]);
        let lies = rms <= self.precision;
        if let Some(fitted) = self.fitted[patch].as_mut().filter(|_| lies) {
            fitted.surface = surface;
            fitted.residual = fitted.residual.max(rms);
        }
        lies
    }

    /// Axes of one direction. A cone's radius grows along its axis, and its axis keeps its sense.
    fn directions(&mut self, patches: &[usize]) {
        let mut leaders: Vec<DVec3> = Vec::new();
        for &patch in patches {
            let Some(own) = self.surface(patch).filter(has_axis) else {
                continue;
            };
            let near = |leader: &&DVec3| own.axis.cross(**leader).length() <= SAME_ANGLE;
            let Some(&leader) = leaders.iter().find(near) else {
                leaders.push(own.axis);
                continue;
            };
            let axis = leader * own.axis.dot(leader).signum();
            // The axis turns about the middle of what lies on it.
            let points = &self.points[patch];
            let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
            let slides = own.kind != Kind::Torus;
            let along = if slides {
                (middle - own.point).dot(own.axis)
            } else {
                0.0
            };
            let surface = Surface {
                axis,
                point: own.point + along * own.axis,
                a: if own.kind == Kind::Cone {
                    own.a + along * own.b.tan()
                } else {
                    own.a
                },
                ..own
            };
            if !self.follow(patch, surface) && leaders.len() < MOST_LEADERS {
                leaders.push(own.axis);
            }
        }
    }

    /// Surfaces about one line.
    fn lines(&mut self, patches: &[usize]) {
        let mut leaders: Vec<Surface> = Vec::new();
        for &patch in patches {
            let Some(own) = self.surface(patch).filter(has_axis) else {
                continue;
            };
            let off = |leader: &Surface| {
                let way = own.point - leader.point;
                way - way.dot(own.axis) * own.axis
            };
            let near = |leader: &&Surface| {
                own.axis.cross(leader.axis).length() <= f64::EPSILON * 8.0
                    && off(leader).length() <= SAME_LENGTH
            };
            let leader = leaders.iter().find(near).copied();
            let moved = leader.map(|leader| Surface {
                point: own.point - off(&leader),
                ..own
            });
            if !moved.is_some_and(|moved| self.follow(patch, moved)) && leaders.len() < MOST_LEADERS
            {
                leaders.push(own);
            }
        }
    }

    fn radii(&mut self, patches: &[usize], radius: Radius) {
        let mut leaders: Vec<f64> = Vec::new();
        for &patch in patches {
            let Some(mut own) = self.surface(patch) else {
                continue;
            };
            let Some(value) = radius.of(&mut own) else {
                continue;
            };
            let near = |leader: &&f64| (*value - **leader).abs() <= SAME_LENGTH;
            let leader = leaders.iter().find(near).copied();
            let before = std::mem::replace(value, leader.unwrap_or(*value));
            if !(leader.is_some() && self.follow(patch, own)) && leaders.len() < MOST_LEADERS {
                leaders.push(before);
            }
        }
    }
}

/// Different axes or radii that are looked at: beyond, a part is no longer one whose equals anybody looks for.
const MOST_LEADERS: usize = 2000;

fn has_axis(surface: &Surface) -> bool {
    surface.kind != Kind::Sphere
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points all about a cylinder.
    fn points(surface: &Surface) -> Vec<DVec3> {
        let (u, v) = surface.axis.any_orthonormal_pair();
        (0..40)
            .map(|i| {
                let (sin, cos) = f64::from(i).sin_cos();
                let height = f64::from(i % 4) * 0.05 * surface.axis;
                surface.point + height + surface.a * (cos * u + sin * v)
            })
            .collect()
    }

    fn cylinder(point: DVec3, axis: DVec3, a: f64, evidence: u32) -> Fitted {
        let surface = Surface {
            kind: Kind::Cylinder,
            point,
            axis: axis.normalize(),
            a,
            b: 0.0,
        };
        Fitted {
            surface,
            convex: true,
            residual: 0.0,
            exact: true,
            evidence,
        }
    }

    fn snapped(all: &[Fitted]) -> Vec<Surface> {
        let points: Vec<_> = all.iter().map(|f| points(&f.surface)).collect();
        let mut fitted: Vec<_> = all.iter().copied().map(Some).collect();
        snap(&mut fitted, &points, 5e-8);
        fitted.into_iter().flatten().map(|f| f.surface).collect()
    }

    #[test]
    fn two_holes_of_hardly_different_radii_and_axes_come_out_equal() {
        let found = snapped(&[
            cylinder(DVec3::ZERO, DVec3::new(1e-7, 0.0, 1.0), 0.1 + 1e-8, 20),
            cylinder(DVec3::X, DVec3::Z, 0.1, 100),
            cylinder(DVec3::new(2e-8, 0.0, 0.5), -DVec3::Z, 0.1 - 1e-8, 30),
        ]);
        assert!(found.iter().all(|s| s.a == 0.1));
        assert!(found.iter().all(|s| s.axis.z.abs() == 1.0));
        assert_eq!(found[0].point.truncate(), found[2].point.truncate());
        assert_eq!(found[2].axis, -DVec3::Z);
    }

    #[test]
    fn what_differs_by_more_than_vertices_err_stays_different() {
        let found = snapped(&[
            cylinder(DVec3::ZERO, DVec3::Z, 0.1, 100),
            cylinder(DVec3::X, DVec3::new(1e-5, 0.0, 1.0), 0.1 + 1e-6, 20),
        ]);
        assert!((found[1].a - found[0].a - 1e-6).abs() < 1e-12);
        assert!(found[1].axis.x > 9e-6);
    }
}
