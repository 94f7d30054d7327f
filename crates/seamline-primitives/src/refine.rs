//! Least squares: the surface of a kind nearest to points, by Levenberg and Marquardt's method from a guess.

use glam::DVec3;

use crate::linear::solve;
use crate::surface::{Kind, Surface};

/// A surface and how far its points are from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    pub surface: Surface,
    /// Root mean square of the distances.
    pub rms: f64,
}

/// Improves `guess` until the points' distances are far below `tolerance`, or no longer fall.
///
/// Where points lie on a surface of the kind, five to ten steps do. Where they do not, distances soon stop
/// falling fast, and it is given up: nearly all time goes into fits that fail. `None` if a number left
/// the finite.
pub(crate) fn refine(guess: Surface, points: &[DVec3], tolerance: f64) -> Option<Fit> {
    descend(guess, points, tolerance, 0.5)
}

/// As [`refine`], but does not give up while distances fall at all.
pub(crate) fn refine_patiently(guess: Surface, points: &[DVec3], tolerance: f64) -> Option<Fit> {
    descend(guess, points, tolerance, 0.99)
}

fn descend(guess: Surface, points: &[DVec3], tolerance: f64, falls_to: f64) -> Option<Fit> {
    let (centre, radius) = extent(points)?;
    let goal = 0.02 * tolerance / radius;
    let near = tolerance / radius;
    let local: Vec<DVec3> = points.iter().map(|&x| (x - centre) / radius).collect();
    let mut surface = moved(guess, centre, radius);
    if !finite(&surface) {
        return None;
    }
    let mut at = Equations::at(&surface, &local);
    let count = local.len() as f64;
    let rms = |squares: f64| (squares / count).sqrt();
    let mut lambda = 1e-3;
    let mut before = [f64::INFINITY; 2];
    for _ in 0..MOST_STEPS {
        if rms(at.squares) < goal {
            break;
        }
        let now = rms(at.squares);
        let hopeless = now > near && now > falls_to * before[0];
        if hopeless || now > 0.99 * before[1] {
            break;
        }
        before = [before[1], now];
        let mut improved = false;
        for _ in 0..4 {
            let Some(step) = solve(damped(&surface, at.matrix, lambda), at.right) else {
                lambda *= 8.0;
                continue;
            };
            let falls_by: f64 = step.iter().zip(at.right).map(|(s, r)| s * r).sum();
            if now > near && at.squares - falls_by > falls_to * falls_to * at.squares {
                break;
            }
            let next = stepped(&surface, step);
            let there = Equations::at(&next, &local);
            if there.squares < at.squares && finite(&next) {
                surface = next;
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
    let surface = moved(surface, -centre / radius, 1.0 / radius);
    Some(Fit {
        surface,
        rms: rms(at.squares) * radius,
    })
}

const MOST_STEPS: usize = 15;

/// Centre of the points, and root mean square distance from it.
fn extent(points: &[DVec3]) -> Option<(DVec3, f64)> {
    let count = points.len() as f64;
    let centre = points.iter().sum::<DVec3>() / count;
    let radius = (points
        .iter()
        .map(|x| x.distance_squared(centre))
        .sum::<f64>()
        / count)
        .sqrt();
    (radius > 0.0 && radius.is_finite()).then_some((centre, radius))
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

type Matrix = [[f64; 8]; 8];

/// What a step starts from.
struct Equations {
    /// Sum of the squared distances `f`.
    squares: f64,
    /// `J^T J`, its lower half.
    matrix: Matrix,
    /// `-J^T f`.
    right: [f64; 8],
}

impl Equations {
    fn at(surface: &Surface, points: &[DVec3]) -> Self {
        let mut of = Self {
            squares: 0.0,
            matrix: [[0.0; 8]; 8],
            right: [0.0; 8],
        };
        for &x in points {
            let (f, row) = surface.derivatives(x);
            of.squares += f * f;
            for i in 0..8 {
                of.right[i] -= row[i] * f;
                for j in 0..=i {
                    of.matrix[i][j] += row[i] * row[j];
                }
            }
        }
        of
    }
}

/// Damped, and held where the surface does not depend on the step: along the axis' own direction, and for
/// a point that may slide along the axis.
fn damped(surface: &Surface, mut matrix: Matrix, lambda: f64) -> Matrix {
    let trace: f64 = (0..8).map(|i| matrix[i][i]).sum();
    let d = surface.axis.to_array();
    let slides = matches!(surface.kind, Kind::Cylinder | Kind::Cone);
    for i in 0..3 {
        for j in 0..=i {
            matrix[3 + i][3 + j] += trace * d[i] * d[j];
            if slides {
                matrix[i][j] += trace * d[i] * d[j];
            }
        }
    }
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] += lambda * row[i] + 1e-13 * trace;
    }
    matrix
}

fn stepped(surface: &Surface, step: [f64; 8]) -> Surface {
    let [px, py, pz, dx, dy, dz, a, b] = step;
    Surface {
        kind: surface.kind,
        point: surface.point + DVec3::new(px, py, pz),
        axis: (surface.axis + DVec3::new(dx, dy, dz)).normalize_or(surface.axis),
        a: surface.a + a,
        b: surface.b + b,
    }
}
