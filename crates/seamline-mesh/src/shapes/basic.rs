//! Box, cylinder, cone, torus, sphere.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, dvec2, dvec3};

use super::profile::{arc, extrude, line, profile, revolve};
use super::{Diagonals, Shape};

/// A box with one corner at the origin; six patches.
pub fn cuboid(size: DVec3) -> Shape {
    let corner = |i: usize| {
        [
            dvec2(0.0, 0.0),
            dvec2(size.x, 0.0),
            dvec2(size.x, size.y),
            dvec2(0.0, size.y),
        ][i % 4]
    };
    let sides = (0..4).map(|i| line(corner(i), corner(i + 1))).collect();
    extrude(&profile(sides, true), size.z, 1, Diagonals::Uniform)
}

/// A cylinder along z, its base at the origin: side, bottom, top.
pub fn cylinder(
    radius: f64,
    height: f64,
    sides: usize,
    rows: usize,
    diagonals: Diagonals,
) -> Shape {
    let circle = arc(DVec2::ZERO, radius, 0.0, TAU, sides);
    extrude(&profile(vec![circle], true), height, rows, diagonals)
}

/// A cone along z, its base about the origin: base, side.
pub fn cone(radius: f64, height: f64, sides: usize) -> Shape {
    let rim = dvec2(radius, 0.0);
    revolve(
        &[line(DVec2::ZERO, rim), line(rim, dvec2(0.0, height))],
        sides,
        Diagonals::None,
    )
}

/// A torus about z: distance from the axis to the tube's centre, radius of the tube, steps round the axis
/// and round the tube. One patch.
pub fn torus(major: f64, minor: f64, sides: usize, rows: usize) -> Shape {
    let tube = arc(dvec2(major, 0.0), minor, 0.0, TAU, rows);
    revolve(&profile(vec![tube], true), sides, Diagonals::Uniform)
}

/// A sphere of radius 1 made of an icosahedron, each triangle split in four `levels` times. One patch.
pub fn icosphere(levels: usize) -> Shape {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut corners = Vec::new();
    for (a, b) in [
        (1.0, golden),
        (-1.0, golden),
        (1.0, -golden),
        (-1.0, -golden),
    ] {
        corners
            .extend([dvec3(a, b, 0.0), dvec3(0.0, a, b), dvec3(b, 0.0, a)].map(DVec3::normalize));
    }
    let side = corners
        .iter()
        .map(|p| p.distance(corners[0]))
        .filter(|&d| d > 0.1)
        .fold(f64::MAX, f64::min);
    let touch = |i: usize, j: usize| (corners[i].distance(corners[j]) - side).abs() < 1e-6;
    let mut triangles = Vec::new();
    for (i, j, k) in
        (0..12).flat_map(|i| (i + 1..12).flat_map(move |j| (j + 1..12).map(move |k| (i, j, k))))
    {
        if touch(i, j) && touch(j, k) && touch(i, k) {
            let [a, b, c] = [corners[i], corners[j], corners[k]];
            triangles.push(if (b - a).cross(c - a).dot(a) > 0.0 {
                [a, b, c]
            } else {
                [a, c, b]
            });
        }
    }
    let middle = |a: DVec3, b: DVec3| (a + b).normalize();
    for _ in 0..levels {
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let mut shape = Shape::default();
    for triangle in triangles {
        shape.push(0, triangle);
    }
    shape
}
