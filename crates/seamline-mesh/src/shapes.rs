//! Solids whose surfaces are known in closed form, with the patch each face belongs to.
//!
//! For tests, benchmarks and the project's own sample parts. All are closed, oriented outward, and made of
//! faces that share no vertices until welded: equal corners are equal to the last bit.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3, dvec2, dvec3};

use crate::{Format, PolygonMesh};

/// A surface made of polygons, each with the number of its patch.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    faces: Vec<Vec<DVec3>>,
    /// The patch of each face, in face order.
    pub patches: Vec<u32>,
}

impl Shape {
    fn push(&mut self, patch: u32, corners: impl Into<Vec<DVec3>>) {
        self.faces.push(corners.into());
        self.patches.push(patch);
    }

    /// A quad `[a, b, c, d]`, cut along `a c` or along `b d`.
    fn push_cut_quad(&mut self, patch: u32, [a, b, c, d]: [DVec3; 4], along_ac: bool) {
        let halves = if along_ac {
            [[a, b, c], [a, c, d]]
        } else {
            [[a, b, d], [b, c, d]]
        };
        for half in halves {
            self.push(patch, half);
        }
    }

    /// The faces with every corner moved.
    pub fn map(&self, moved: impl Fn(DVec3) -> DVec3) -> Self {
        let faces = self
            .faces
            .iter()
            .map(|face| face.iter().map(|&p| moved(p)).collect())
            .collect();
        Self {
            faces,
            patches: self.patches.clone(),
        }
    }

    /// The faces turned inside out.
    pub fn reversed(&self) -> Self {
        let faces = self
            .faces
            .iter()
            .map(|face| face.iter().rev().copied().collect())
            .collect();
        Self {
            faces,
            patches: self.patches.clone(),
        }
    }

    /// The faces in another order: face `i` is the `order[i]`-th of this shape.
    pub fn reordered(&self, order: &[usize]) -> Self {
        Self {
            faces: order.iter().map(|&i| self.faces[i].clone()).collect(),
            patches: order.iter().map(|&i| self.patches[i]).collect(),
        }
    }

    /// Both shapes side by side; the patches of `other` are numbered on.
    pub fn and(mut self, other: &Self) -> Self {
        let first = self.patch_count() as u32;
        self.faces.extend_from_slice(&other.faces);
        self.patches
            .extend(other.patches.iter().map(|patch| first + patch));
        self
    }

    /// How many patches it was made of.
    pub fn patch_count(&self) -> usize {
        self.patches
            .iter()
            .max()
            .map_or(0, |&last| last as usize + 1)
    }

    /// How many faces.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The faces as a file would hold them: no vertex shared.
    pub fn polygons(&self) -> PolygonMesh {
        let mut starts = vec![0u32];
        for face in &self.faces {
            starts.push(starts[starts.len() - 1] + face.len() as u32);
        }
        let positions = self.faces.concat();
        let corners = (0..positions.len() as u32).collect();
        PolygonMesh {
            format: Format::Memory,
            positions,
            starts,
            corners,
        }
    }
}

/// How the quads of a strip are cut into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diagonals {
    /// Not at all: the faces stay quads.
    None,
    /// All in the same direction.
    Uniform,
    /// In turn.
    Alternating,
}

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

fn push_quad(shape: &mut Shape, patch: u32, quad: [DVec3; 4], turn: usize, diagonals: Diagonals) {
    match diagonals {
        Diagonals::None => shape.push(patch, quad),
        Diagonals::Uniform => shape.push_cut_quad(patch, quad, true),
        Diagonals::Alternating => shape.push_cut_quad(patch, quad, turn.is_multiple_of(2)),
    }
}

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
