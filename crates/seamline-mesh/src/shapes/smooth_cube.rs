//! The cube with rounded edges and corners of the paper's Fig. 11 and 14.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};

use super::Shape;

/// A cube of side 1 about the origin whose edges and corners are rounded with `radius`: 6 flats, 12
/// quarter cylinders, 8 octants of a sphere, 26 patches. `flat_steps` rows across a flat, `edge_steps`
/// (even) round an edge.
pub fn smooth_cube(radius: f64, flat_steps: usize, edge_steps: usize) -> Shape {
    let half_flat = 0.5 - radius;
    let half = edge_steps / 2;
    // Along one axis of a cube face: (offset of the core, tangent of the angle), outermost at 45 degrees.
    let mut stations: Vec<(f64, f64)> = Vec::new();
    for i in (1..=half).rev() {
        stations.push((-half_flat, -bend(i, half)));
    }
    for i in 0..=flat_steps {
        stations.push((
            -half_flat + 2.0 * half_flat * i as f64 / flat_steps as f64,
            0.0,
        ));
    }
    for i in 1..=half {
        stations.push((half_flat, bend(i, half)));
    }

    let mut shape = Shape::default();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let at = |i: usize, j: usize| {
                let ((u, tan_u), (v, tan_v)) = (stations[i], stations[j]);
                let core = permuted(dvec3(sign * half_flat, u, v), axis);
                let direction = permuted(dvec3(sign, tan_u, tan_v), axis);
                core + direction * (radius / length_whatever_the_order(direction))
            };
            for i in 0..stations.len() - 1 {
                for j in 0..stations.len() - 1 {
                    let zone = |k: usize| {
                        if k < half {
                            -1
                        } else if k < half + flat_steps {
                            0
                        } else {
                            1
                        }
                    };
                    let cell = permuted(dvec3(sign, f64::from(zone(i)), f64::from(zone(j))), axis);
                    let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    let quad = if sign > 0.0 {
                        quad
                    } else {
                        [quad[3], quad[2], quad[1], quad[0]]
                    };
                    // Towards the cube's corners, so that these have six triangles and not three.
                    let rising = (2 * i + 1 < stations.len()) == (2 * j + 1 < stations.len());
                    shape.push_cut_quad(smooth_cube_patch(cell), quad, rising == (sign > 0.0));
                }
            }
        }
    }
    shape.patches = renumbered(&shape.patches);
    shape
}

fn bend(step: usize, steps: usize) -> f64 {
    if step == steps {
        1.0
    } else {
        (FRAC_PI_2 / 2.0 * step as f64 / steps as f64).tan()
    }
}

fn permuted(p: DVec3, axis: usize) -> DVec3 {
    match axis {
        0 => p,
        1 => dvec3(p.z, p.x, p.y),
        _ => dvec3(p.y, p.z, p.x),
    }
}

fn length_whatever_the_order(p: DVec3) -> f64 {
    let mut squares = [p.x * p.x, p.y * p.y, p.z * p.z];
    squares.sort_by(f64::total_cmp);
    (squares[0] + squares[1] + squares[2]).sqrt()
}

/// A number for each of the 26 outward signs of a rounded cube.
fn smooth_cube_patch(cell: DVec3) -> u32 {
    ((cell.x + 1.0) * 9.0 + (cell.y + 1.0) * 3.0 + cell.z + 1.0) as u32
}

fn renumbered(patches: &[u32]) -> Vec<u32> {
    let mut known: Vec<u32> = patches.to_vec();
    known.sort_unstable();
    known.dedup();
    patches
        .iter()
        .map(|patch| known.partition_point(|k| k < patch) as u32)
        .collect()
}
