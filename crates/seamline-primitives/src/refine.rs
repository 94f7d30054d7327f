//! Least squares: the surface of a kind nearest to points, by Levenberg and Marquardt's method from a guess.

use glam::DVec3;
use wide::f64x4;

use crate::freedom::{Cone, Cylinder, Frame, Freedom, Plane, Sphere, Torus};
use crate::linear::solve;
use crate::surface::{Kind, Surface};

/// A surface and how far its points are from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    pub surface: Surface,
    /// Root mean square of the distances.
    pub rms: f64,
}

/// Points in coordinates of their own: their centre is the origin, their root mean square distance from it one.
pub(crate) struct Cloud {
    centre: DVec3,
    radius: f64,
    count: f64,
    /// Four points each, and 1 for those that count: the last may have fewer.
    fours: Vec<([f64x4; 3], f64x4)>,
}

impl Cloud {
    /// `None` if all points are one, or a number is not finite.
    pub fn of(points: &[DVec3]) -> Option<Self> {
        let count = points.len() as f64;
        let centre = points.iter().sum::<DVec3>() / count;
        let squares: f64 = points.iter().map(|x| x.distance_squared(centre)).sum();
        let radius = (squares / count).sqrt();
        let four = |four: &[DVec3]| {
            let at = |i: usize| (*four.get(i).unwrap_or(&four[0]) - centre) / radius;
            let axis = |axis: usize| f64x4::from([0, 1, 2, 3].map(|i| at(i)[axis]));
            let counts = [0, 1, 2, 3].map(|i| if i < four.len() { 1.0 } else { 0.0 });
            ([axis(0), axis(1), axis(2)], f64x4::from(counts))
        };
        (radius > 0.0 && radius.is_finite()).then(|| Self {
            centre,
            radius,
            count,
            fours: points.chunks(4).map(four).collect(),
        })
    }
}

/// Share of the distances that a step is expected to leave, and two to have left, from which a fit is given up. At .5
/// surfaces whose guess is far off are lost (ARI .982 for .983 over the bench), and .85 finds no more on the bench and
/// takes a fifth longer.
const SOON: f64 = 0.7;
/// The same where nothing is to be lost.
const LATE: f64 = 0.99;

/// Improves `guess` until the points' distances are far below `tolerance`, or no longer fall.
///
/// Where points lie on a surface of the kind, five to ten steps do. Where they do not, distances soon stop
/// falling fast, and it is given up: nearly all time goes into fits that fail. `None` if a number left
/// the finite.
pub(crate) fn refine(guess: Surface, cloud: &Cloud, tolerance: f64) -> Option<Fit> {
    descend(guess, cloud, tolerance, SOON)
}

/// As [`refine`], but does not give up while distances fall at all.
pub(crate) fn refine_patiently(guess: Surface, points: &[DVec3], tolerance: f64) -> Option<Fit> {
    descend(guess, &Cloud::of(points)?, tolerance, LATE)
}

fn descend(guess: Surface, cloud: &Cloud, tolerance: f64, falls_to: f64) -> Option<Fit> {
    let goal = Goal {
        near: tolerance / cloud.radius,
        falls_to,
    };
    let surface = moved(guess, cloud.centre, cloud.radius);
    if !finite(&surface) {
        return None;
    }
    let (surface, rms) = match guess.kind {
        Kind::Plane => goal.descend::<3, Plane>(surface, cloud),
        Kind::Sphere => goal.descend::<4, Sphere>(surface, cloud),
        Kind::Cylinder => goal.descend::<5, Cylinder>(surface, cloud),
        Kind::Cone => goal.descend::<6, Cone>(surface, cloud),
        Kind::Torus => goal.descend::<7, Torus>(surface, cloud),
    };
    Some(Fit {
        surface: moved(surface, -cloud.centre / cloud.radius, 1.0 / cloud.radius),
        rms: rms * cloud.radius,
    })
}

