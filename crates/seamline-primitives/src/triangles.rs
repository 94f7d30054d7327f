//! The triangles of a mesh in space.

use std::cmp::Reverse;

use glam::DVec3;
use rayon::prelude::*;

/// What a triangle is in space.
pub(crate) struct Triangles {
    pub normals: Vec<DVec3>,
    pub centroids: Vec<DVec3>,
    pub areas: Vec<f64>,
    /// Area doubled over the longest edge.
    pub heights: Vec<f64>,
    /// Their numbers, the largest first.
    pub by_area: Vec<u32>,
}

impl Triangles {
    pub fn of(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let count = triangles.len();
        let mut all = Self {
            normals: Vec::with_capacity(count),
            centroids: Vec::with_capacity(count),
            areas: Vec::with_capacity(count),
            heights: Vec::with_capacity(count),
            by_area: Vec::new(),
        };
        for corners in triangles {
            let [a, b, c] = corners.map(|v| positions[v as usize]);
            let cross = (b - a).cross(c - a);
            let doubled = cross.length();
            let longest = [b - a, c - b, a - c]
                .map(DVec3::length_squared)
                .into_iter()
                .fold(0.0, f64::max)
                .sqrt();
            all.normals.push(cross.normalize_or_zero());
            all.centroids.push((a + b + c) / 3.0);
            all.areas.push(doubled / 2.0);
            let height = if longest > 0.0 {
                doubled / longest
            } else {
                0.0
            };
            all.heights.push(height);
        }
        // No area is negative, and bits of those are in the order of the numbers.
        let sizes = all.areas.iter().map(|area| Reverse(area.to_bits()));
        let mut order: Vec<(Reverse<u64>, u32)> = sizes.zip(0..).collect();
        order.par_sort_unstable();
        all.by_area = order.into_iter().map(|(_, triangle)| triangle).collect();
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_triangle_comes_first_and_of_equals_the_first() {
        let corners = |size: f64| [DVec3::ZERO, size * DVec3::X, size * DVec3::Y];
        let positions: Vec<DVec3> = [1.0, 3.0, 2.0, 3.0].into_iter().flat_map(corners).collect();
        let triangles: Vec<[u32; 3]> = (0..4).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let all = Triangles::of(&positions, &triangles);
        assert_eq!(all.by_area, [1, 3, 2, 0]);
        assert_eq!(all.areas[1], 4.5);
    }
}
