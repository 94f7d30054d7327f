//! Profiles, extruded and revolved.

use std::f64::consts::TAU;

use glam::DVec2;

use super::{Diagonals, Shape, push_quad};

/// A piece of a profile: its points share one patch when extruded or revolved.
#[derive(Clone, Debug)]
pub struct ProfilePiece(Vec<DVec2>);

/// A straight piece from `a` to `b`.
pub fn line(a: DVec2, b: DVec2) -> ProfilePiece {
    ProfilePiece(vec![a, b])
}

/// A circular piece about `centre`, from angle `from` to angle `to` (radians), in `steps` chords.
pub fn arc(centre: DVec2, radius: f64, from: f64, to: f64, steps: usize) -> ProfilePiece {
    let at = |i: usize| {
        centre + radius * DVec2::from_angle(from + (to - from) * i as f64 / steps as f64)
    };
    ProfilePiece((0..=steps).map(at).collect())
}

/// Joins pieces end to end, so that neighbours share their end point to the last bit: the start of each
/// piece is taken from the end of the one before. `closed` does the same between the last and the first.
pub fn profile(mut pieces: Vec<ProfilePiece>, closed: bool) -> Vec<ProfilePiece> {
    for i in 1..pieces.len() {
        let end = pieces[i - 1].0[pieces[i - 1].0.len() - 1];
        pieces[i].0[0] = end;
    }
    let start = pieces.first().map(|first| first.0[0]);
    if closed
        && let Some(start) = start
        && let Some(end) = pieces.last_mut().and_then(|last| last.0.last_mut())
    {
        *end = start;
    }
    pieces
}

/// A closed counter-clockwise profile in x, y, extruded along z from 0 to `height` in `rows` rows. One
/// patch a piece, then the bottom, then the top.
pub fn extrude(pieces: &[ProfilePiece], height: f64, rows: usize, diagonals: Diagonals) -> Shape {
    let mut shape = Shape::default();
    let level = |row: usize| height * row as f64 / rows as f64;
    for (patch, piece) in pieces.iter().enumerate() {
        for (column, ends) in piece.0.windows(2).enumerate() {
            for row in 0..rows {
                let (low, high) = (level(row), level(row + 1));
                let quad = [
                    ends[0].extend(low),
                    ends[1].extend(low),
                    ends[1].extend(high),
                    ends[0].extend(high),
                ];
                push_quad(&mut shape, patch as u32, quad, column + row, diagonals);
            }
        }
    }
    let rim: Vec<_> = pieces
        .iter()
        .flat_map(|piece| &piece.0[..piece.0.len() - 1])
        .collect();
    let patch = pieces.len() as u32;
    shape.push(
        patch,
        rim.iter().rev().map(|p| p.extend(0.0)).collect::<Vec<_>>(),
    );
    shape.push(
        patch + 1,
        rim.iter().map(|p| p.extend(height)).collect::<Vec<_>>(),
    );
    shape
}

/// A profile in (distance from the z axis, z), from the axis below up to the axis above or closed in
/// itself, turned about the z axis in `sides` steps. One patch a piece.
pub fn revolve(pieces: &[ProfilePiece], sides: usize, diagonals: Diagonals) -> Shape {
    let mut shape = Shape::default();
    let spoke: Vec<_> = (0..sides)
        .map(|i| DVec2::from_angle(TAU * i as f64 / sides as f64))
        .collect();
    let at = |p: DVec2, side: usize| (spoke[side % sides] * p.x).extend(p.y);
    for (patch, piece) in pieces.iter().enumerate() {
        for (row, ends) in piece.0.windows(2).enumerate() {
            let [below, above] = [ends[0], ends[1]];
            if below.y == above.y && (below.x == 0.0 || above.x == 0.0) {
                let disc = |p: DVec2| (0..sides).map(|side| at(p, side)).collect::<Vec<_>>();
                let rim = if above.x == 0.0 {
                    disc(below)
                } else {
                    disc(above).into_iter().rev().collect()
                };
                shape.push(patch as u32, rim);
                continue;
            }
            for side in 0..sides {
                let [a, b] = [at(below, side), at(below, side + 1)];
                let [d, c] = [at(above, side), at(above, side + 1)];
                if below.x == 0.0 {
                    shape.push(patch as u32, [a, c, d]);
                } else if above.x == 0.0 {
                    shape.push(patch as u32, [a, b, c]);
                } else {
                    push_quad(
                        &mut shape,
                        patch as u32,
                        [a, b, c, d],
                        side + row,
                        diagonals,
                    );
                }
            }
        }
    }
    shape
}
