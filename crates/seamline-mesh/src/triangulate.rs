//! Polygons to triangles.
//!
//! Every corner of a polygon becomes a corner of some triangle, also one in the middle of a straight side:
//! left out, it would leave a crack to the neighbour that uses it. So a polygon of `n` corners has `n - 2`
//! triangles, unless it visits a vertex twice.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// Triangulates polygons one after the other, and keeps its memory between them.
#[derive(Default)]
pub struct Triangulator {
    earcut: Earcut<f64>,
    ring: Vec<u32>,
    flat: Vec<[f64; 2]>,
    ears: Vec<u32>,
    seen: Vec<bool>,
}

impl Triangulator {
    /// Appends the triangles of one polygon to `triangles`, turned the way the polygon is.
    ///
    /// `corners` are indices into `positions`. Corners that repeat the one before them count once. A
    /// polygon of fewer than three distinct vertices has no triangle; one without area still has a fan of
    /// triangles without area, so that its neighbours stay connected. A quad is split along its shorter
    /// diagonal among those that stay inside; larger polygons go through ear clipping in the plane of their
    /// Newell normal. No triangle repeats a vertex.
    pub fn triangulate(
        &mut self,
        positions: &[DVec3],
        corners: &[u32],
        triangles: &mut Vec<[u32; 3]>,
    ) {
        self.ring.clear();
        self.ring.extend_from_slice(corners);
        self.ring.dedup();
        while self.ring.len() > 1 && self.ring.first() == self.ring.last() {
            self.ring.pop();
        }
        let mut add = |a, b, c| {
            if a != b && b != c && c != a {
                triangles.push([a, b, c]);
            }
        };
        let at = |corner: u32| positions[corner as usize];
        match self.ring[..] {
            [] | [_] | [_, _] => {}
            [a, b, c] => add(a, b, c),
            [a, b, c, d] => {
                if splits_from_first([at(a), at(b), at(c), at(d)]) {
                    add(a, b, c);
                    add(a, c, d);
                } else {
                    add(b, c, d);
                    add(b, d, a);
                }
            }
            _ => {
                self.clip_ears(positions);
                for ear in self.ears.as_chunks().0 {
                    let [a, b, c] = ear.map(|corner| self.ring[corner as usize]);
                    add(a, b, c);
                }
            }
        }
    }

    /// Fills `ears` with triangles of places in `ring`.
    fn clip_ears(&mut self, positions: &[DVec3]) {
        let count = self.ring.len() as u32;
        self.ears.clear();
        if flatten(positions, &self.ring, &mut self.flat) {
            self.earcut.earcut_slice(&self.flat, &[], &mut self.ears);
            self.turn_like_the_ring();
        }
        if self.ears.is_empty() {
            self.ears
                .extend((1..count - 1).flat_map(|corner| [0, corner, corner + 1]));
        } else if self.ears.len() as u32 / 3 < count - 2 {
            self.restore_corners();
        }
    }

    /// Ear clipping gives all triangles the same turn, which need not be that of the ring.
    fn turn_like_the_ring(&mut self) {
        let flat = |corner: u32| DVec2::from_array(self.flat[corner as usize]);
        let twice_area: f64 = self
            .ears
            .as_chunks()
            .0
            .iter()
            .map(|&[a, b, c]| (flat(b) - flat(a)).perp_dot(flat(c) - flat(a)))
            .sum();
        if twice_area < 0.0 {
            self.ears
                .as_chunks_mut::<3>()
                .0
                .iter_mut()
                .for_each(|ear| ear.swap(1, 2));
        }
    }

    /// Ear clipping drops corners that lie on a straight line with their neighbours. Each goes back into
    /// the side it lies on.
    fn restore_corners(&mut self) {
        let count = self.ring.len();
        self.seen.clear();
        self.seen.resize(count, false);
        for &corner in &self.ears {
            self.seen[corner as usize] = true;
        }
        let Some(first) = self.seen.iter().position(|&seen| seen) else {
            return;
        };
        for step in 1..count {
            let corner = (first + step) % count;
            if self.seen[corner] {
                continue;
            }
            let before = ((corner + count - 1) % count) as u32;
            let after = (1..count)
                .map(|k| (corner + k) % count)
                .find(|&k| self.seen[k]);
            let Some(after) = after.map(|k| k as u32) else {
                return;
            };
            self.insert(before, corner as u32, after);
            self.seen[corner] = true;
        }
    }

