//! First guesses of a surface from a few facets: their normals and centroids, and the vertices between.

use glam::DVec3;

use crate::eigen::symmetric;
use crate::linear::solve;
use crate::surface::{Kind, Surface};

/// What a guess is made from.
pub(crate) struct Neighbourhood<'a> {
    /// Unit normal of each facet.
    pub normals: &'a [DVec3],
    /// Centroid of each facet.
    pub centroids: &'a [DVec3],
    /// Distinct vertices of all facets.
    pub points: &'a [DVec3],
}

/// Facets of a neighbourhood: normals and centroids.
pub(crate) struct Facets {
    pub normals: Vec<DVec3>,
    pub centroids: Vec<DVec3>,
}

impl Facets {
    /// The facets with the vertices between them.
    pub fn between<'a>(&'a self, points: &'a [DVec3]) -> Neighbourhood<'a> {
        Neighbourhood {
            normals: &self.normals,
            centroids: &self.centroids,
            points,
        }
    }

    /// Each two that follow each other as one: triangles to and fro between two rims lean one way and the other,
    /// two together neither way.
    pub fn paired(&self) -> Self {
        let pairs = |of: &[DVec3]| -> Vec<DVec3> {
            of.windows(2).map(|two| (two[0] + two[1]) / 2.0).collect()
        };
        let normals = pairs(&self.normals).into_iter();
        Self {
            normals: normals.map(DVec3::normalize_or_zero).collect(),
            centroids: pairs(&self.centroids),
        }
    }
}

/// Radii above this many times the extent of the neighbourhood bend too little to be told from a plane.
const MOST_RADIUS: f64 = 30.0;

/// Guesses for surfaces of one kind: none, one, or two for the torus, whose axis may be the second best.
pub(crate) fn guesses(kind: Kind, of: &Neighbourhood) -> Vec<Surface> {
    let found = match kind {
        Kind::Plane => Vec::new(),
        Kind::Sphere => sphere(of).into_iter().collect(),
        Kind::Cylinder => cylinder(of).into_iter().collect(),
        Kind::Cone => cone(of).into_iter().collect(),
        Kind::Torus => torus(of),
    };
    let extent = extent(of.points);
    let sane = |s: &Surface| s.a.is_finite() && s.a < MOST_RADIUS * extent && s.axis.is_finite();
    found.into_iter().filter(sane).collect()
}

fn mean(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len() as f64
}

/// Greatest side of the points' box.
fn extent(points: &[DVec3]) -> f64 {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    (high - low).length()
}

/// The direction in which the vectors vary least, and whether they vary in two others.
fn least_direction(vectors: impl Iterator<Item = DVec3>) -> Option<DVec3> {
    let mut m = [[0.0; 3]; 3];
    let mut count = 0.0;
    for v in vectors {
        let v = v.to_array();
        for i in 0..3 {
            for j in 0..3 {
                m[i][j] += v[i] * v[j];
            }
        }
        count += 1.0;
    }
    let (values, axes) = symmetric(m);
    (values[1] >= 1e-6 * count).then(|| DVec3::from_array(axes[0]))
}

/// Centre and radius of the circle nearest to points of a plane, by Kasa's linear method.
fn circle(points: impl Iterator<Item = [f64; 2]> + Clone) -> Option<([f64; 2], f64)> {
    let count = points.clone().count() as f64;
    let [mx, my] = points
        .clone()
        .fold([0.0; 2], |[x, y], p| [x + p[0] / count, y + p[1] / count]);
    let [mut xx, mut xy, mut yy, mut xz, mut yz, mut zz] = [0.0; 6];
    for [x, y] in points {
        let (x, y) = (x - mx, y - my);
        let z = x * x + y * y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
        zz += z;
    }
    let determinant = xx * yy - xy * xy;
    if determinant <= 1e-14 * (xx + yy).powi(2) {
        return None;
    }
    let cx = (xz * yy - yz * xy) / (2.0 * determinant);
    let cy = (yz * xx - xz * xy) / (2.0 * determinant);
    let radius = (zz / count + cx * cx + cy * cy).sqrt();
    Some(([cx + mx, cy + my], radius))
}

