//! Which vertices are within a tolerance of each other, directly or by a chain.
//!
//! A grid of fine cells, half the tolerance wide: vertices in one fine cell are always together. Eight fine
//! cells make a coarse cell, as wide as the tolerance, so that only the 26 coarse cells around one can hold
//! its neighbours. Pairs of vertices are looked at only between fine cells that are not together yet,
//! nearest cells first, and only vertices that are within the tolerance of the other cell's box. That keeps
//! a tolerance far too large from costing the square of the number of vertices.

use std::collections::HashMap;
use std::ops::Range;

use foldhash::fast::FixedState;
use glam::DVec3;
use rayon::prelude::*;

use crate::sets::Sets;

type Cell = [i64; 3];

/// For every vertex the lowest-numbered one it is together with. `None` if the tolerance is too small to
/// bring any two distinct positions together.
pub(super) fn first_nearby(positions: &[DVec3], tolerance: f64) -> Option<Vec<u32>> {
    let [low, high] = super::bounds(positions)?;
    let extent = (high - low).max_element();
    if tolerance.is_nan() || tolerance <= extent * f64::EPSILON {
        return None;
    }
    if tolerance >= extent * 4.0 {
        return Some(vec![0; positions.len()]);
    }
    let fine_cell = |p: &DVec3| {
        ((*p - low) / (0.5 * tolerance))
            .floor()
            .to_array()
            .map(|c| c as i64)
    };
    let mut cells: Vec<(Cell, Cell, u32)> = positions
        .par_iter()
        .zip(0..positions.len() as u32)
        .map(|(p, vertex)| (coarse(fine_cell(p)), fine_cell(p), vertex))
        .collect();
    cells.par_sort_unstable();

    let mut sets = Sets::new(positions.len());
    let fine: Vec<FineCell> = ranges(&cells, |a, b| a.1 == b.1)
        .into_iter()
        .map(|range| FineCell::new(positions, &cells[range]))
        .collect();
    for cell in &fine {
        cell.members
            .iter()
            .for_each(|&(_, _, vertex)| sets.unite(cell.first(), vertex));
    }
    let coarse: Vec<&[FineCell]> = fine.chunk_by(|a, b| a.coarse() == b.coarse()).collect();
    let at: HashMap<Cell, &[FineCell], FixedState> = coarse
        .iter()
        .map(|&cells| (cells[0].coarse(), cells))
        .collect();

    // Cells that touch are most often together, and then many a pair further apart is too.
    for touching in [true, false] {
        for here in &coarse {
            let [x, y, z] = here[0].coarse();
            for [i, j, k] in half_of_the_neighbours() {
                let there = at.get(&[x + i, y + j, z + k]).copied().unwrap_or_default();
                for (a, b) in here.iter().flat_map(|a| there.iter().map(move |b| (a, b))) {
                    if a.touches(b) == touching
                        && sets.first(a.first()) != sets.first(b.first())
                        && a.reaches(b, positions, tolerance)
                    {
                        sets.unite(a.first(), b.first());
                    }
                }
            }
        }
    }
    Some(
        (0..positions.len() as u32)
            .map(|vertex| sets.first(vertex))
            .collect(),
    )
}

/// Vertices in one fine cell, and the box round them.
struct FineCell<'a> {
    members: &'a [(Cell, Cell, u32)],
    low: DVec3,
    high: DVec3,
}

impl<'a> FineCell<'a> {
    fn new(positions: &[DVec3], members: &'a [(Cell, Cell, u32)]) -> Self {
        let at = members
            .iter()
            .map(|&(_, _, vertex)| positions[vertex as usize]);
        let (low, high) = at.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
            (p.min(low), p.max(high))
        });
        Self { members, low, high }
    }

    fn first(&self) -> u32 {
        self.members[0].2
    }

    fn coarse(&self) -> Cell {
        self.members[0].0
    }

    fn touches(&self, other: &Self) -> bool {
        self.members[0]
            .1
            .iter()
            .zip(other.members[0].1)
            .all(|(a, b)| a.abs_diff(b) <= 1)
    }

    /// Whether a vertex of one is within `tolerance` of a vertex of the other.
    fn reaches(&self, other: &Self, positions: &[DVec3], tolerance: f64) -> bool {
        // A little further, so that rounding keeps nobody out; the distance itself decides.
        let reach = tolerance * (1.0 + 1e-9);
        let near = |from: &Self, to: &Self| -> Vec<DVec3> {
            let at = from
                .members
                .iter()
                .map(|&(_, _, vertex)| positions[vertex as usize]);
            at.filter(|p| p.distance(p.clamp(to.low, to.high)) <= reach)
                .collect()
        };
        let ours = near(self, other);
        if ours.is_empty() {
            return false;
        }
        let theirs = near(other, self);
        ours.iter()
            .any(|p| theirs.iter().any(|q| p.distance(*q) <= tolerance))
    }
}

fn coarse(cell: Cell) -> Cell {
    cell.map(|c| c.div_euclid(2))
}

/// Runs of equal neighbours.
fn ranges<T>(items: &[T], same: impl Fn(&T, &T) -> bool) -> Vec<Range<usize>> {
    let mut start = 0;
    items
        .chunk_by(same)
        .map(|chunk| {
            start += chunk.len();
            start - chunk.len()..start
        })
        .collect()
}

/// The cell itself and one of each pair of opposite neighbours.
fn half_of_the_neighbours() -> impl Iterator<Item = Cell> {
    (0..27)
        .map(|n| [n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1])
        .filter(|cell| *cell >= [0, 0, 0])
}