    /// Puts `corner` between `before` and `after`: into the triangle that has this side, or, if there is
    /// none, as a triangle of its own.
    fn insert(&mut self, before: u32, corner: u32, after: u32) {
        let has_side = |ear: &[u32; 3]| {
            (0..3).find(|&side| ear[side] == before && ear[(side + 1) % 3] == after)
        };
        let ears = self.ears.as_chunks_mut::<3>().0;
        let found = ears
            .iter_mut()
            .find_map(|ear| has_side(ear).map(|side| (ear, side)));
        let new = match found {
            Some((ear, side)) => {
                let apex = ear[(side + 2) % 3];
                *ear = [before, corner, apex];
                [corner, after, apex]
            }
            None => [before, corner, after],
        };
        self.ears.extend(new);
    }
}

/// Whether the diagonal from the first to the third corner of a quad is the one to split it along.
fn splits_from_first([a, b, c, d]: [DVec3; 4]) -> bool {
    let (ac, bd) = (c - a, d - b);
    let size = ac.abs().max(bd.abs()).max_element();
    if size == 0.0 {
        return true;
    }
    let (ac, bd) = (ac / size, bd / size);
    let normal = ac.cross(bd);
    // Twice the areas of the two triangles on either side of each diagonal, seen along the quad's normal.
    let [ab, ad, bc, ba] = [b - a, d - a, c - b, a - b].map(|side| side / size);
    let first = ab.cross(ac).dot(normal).min(ac.cross(ad).dot(normal));
    let second = bc.cross(bd).dot(normal).min(bd.cross(ba).dot(normal));
    let inside = 1e-9 * normal.length_squared();
    match (first > inside, second > inside) {
        // Equal diagonals must not be told apart by rounding.
        (true, true) => ac.length_squared() <= bd.length_squared() * (1.0 + 1e-9),
        (true, false) => true,
        (false, true) => false,
        (false, false) => first >= second,
    }
}