fn sphere(of: &Neighbourhood) -> Option<Surface> {
    let centre = mean(of.points);
    let mut m = [[0.0; 3]; 3];
    let mut right = [0.0; 3];
    let mut mean_square = 0.0;
    for x in of.points {
        let x = (*x - centre).to_array();
        let square = x.iter().map(|x| x * x).sum::<f64>();
        mean_square += square;
        for i in 0..3 {
            right[i] += x[i] * square / 2.0;
            for j in 0..3 {
                m[i][j] += x[i] * x[j];
            }
        }
    }
    let (values, axes) = symmetric(m);
    if values[0] <= 1e-14 * values[2] {
        return None;
    }
    let right = DVec3::from_array(right);
    let offset: DVec3 = values
        .iter()
        .zip(axes)
        .map(|(value, axis)| {
            let axis = DVec3::from_array(axis);
            axis * (axis.dot(right) / value)
        })
        .sum();
    let radius = (mean_square / of.points.len() as f64 + offset.length_squared()).sqrt();
    Some(Surface {
        kind: Kind::Sphere,
        point: centre + offset,
        axis: DVec3::Z,
        a: radius,
        b: 0.0,
    })
}

fn cylinder(of: &Neighbourhood) -> Option<Surface> {
    cylinder_about(least_direction(of.normals.iter().copied())?, of.points)
}

/// The cylinder of a given direction that comes nearest to points, by Kasa's linear method.
pub(crate) fn cylinder_about(axis: DVec3, points: &[DVec3]) -> Option<Surface> {
    let (u, v) = axis.any_orthonormal_pair();
    let centre = mean(points);
    let flat = points.iter().map(|&x| {
        let x = x - centre;
        [x.dot(u), x.dot(v)]
    });
    let ([x, y], radius) = circle(flat)?;
    Some(Surface {
        kind: Kind::Cylinder,
        point: centre + x * u + y * v,
        axis,
        a: radius,
        b: 0.0,
    })
}

fn cone(of: &Neighbourhood) -> Option<Surface> {
    let middle = mean(of.normals);
    let axis = least_direction(of.normals.iter().map(|&n| n - middle))?;
    let (u, v) = axis.any_orthonormal_pair();
    let centre = mean(of.points);
    // Each facet's normal line, seen along the axis, passes through the axis.
    let [mut xx, mut xy, mut yy, mut rx, mut ry] = [0.0; 5];
    for (n, c) in of.normals.iter().zip(of.centroids) {
        let c = *c - centre;
        let (a, b) = (-n.dot(v), n.dot(u));
        let r = a * c.dot(u) + b * c.dot(v);
        xx += a * a;
        xy += a * b;
        yy += b * b;
        rx += a * r;
        ry += b * r;
    }
    let determinant = xx * yy - xy * xy;
    if determinant <= 1e-12 * (xx + yy).powi(2) {
        return None;
    }
    let x = (rx * yy - ry * xy) / determinant;
    let y = (ry * xx - rx * xy) / determinant;
    let point = centre + x * u + y * v;
    // The straight line distance = a + slope height.
    let count = of.points.len() as f64;
    let profile = of.points.iter().map(|&p| {
        let p = p - point;
        let height = p.dot(axis);
        (height, (p - height * axis).length())
    });
    let (mut mh, mut md) = (0.0, 0.0);
    for (h, d) in profile.clone() {
        mh += h / count;
        md += d / count;
    }
    let (mut hh, mut hd) = (0.0, 0.0);
    for (h, d) in profile {
        hh += (h - mh).powi(2);
        hd += (h - mh) * (d - md);
    }
    let slope = if hh > 0.0 { hd / hh } else { 0.0 };
    Some(Surface {
        kind: Kind::Cone,
        point: point + mh * axis,
        axis,
        a: md,
        b: slope.atan(),
    })
}