const MOST_STEPS: usize = 15;

/// What a descent is after, in the points' own coordinates.
struct Goal {
    /// Root mean square distance that will do.
    near: f64,
    /// Farther off, distances must fall to this share at every second step.
    falls_to: f64,
}

impl Goal {
    /// The surface a descent ends at, and the root mean square distance of the points.
    fn descend<const N: usize, F: Freedom<N>>(
        &self,
        mut surface: Surface,
        cloud: &Cloud,
    ) -> (Surface, f64) {
        let Self { near, falls_to } = *self;
        let count = cloud.count;
        let mut frame = Frame::of(&surface);
        let mut at = Equations::at(F::at(&surface), &frame, cloud);
        let mut lambda = 1e-3;
        let mut before = [f64::INFINITY; 2];
        for _ in 0..MOST_STEPS {
            let now = (at.squares / count).sqrt();
            let hopeless = now > near && now > falls_to * before[0];
            if now < 0.02 * near || hopeless || now > 0.99 * before[1] {
                break;
            }
            before = [before[1], now];
            let mut improved = false;
            for _ in 0..4 {
                let Some(step) = solve(at.damped(lambda), at.right) else {
                    lambda *= 8.0;
                    continue;
                };
                let falls_by: f64 = step.iter().zip(at.right).map(|(s, r)| s * r).sum();
                if now > near && at.squares - falls_by > falls_to * falls_to * at.squares {
                    break;
                }
                let next = frame.stepped(&surface, F::step(step));
                let there = Equations::at(F::at(&next), &Frame::of(&next), cloud);
                if there.squares < at.squares && finite(&next) {
                    surface = next;
                    frame = Frame::of(&surface);
                    at = there;
                    lambda /= 10.0;
                    improved = true;
                    break;
                }
                lambda *= 8.0;
            }
            if !improved {
                break;
            }
        }
        (surface, (at.squares / count).sqrt())
    }
}

/// The surface in coordinates `(x - centre) / radius`.
fn moved(surface: Surface, centre: DVec3, radius: f64) -> Surface {
    let mut moved = Surface {
        point: (surface.point - centre) / radius,
        a: surface.a / radius,
        ..surface
    };
    if surface.kind == Kind::Torus {
        moved.b = surface.b / radius;
    }
    moved
}

fn finite(surface: &Surface) -> bool {
    let sane = surface.point.is_finite() && surface.axis.is_finite();
    sane && surface.a.is_finite() && surface.b.is_finite()
}

/// What a step starts from.
struct Equations<const N: usize> {
    /// Sum of the squared distances `f`.
    squares: f64,
    /// `J^T J`, its lower half.
    matrix: [[f64; N]; N],
    /// `-J^T f`.
    right: [f64; N],
}

impl<const N: usize> Equations<N> {
    fn at<F: Freedom<N>>(surface: F, frame: &Frame, cloud: &Cloud) -> Self {
        let mut squares = f64x4::ZERO;
        let mut matrix = [[f64x4::ZERO; N]; N];
        let mut right = [f64x4::ZERO; N];
        for &(points, counts) in &cloud.fours {
            let (f, row) = surface.distances(frame.seen(points));
            let f = f * counts;
            squares += f * f;
            for i in 0..N {
                right[i] -= row[i] * f;
                let counted = row[i] * counts;
                for j in 0..=i {
                    matrix[i][j] += counted * row[j];
                }
            }
        }
        Self {
            squares: squares.reduce_add(),
            matrix: matrix.map(|row| row.map(f64x4::reduce_add)),
            right: right.map(f64x4::reduce_add),
        }
    }

    fn damped(&self, lambda: f64) -> [[f64; N]; N] {
        let mut matrix = self.matrix;
        let trace: f64 = (0..N).map(|i| matrix[i][i]).sum();
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] += lambda * row[i] + 1e-13 * trace;
        }
        matrix
    }
}