/// The ring in the plane of its Newell normal, about 1 in size and counter-clockwise. `false` if it has no
/// area.
fn flatten(positions: &[DVec3], ring: &[u32], flat: &mut Vec<[f64; 2]>) -> bool {
    let origin = positions[ring[0] as usize];
    let offset = |corner: u32| positions[corner as usize] - origin;
    let size = ring
        .iter()
        .map(|&corner| offset(corner).abs().max_element())
        .fold(0.0, f64::max);
    if size == 0.0 || !size.is_finite() {
        return false;
    }
    let scaled = |corner: u32| offset(corner) / size;
    let next = ring[1..].iter().chain(&ring[..1]);
    let normal: DVec3 = ring
        .iter()
        .zip(next)
        .map(|(&a, &b)| scaled(a).cross(scaled(b)))
        .sum();
    if normal.length() < 1e-14 {
        return false;
    }
    let (u, v) = normal.normalize().any_orthonormal_pair();
    flat.clear();
    flat.extend(
        ring.iter()
            .map(|&corner| [scaled(corner).dot(u), scaled(corner).dot(v)]),
    );
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangles(points: &[[f64; 3]]) -> Vec<[u32; 3]> {
        let positions: Vec<DVec3> = points.iter().map(|&p| p.into()).collect();
        let corners: Vec<u32> = (0..points.len() as u32).collect();
        let mut out = Vec::new();
        Triangulator::default().triangulate(&positions, &corners, &mut out);
        out
    }

    fn flat(points: &[[f64; 2]]) -> Vec<[f64; 3]> {
        points.iter().map(|&[x, y]| [x, y, 0.0]).collect()
    }

    /// Twice the areas along +z.
    fn areas(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<f64> {
        let at = |v: u32| DVec3::from(points[v as usize]);
        triangles
            .iter()
            .map(|&[a, b, c]| (at(b) - at(a)).cross(at(c) - at(a)).z)
            .collect()
    }

    #[test]
    fn a_triangle_is_itself() {
        assert_eq!(
            triangles(&flat(&[[0., 0.], [1., 0.], [0., 1.]])),
            [[0, 1, 2]]
        );
    }

    #[test]
    fn a_convex_quad_is_split_along_its_shorter_diagonal() {
        let kite = flat(&[[0., 0.], [1., -0.5], [4., 0.], [1., 0.5]]);
        assert_eq!(triangles(&kite), [[1, 2, 3], [1, 3, 0]]);
        let square = flat(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]]);
        assert_eq!(triangles(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn a_concave_quad_is_split_inside() {
        for turn in 0..4 {
            let mut dart = flat(&[[0., 0.], [4., 0.], [1., 1.], [0., 4.]]);
            dart.rotate_left(turn);
            let found = triangles(&dart);
            assert!(areas(&dart, &found).iter().all(|&a| a > 0.0), "{found:?}");
        }
    }

    #[test]
    fn a_corner_on_a_straight_side_is_kept() {
        // A quad with three corners in line, and a pentagon and a decagon with several.
        let quad = flat(&[[0., 0.], [1., 0.], [2., 0.], [0., 2.]]);
        assert!(areas(&quad, &triangles(&quad)).iter().all(|&a| a > 0.0));
        let side = flat(&[
            [0., 0.],
            [1., 0.],
            [2., 0.],
            [2., 2.],
            [1., 2.],
            [0., 2.],
            [0., 1.5],
            [0., 1.],
            [0., 0.5],
        ]);
        for turn in 0..side.len() {
            let mut side = side.clone();
            side.rotate_left(turn);
            let found = triangles(&side);
            assert_eq!(found.len(), side.len() - 2);
            assert!(areas(&side, &found).iter().all(|&a| a > 0.0), "{found:?}");
        }
    }

    #[test]
    fn a_polygon_without_area_is_a_fan() {
        let line: Vec<[f64; 3]> = (0..6).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        assert_eq!(triangles(&line).len(), 4);
        assert_eq!(triangles(&[[1.0; 3]; 5]).len(), 3);
    }

    #[test]
    fn repeated_corners_count_once() {
        let positions = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let mut out = Vec::new();
        for corners in [
            &[0, 0, 1, 2, 2][..],
            &[0, 1, 2, 0],
            &[0, 0, 1],
            &[1, 1, 1],
            &[0, 1, 0, 1],
            &[0, 1, 2, 1],
        ] {
            out.clear();
            Triangulator::default().triangulate(&positions, corners, &mut out);
            assert!(out.iter().all(|[a, b, c]| a != b && b != c && c != a));
            let distinct: std::collections::BTreeSet<_> = corners.iter().collect();
            assert_eq!(out.is_empty(), distinct.len() < 3, "{corners:?}: {out:?}");
        }
    }

    #[test]
    fn tiny_and_huge_polygons_are_the_same_to_it() {
        let l = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 3.], [0., 3.]];
        let expected = triangles(&flat(&l));
        for scale in [1e-12, 1e12, 1e-150, 1e150] {
            let scaled: Vec<[f64; 3]> = l
                .iter()
                .map(|&[x, y]| [x * scale, y * scale, 0.0])
                .collect();
            assert_eq!(triangles(&scaled), expected);
        }
    }

    proptest! {
        /// A star about the origin is simple whatever its radii; it may be turned away from the viewer.
        #[test]
        fn a_star_is_covered_once(radii in prop::collection::vec(0.1f64..1.0, 5..40), turned in any::<bool>()) {
            let n = radii.len();
            let mut star: Vec<[f64; 3]> = radii.iter().enumerate().map(|(i, r)| {
                let angle = std::f64::consts::TAU * i as f64 / n as f64;
                [r * angle.cos(), r * angle.sin(), 0.0]
            }).collect();
            if turned { star.reverse(); }
            let sign = if turned { -1.0 } else { 1.0 };
            let at = |i: usize| DVec3::from(star[i % n]);
            let whole: f64 = (0..n).map(|i| at(i).cross(at(i + 1)).z).sum();
            let found = triangles(&star);
            prop_assert_eq!(found.len(), n - 2);
            let parts = areas(&star, &found);
            prop_assert!(parts.iter().all(|a| a * sign > -1e-12));
            prop_assert!((parts.iter().sum::<f64>() - whole).abs() < 1e-9);
        }
    }
}