/// The cone about a given direction that comes nearest to points, cylinders among them: with `r = a + t h` for the
/// radius at height `h`, `x^2 + y^2` is linear in `x`, `y`, `h`, `h^2` and 1. Asks no normals, which lean to and fro on
/// strips of triangles.
pub(crate) fn cone_about(axis: DVec3, points: &[DVec3]) -> Option<Surface> {
    let (u, v) = axis.any_orthonormal_pair();
    let centre = mean(points);
    let size = extent(points);
    let mut m = [[0.0; 5]; 5];
    let mut right = [0.0; 5];
    for &p in points {
        let p = (p - centre) / size;
        let (x, y, h) = (p.dot(u), p.dot(v), p.dot(axis));
        let row = [x, y, h, h * h, 1.0];
        for i in 0..5 {
            right[i] += row[i] * (x * x + y * y);
            for j in 0..=i {
                m[i][j] += row[i] * row[j];
            }
        }
    }
    let trace: f64 = (0..5).map(|i| m[i][i]).sum();
    for (i, row) in m.iter_mut().enumerate() {
        row[i] += 1e-13 * trace;
    }
    let [x, y, h, hh, one] = solve(m, right)?;
    let (x, y) = (x / 2.0, y / 2.0);
    let radius = (one + x * x + y * y).max(0.0).sqrt();
    let slope = if radius > 0.0 {
        h / (2.0 * radius)
    } else {
        hh.max(0.0).sqrt()
    };
    let found = Surface {
        kind: Kind::Cone,
        point: centre + size * (x * u + y * v),
        axis,
        a: size * radius,
        b: slope.atan(),
    };
    (found.point.is_finite() && found.a.is_finite() && found.b.is_finite()).then_some(found)
}

/// The axis is a line that all normal lines meet: `(c x n) . d + n . m = 0` with its direction `d` and
/// moment `m`.
fn torus(of: &Neighbourhood) -> Vec<Surface> {
    let centre = mean(of.points);
    let size = extent(of.points).max(f64::MIN_POSITIVE);
    let mut m = [[0.0; 6]; 6];
    for (n, c) in of.normals.iter().zip(of.centroids) {
        let moment = ((*c - centre) / size).cross(*n);
        let row = [moment.x, moment.y, moment.z, n.x, n.y, n.z];
        for i in 0..6 {
            for j in 0..6 {
                m[i][j] += row[i] * row[j];
            }
        }
    }
    let (_, lines) = symmetric(m);
    let about = |line: [f64; 6]| {
        let d = DVec3::new(line[0], line[1], line[2]);
        let moment = DVec3::new(line[3], line[4], line[5]);
        let length = d.length();
        if length < 1e-6 {
            return None;
        }
        let axis = d / length;
        let point = centre + axis.cross(moment / length) * size;
        let profile = of.points.iter().map(|&p| {
            let p = p - point;
            let height = p.dot(axis);
            [(p - height * axis).length(), height]
        });
        let ([a, height], b) = circle(profile)?;
        Some(Surface {
            kind: Kind::Torus,
            point: point + height * axis,
            axis,
            a,
            b,
        })
    };
    lines[..2].iter().filter_map(|&line| about(line)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_is_known_by_its_points_once_its_direction_is() {
        let axis = DVec3::new(1.0, 2.0, 2.0) / 3.0;
        let (u, v) = axis.any_orthonormal_pair();
        let apex = DVec3::new(0.3, -0.2, 0.5);
        let points: Vec<DVec3> = (0..20)
            .map(|i| {
                let (sin, cos) = (0.3 * f64::from(i)).sin_cos();
                let height = 1.0 + 0.1 * f64::from(i % 3);
                apex + height * axis + 0.7 * height * (cos * u + sin * v)
            })
            .collect();
        let found = cone_about(axis, &points).expect("there is a cone");
        assert!((found.b.tan() - 0.7).abs() < 1e-6);
        assert!(points.iter().all(|&x| found.distance(x).abs() < 1e-7));
    }
}
