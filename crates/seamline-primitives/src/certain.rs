//! Planes beyond doubt: flat pieces no curved surface can be tessellated into.

use glam::DVec3;

/// Do the vertices of a flat piece lie on more than two straight lines?
///
/// A strip of a cylinder or a cone is flat too, but all its vertices lie on its two rulings. Those rulings may
/// carry many vertices, which then wobble sideways, since it was flatness and not straightness that put
/// them there: a line is as wide as .03 of the piece's smaller extent.
pub(crate) fn is_certain_plane(positions: &[DVec3], vertices: &[u32], tolerance: f64) -> bool {
    let at = |i: usize| positions[vertices[i] as usize];
    let count = vertices.len();
    let centre = (0..count).map(at).sum::<DVec3>() / count as f64;
    let farthest_from = |x: DVec3| {
        let far = |&i: &usize| at(i).distance_squared(x);
        (0..count)
            .max_by(|i, j| far(i).total_cmp(&far(j)))
            .unwrap_or(0)
    };
    let first = farthest_from(centre);
    let along = (at(farthest_from(at(first))) - at(first)).normalize_or_zero();
    let across = |i: usize| {
        let x = at(i) - at(first);
        (x - x.dot(along) * along).length()
    };
    let extent = (0..count).map(across).fold(0.0, f64::max);
    let width = (3.0 * tolerance).max(0.03 * extent);

    let covered = |among: &[usize], second: usize| {
        let rest: Vec<usize> = among
            .iter()
            .copied()
            .filter(|&i| !near_line(at(first), at(second), at(i), width))
            .collect();
        on_one_line(&rest, at, width)
    };
    // The first vertex lies on one of the lines, with some other vertex: the rest must then be collinear.
    // A few vertices refute that; only where they do not are all asked.
    let few: Vec<usize> = (0..count).step_by(count.div_ceil(FEW)).collect();
    let all: Vec<usize> = (0..count).collect();
    !few.iter()
        .filter(|&&second| second != first)
        .any(|&second| covered(&few, second) && covered(&all, second))
}

/// How many vertices are tried before all are.
const FEW: usize = 40;

fn near_line(a: DVec3, b: DVec3, x: DVec3, width: f64) -> bool {
    let along = (b - a).normalize_or_zero();
    let x = x - a;
    (x - x.dot(along) * along).length() <= width
}

fn on_one_line(items: &[usize], at: impl Fn(usize) -> DVec3, width: f64) -> bool {
    let Some(&first) = items.first() else {
        return true;
    };
    let far = |from: DVec3| {
        let far = |&&i: &&usize| at(i).distance_squared(from);
        items
            .iter()
            .max_by(|i, j| far(i).total_cmp(&far(j)))
            .copied()
            .unwrap_or(first)
    };
    let a = far(at(first));
    let b = far(at(a));
    items.iter().all(|&i| near_line(at(a), at(b), at(i), width))
}
