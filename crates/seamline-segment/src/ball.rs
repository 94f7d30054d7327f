//! Curvature over a geodesic ball (paper 4.2.1): the connected part of the surface
//! about a vertex that lies in a sphere, with edges and area clipped at the sphere.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use crate::tensor::{Bending, Gathered};

/// The tensor over the ball of `radius` about `vertex`. Zero if no area lies in it.
pub fn ball_tensor<T: Gathered>(bending: &Bending, vertex: u32, radius: f64) -> T {
    let topology = bending.topology;
    let centre = bending.positions[vertex as usize].0;
    let at = |v: u32| bending.positions[v as usize].0;

    let mut faces: BTreeSet<u32> = topology
        .vertex_faces
        .row(vertex as usize)
        .iter()
        .copied()
        .collect();
    let mut edges = BTreeSet::new();
    let mut open: Vec<u32> = faces.iter().copied().collect();
    let mut sum = T::default();
    let mut area = 0.0;
    while let Some(face) = open.pop() {
        area += clipped_area(topology.triangles[face as usize].map(at), centre, radius);
        for edge in topology.face_edges[face as usize] {
            let [a, b] = topology.edge_vertices[edge as usize].map(at);
            let share = clipped_share(a, b, centre, radius);
            if share == 0.0 {
                continue;
            }
            if edges.insert(edge) {
                sum.add_edge(bending, edge, share);
            }
            if let Some(across) = topology.neighbour(face, edge)
                && faces.insert(across)
            {
                open.push(across);
            }
        }
    }
    sum.over(area)
}

/// The share of the segment from `a` to `b` that lies in the sphere.
fn clipped_share(a: DVec3, b: DVec3, centre: DVec3, radius: f64) -> f64 {
    let (from, along) = (a - centre, b - a);
    let (qa, qb, qc) = (
        along.length_squared(),
        from.dot(along),
        from.length_squared() - radius * radius,
    );
    let discriminant = qb * qb - qa * qc;
    if discriminant <= 0.0 || qa == 0.0 {
        return 0.0;
    }
    let root = discriminant.sqrt();
    let enter = ((-qb - root) / qa).max(0.0);
    let leave = ((-qb + root) / qa).min(1.0);
    (leave - enter).max(0.0)
}

/// The area of the part of a triangle that lies in the sphere: the triangle's plane cuts a disc out of it.
fn clipped_area([a, b, c]: [DVec3; 3], centre: DVec3, radius: f64) -> f64 {
    let Some(normal) = (b - a).cross(c - a).try_normalize() else {
        return 0.0;
    };
    let height = (a - centre).dot(normal);
    let squared = radius * radius - height * height;
    if squared <= 0.0 {
        return 0.0;
    }
    let (x, y) = normal.any_orthonormal_pair();
    let flat = [a, b, c].map(|p| DVec2::new((p - centre).dot(x), (p - centre).dot(y)));
    let sectors = (0..3).map(|i| disc_sector(flat[i], flat[(i + 1) % 3], squared.sqrt()));
    sectors.sum::<f64>().abs()
}

/// Signed area between the origin and the segment from `p` to `q`, within a disc about the origin.
fn disc_sector(p: DVec2, q: DVec2, radius: f64) -> f64 {
    let along = q - p;
    let wedge = |a: DVec2, b: DVec2| radius * radius / 2.0 * a.perp_dot(b).atan2(a.dot(b));
    let (qa, qb, qc) = (
        along.length_squared(),
        p.dot(along),
        p.length_squared() - radius * radius,
    );
    let discriminant = qb * qb - qa * qc;
    if discriminant <= 0.0 || qa == 0.0 {
        return wedge(p, q);
    }
    let root = discriminant.sqrt();
    let (enter, leave) = ((-qb - root) / qa, (-qb + root) / qa);
    if leave <= 0.0 || enter >= 1.0 {
        return wedge(p, q);
    }
    let (inside_from, inside_to) = (p + along * enter.max(0.0), p + along * leave.min(1.0));
    let before = if enter > 0.0 {
        wedge(p, inside_from)
    } else {
        0.0
    };
    let after = if leave < 1.0 {
        wedge(inside_to, q)
    } else {
        0.0
    };
    before + inside_from.perp_dot(inside_to) / 2.0 + after
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const TRIANGLE: [DVec3; 3] = [
        DVec3::new(-9.0, -9.0, 0.0),
        DVec3::new(9.0, -9.0, 0.0),
        DVec3::new(0.0, 9.0, 0.0),
    ];

    #[test]
    fn a_triangle_about_the_ball_gives_the_whole_disc() {
        assert!((clipped_area(TRIANGLE, DVec3::ZERO, 1.0) - PI).abs() < 1e-12);
        let above = DVec3::new(0.0, 0.0, 0.6);
        assert!((clipped_area(TRIANGLE, above, 1.0) - PI * 0.64).abs() < 1e-12);
    }

    #[test]
    fn a_triangle_within_the_ball_gives_its_own_area() {
        assert!((clipped_area(TRIANGLE, DVec3::ZERO, 100.0) - 162.0).abs() < 1e-9);
    }

    #[test]
    fn a_triangle_whose_side_runs_through_the_centre_gives_half_a_disc() {
        let shifted = TRIANGLE.map(|p| p + DVec3::new(0.0, 9.0, 0.0));
        assert!((clipped_area(shifted, DVec3::ZERO, 1.0) - PI / 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_segment_through_the_centre_is_clipped_at_both_ends() {
        let share = clipped_share(
            DVec3::new(-4.0, 0.0, 0.0),
            DVec3::new(4.0, 0.0, 0.0),
            DVec3::ZERO,
            1.0,
        );
        assert!((share - 0.25).abs() < 1e-12);
    }
}
