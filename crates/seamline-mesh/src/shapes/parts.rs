//! Small mechanical parts.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3, dvec2};

use super::profile::{arc, extrude, line, profile, revolve};
use super::{Diagonals, Shape};

/// A plate whose outline is a stadium: two flats, two half cylinders, bottom and top. Six patches.
pub fn stadium(length: f64, radius: f64, height: f64, steps: usize) -> Shape {
    let [left, right] = [dvec2(0.0, 0.0), dvec2(length, 0.0)];
    let down = dvec2(0.0, -radius);
    let pieces = vec![
        line(left + down, right + down),
        arc(right, radius, -FRAC_PI_2, FRAC_PI_2, steps),
        line(right - down, left - down),
        arc(left, radius, FRAC_PI_2, 3.0 * FRAC_PI_2, steps),
    ];
    extrude(&profile(pieces, true), height, 1, Diagonals::Alternating)
}

/// A box with some of its four upright edges rounded, by the radius given for each (0: sharp), in
/// `steps` chords: one patch a side and a rounding, then bottom and top.
pub fn rounded_box(size: DVec3, radii: [f64; 4], steps: usize) -> Shape {
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(size.x, 0.0),
        dvec2(size.x, size.y),
        dvec2(0.0, size.y),
    ];
    rounded_prism(&corners, &radii, size.z, steps)
}

/// An L-shaped bracket with a fillet inside and a rounding outside: six flats, two cylinders, bottom and
/// top. Ten patches.
pub fn bracket(steps: usize) -> Shape {
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(2.0, 0.0),
        dvec2(2.0, 0.4),
        dvec2(0.4, 0.4),
        dvec2(0.4, 1.6),
        dvec2(0.0, 1.6),
    ];
    rounded_prism(&corners, &[0.5, 0.0, 0.0, 0.2, 0.0, 0.0], 1.0, steps)
}

/// A stepped shaft with filleted shoulders: two ends, three cylinders, two shoulders and one fillet
/// (a piece of a torus). Eight patches.
pub fn shaft(sides: usize, steps: usize) -> Shape {
    let fillet = 0.15;
    let pieces = vec![
        line(dvec2(0.0, 0.0), dvec2(1.0, 0.0)),
        line(dvec2(1.0, 0.0), dvec2(1.0, 1.0)),
        line(dvec2(1.0, 1.0), dvec2(0.6 + fillet, 1.0)),
        arc(
            dvec2(0.6 + fillet, 1.0 + fillet),
            fillet,
            -FRAC_PI_2,
            -PI,
            steps,
        ),
        line(dvec2(0.6, 1.0 + fillet), dvec2(0.6, 2.0)),
        line(dvec2(0.6, 2.0), dvec2(0.35, 2.0)),
        line(dvec2(0.35, 2.0), dvec2(0.35, 2.8)),
        line(dvec2(0.35, 2.8), dvec2(0.0, 2.8)),
    ];
    revolve(&profile(pieces, false), sides, Diagonals::Uniform)
}

/// A prism over a counter-clockwise polygon, each corner rounded by its radius (0: left sharp).
pub fn rounded_prism(corners: &[DVec2], radii: &[f64], height: f64, steps: usize) -> Shape {
    let count = corners.len();
    let mut rounded = Vec::new();
    for i in 0..count {
        let corner = corners[i];
        let arriving = (corner - corners[(i + count - 1) % count]).normalize();
        let leaving = (corners[(i + 1) % count] - corner).normalize();
        let turn = arriving.angle_to(leaving);
        let cut = radii[i] * (turn / 2.0).tan().abs();
        let bend = (radii[i] > 0.0).then(|| {
            let inward = arriving.perp() * turn.signum();
            let centre = corner - arriving * cut + inward * radii[i];
            let from = (-inward).to_angle();
            arc(centre, radii[i], from, from + turn, steps)
        });
        rounded.push((corner - arriving * cut, bend, corner + leaving * cut));
    }
    let mut pieces = Vec::new();
    for i in 0..count {
        let (_, bend, leave) = &rounded[i];
        pieces.extend(bend.clone());
        pieces.push(line(*leave, rounded[(i + 1) % count].0));
    }
    extrude(&profile(pieces, true), height, 1, Diagonals::Uniform)
}
