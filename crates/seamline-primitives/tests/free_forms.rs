//! Free forms in closed form.

mod shaken;

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};
use seamline_mesh::Topology;
use seamline_mesh::shapes;
use seamline_primitives::{Found, Kind, find};
use shaken::found_shaken;

/// An egg, its vertices moved along each axis by up to half of `width`.
fn egg(levels: usize, width: f64) -> Found {
    let stretched = |x: DVec3| x * DVec3::new(1.0, 1.1, 1.3 + 0.2 * x.z - 0.1 * x.z * x.z);
    found_shaken(&shapes::icosphere(levels).map(stretched), width)
}

#[test]
fn an_egg_of_no_exact_surface_is_one_smooth_form_and_not_noisy() {
    for levels in [3, 4, 5] {
        let egg = egg(levels, 0.0);
        assert!(egg.smooth, "{levels}");
        assert_eq!((egg.surfaces.len(), egg.noise), (1, 0.0), "{levels}");
        assert!(egg.surfaces[0].is_none(), "{levels}");
    }
}

#[test]
fn an_egg_of_vertices_moved_by_a_tenth_of_an_edge_is_not_smooth() {
    assert!(!egg(4, 0.01).smooth);
}

const WIRE: f64 = 1.5;

/// A wire: straight between two rims of 29 and 38 vertices, then bent and climbing, its 38 vertices a ring closely one
/// after the other, in the single precision of an export and not along any axis. Of each triangle, whether it is of the
/// straight.
fn wire() -> (Vec<DVec3>, Vec<[u32; 3]>, Vec<bool>) {
    let ring = |middle: DVec3, across: DVec3, sides: u32, turn: f64| {
        (0..sides).map(move |i| {
            let (sin, cos) = (turn + TAU * f64::from(i) / f64::from(sides)).sin_cos();
            middle + WIRE * (cos * across + sin * DVec3::Z)
        })
    };
    let (ends, rings) = ([29, 38], 80);
    let mut positions: Vec<DVec3> = ring(DVec3::X * -34.0, DVec3::Y, ends[0], 0.05).collect();
    let (mut middle, step) = (DVec3::ZERO, 0.32);
    for i in 0..rings {
        let along = step * f64::from(i);
        let (sin, cos) = (along / 9.0).sin_cos();
        let across = DVec3::new(-sin, cos, 0.0);
        positions.extend(ring(middle, across, ends[1], 0.0));
        middle += step * DVec3::new(cos, sin, 0.1);
    }
    let mut triangles = Vec::new();
    let [mut i, mut j] = [0, 0];
    while i < ends[0] || j < ends[1] {
        let [a, b] = [i % ends[0], ends[0] + j % ends[1]];
        let next_is_first =
            f64::from(i + 1) * f64::from(ends[1]) <= f64::from(j + 1) * f64::from(ends[0]);
        if next_is_first {
            triangles.push([a, (i + 1) % ends[0], b]);
            i += 1;
        } else {
            triangles.push([a, ends[0] + (j + 1) % ends[1], b]);
            j += 1;
        }
    }
    let straight = triangles.len();
    for k in 0..rings - 1 {
        let at = |i: u32, k: u32| ends[0] + k * ends[1] + i % ends[1];
        for i in 0..ends[1] {
            let [a, b, c, d] = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let cap = |first: u32, sides: u32, flip: bool| {
        (1..sides - 1).map(move |i| {
            let [b, c] = if flip { [i + 1, i] } else { [i, i + 1] };
            [first, first + b, first + c]
        })
    };
    triangles.extend(cap(0, ends[0], true));
    triangles.extend(cap(ends[0] + (rings - 1) * ends[1], ends[1], false));
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    for x in &mut positions {
        *x = (turn * *x).as_vec3().as_dvec3();
    }
    let is_straight = (0..triangles.len()).map(|i| i < straight).collect();
    (positions, triangles, is_straight)
}

/// Its triangles turn less towards the bend, over the rim, than towards each other.
#[test]
fn a_long_cylinder_is_found_beside_a_finely_divided_bend() {
    let (positions, triangles, is_straight) = wire();
    let topology = Topology::build(positions.len(), triangles);
    let found = find(&positions, &topology, 34.0);
    let straight = found.of_face[0] as usize;
    let cylinder = found.surfaces[straight].expect("a surface");
    assert_eq!(cylinder.surface.kind, Kind::Cylinder);
    assert!((cylinder.surface.a - WIRE).abs() < 1e-5);
    for (&patch, is_straight) in found.of_face.iter().zip(is_straight) {
        assert_eq!(patch as usize == straight, is_straight);
    }
}
