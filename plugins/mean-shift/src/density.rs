//! The density of points on a grid of cells.

/// Cells in a standard deviation. Four let two heaps be told apart at 2.2 deviations instead of 2.
const CELLS_A_BANDWIDTH: f64 = 4.0;

/// The grid is no longer than this on a side; where it would be, cells are larger.
const MOST_CELLS: f64 = 1024.0;

/// Sums of Gaussians round points, at the centres of square cells.
pub struct Density {
    cell: f64,
    columns: usize,
    heights: Vec<f64>,
}

impl Density {
    /// The density of points, none of them negative, each a Gaussian of standard deviation `bandwidth`.
    ///
    /// Cost: linear in the points, and in the cells of the grid.
    pub fn of(points: &[[f64; 2]], bandwidth: f64) -> Self {
        let greatest = |k: usize| points.iter().map(|p| p[k]).fold(0.0, f64::max);
        let [width, height] = [greatest(0), greatest(1)];
        let cell = (bandwidth / CELLS_A_BANDWIDTH).max(width.max(height) / MOST_CELLS);
        let beyond = 4.0 * bandwidth;
        let [columns, rows] = [width, height].map(|length| ((length + beyond) / cell) as usize + 1);
        let mut density = Self {
            cell,
            columns,
            heights: vec![0.0; columns * rows],
        };
        for &point in points {
            let cell = density.cell(point);
            density.heights[cell] += 1.0;
        }
        let deviation = bandwidth / cell;
        density.blur(1, columns, deviation);
        density.blur(columns, rows, deviation);
        density
    }

    /// The cell a point lies in.
    pub fn cell(&self, point: [f64; 2]) -> usize {
        let [column, row] = point.map(|x| (x / self.cell) as usize);
        row * self.columns + column
    }

    /// The summit of each cell: where the steepest way up over the eight cells round each leads. Of equal ways
    /// the one to the lowest cell.
    pub fn summits(&self) -> Vec<usize> {
        let mut up: Vec<usize> = (0..self.heights.len())
            .map(|cell| self.step(cell))
            .collect();
        for cell in 0..up.len() {
            let mut summit = cell;
            while up[summit] != summit {
                summit = up[summit];
            }
            let mut at = cell;
            while up[at] != summit {
                at = std::mem::replace(&mut up[at], summit);
            }
        }
        up
    }

    /// The neighbour that is highest above a cell for its distance; the cell itself on a summit. On level ground
    /// the lower number, so that no way leads in a circle.
    fn step(&self, cell: usize) -> usize {
        let (row, column) = (cell / self.columns, cell % self.columns);
        let rows = self.heights.len() / self.columns;
        let mut best = (0.0, cell);
        for to_row in row.saturating_sub(1)..=(row + 1).min(rows - 1) {
            for to_column in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                let to = to_row * self.columns + to_column;
                let far = if to_row != row && to_column != column {
                    std::f64::consts::SQRT_2
                } else {
                    1.0
                };
                let steep = (self.heights[to] - self.heights[cell]) / far;
                if steep > best.0 || (steep == 0.0 && best.0 == 0.0 && to < best.1) {
                    best = (steep, to);
                }
            }
        }
        best.1
    }

    /// Smooths along one direction: `count` cells, `stride` apart. What would fall below zero is mirrored back, else
    /// the heap of the planes, which lies at zero, would have its summit beside it. At the other end there is
    /// room.
    fn blur(&mut self, stride: usize, count: usize, deviation: f64) {
        let reach = (4.0 * deviation).ceil() as usize;
        let kernel: Vec<f64> = (0..=reach)
            .map(|offset| (-0.5 * (offset as f64 / deviation).powi(2)).exp())
            .collect();
        let mirrored = |at: i64| {
            let round = at.rem_euclid(2 * count as i64);
            round.min(2 * count as i64 - 1 - round) as usize
        };
        let mut line = vec![0.0; count];
        for start in (0..self.heights.len()).filter(|cell| (cell / stride).is_multiple_of(count)) {
            line.fill(0.0);
            for at in 0..count {
                let height = self.heights[start + at * stride];
                if height == 0.0 {
                    continue;
                }
                for offset in -(reach as i64)..=reach as i64 {
                    line[mirrored(at as i64 + offset)] +=
                        height * kernel[offset.unsigned_abs() as usize];
                }
            }
            for (at, &height) in line.iter().enumerate() {
                self.heights[start + at * stride] = height;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn one_point_has_one_summit_and_it_is_where_the_point_is() {
        let density = Density::of(&[[3.0, 2.0]], 0.4);
        let summit = density.cell([3.0, 2.0]);
        assert_eq!(density.summits()[summit], summit);
    }

    #[test]
    fn the_summit_of_points_at_zero_is_at_zero() {
        let points = [[0.0, 0.0], [0.0, 0.0], [2.0, 2.0]];
        let density = Density::of(&points, 0.4);
        assert_eq!(density.summits()[density.cell([0.0, 0.0])], 0);
    }

    proptest! {
        #[test]
        fn every_way_up_ends_on_a_summit_no_lower_than_where_it_began(
            points in prop::collection::vec(prop::array::uniform2(0.0f64..4.0), 1..60),
            bandwidth in 0.05f64..1.0,
        ) {
            let density = Density::of(&points, bandwidth);
            let summits = density.summits();
            for (cell, &summit) in summits.iter().enumerate() {
                prop_assert_eq!(summits[summit], summit);
                prop_assert!(density.heights[summit] >= density.heights[cell]);
            }
        }
    }
}
