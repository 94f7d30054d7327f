//! How far vertices were moved off the surface they were put on.
//!
//! Many edges of a CAD mesh lie in a plane or along a ruling: the four corners about such an edge lie in one plane
//! but for the noise. What they are off it, in units of what one vertex moved by one would make of it, has the
//! distribution of the noise itself; about the other edges it is far larger. So the least values are in proportion
//! to their rank, as those of any distribution smooth about zero, and where they cease to be the noise ends.

use glam::DVec3;
use seamline_mesh::Topology;

use crate::Fitted;
use crate::triangles::Triangles;

/// Share of the edges that is looked at first: fewer say little.
const FIRST_SHARE: f64 = 0.12;
/// How much larger the next share is.
const STEP: f64 = 1.15;
/// Share of the edges that is not looked at: if all of them are flat, there is no knee.
const LAST_SHARE: f64 = 0.9;
/// Half as many values are half as large, or more where a bell curve has reached its standard deviation: the
/// logarithm of the ratio of ranks over that of the values there.
const KNEE: f64 = 0.8;
/// The standard deviation over the geometric mean of the values between which the knee is.
const DEVIATION: f64 = 1.1;
/// Standard deviations within which half of a bell curve is.
const HALF_WITHIN: f64 = 0.67;
/// Least cosine between the normals of two faces that may be in one plane but for noise: 45 degrees.
const ONE_PLANE: f64 = 0.7;
/// Height of a triangle, in standard deviations of its vertices, from which its normal says how it lies. At 10 too few
/// pairs are left on narrow fillets, and those are off a plane by design.
const HIGH: f64 = 4.0;
/// Share of the pairs that must be high for the few others to be let alone: without them the knee is not more certain.
const NEARLY_ALL: f64 = 0.9;
/// How often that height is taken from a better estimate.
const ASKED_AGAIN: usize = 3;
/// Fewest pairs of triangles that are asked.
const FEWEST: usize = 50;

/// Evidence from which what vertices are off a surface says how noisy they are.
const SOME_EVIDENCE: u32 = 20;

/// Standard deviation of each coordinate of the vertices, in the unit of `positions`. Too large on a mesh without
/// flat pairs of triangles, where it is how far these are off a plane by design. `None` where no two faces are near
/// one plane without being in it exactly.
///
/// Noise turns a triangle as low as the noise is large any way about, and the pairs that are near one plane all the same
/// are those it has moved little. So only higher ones are asked, once it is known how high that is.
pub(crate) fn standard_deviation(
    positions: &[DVec3],
    topology: &Topology,
    triangles: &Triangles,
) -> Option<f64> {
    let height = |edge: usize| {
        let faces = topology.face_pair(edge)?;
        let [a, b] = faces.map(|face| triangles.heights[face as usize]);
        Some(a.min(b))
    };
    let mut pairs: Vec<(f64, f64)> = (0..topology.edge_faces.len())
        .filter_map(|edge| Some((off_one_plane(positions, topology, edge)?, height(edge)?)))
        .collect();
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut noise = knee(pairs.iter().map(|pair| pair.0).collect())?;
    for _ in 0..ASKED_AGAIN {
        let high = pairs.iter().filter(|pair| pair.1 > HIGH * noise);
        let high: Vec<f64> = high.map(|pair| pair.0).collect();
        if high.len() < FEWEST || high.len() as f64 > NEARLY_ALL * pairs.len() as f64 {
            break;
        }
        noise = knee(high)?;
    }
    Some(noise)
}

/// The standard deviation by values that rise, the least of which are the noise's.
fn knee(away: Vec<f64>) -> Option<f64> {
    let at = |share: f64| away.get((share * away.len() as f64) as usize).copied();
    let mut share = FIRST_SHARE;
    while share < LAST_SHARE {
        let [half, whole] = [at(share / 2.0)?, at(share)?];
        if whole > half && 2f64.ln() / (whole / half).ln() < KNEE {
            return Some(DEVIATION * (half * whole).sqrt());
        }
        share *= STEP;
    }
    Some(at(0.5)? / HALF_WITHIN)
}

/// How far the corners of the two faces of an edge are off one plane, in units of their noise: their volume over the
/// length of its gradient. `None` where they are no such pair, have no volume or no area.
fn off_one_plane(positions: &[DVec3], topology: &Topology, edge: usize) -> Option<f64> {
    let faces = topology.face_pair(edge)?;
    let ends = topology.edge_vertices[edge];
    let opposite = |face: u32| {
        let mut corners = topology.triangles[face as usize].into_iter();
        corners.find(|v| !ends.contains(v))
    };
    let [p, q] = ends.map(|v| positions[v as usize]);
    let a = positions[opposite(faces[0])? as usize];
    let b = positions[opposite(faces[1])? as usize];
    let [left, right] = [(q - p).cross(a - p), (b - p).cross(q - p)];
    if left.dot(right) < ONE_PLANE * left.length() * right.length() {
        return None;
    }
    let gradient = left.length_squared()
        + right.length_squared()
        + (a - q).cross(b - q).length_squared()
        + (a - p).cross(b - p).length_squared();
    let away = left.dot(b - p).abs() / gradient.sqrt();
    (away > 0.0).then_some(away)
}

/// The residual of surfaces of some evidence: their median, each counted by its evidence. `None` if there are none.
pub(crate) fn residual_of_most(surfaces: &[Option<Fitted>]) -> Option<f64> {
    let mut residuals: Vec<(f64, f64)> = surfaces
        .iter()
        .flatten()
        .filter(|fitted| fitted.evidence >= SOME_EVIDENCE)
        .map(|fitted| (fitted.residual, f64::from(fitted.evidence)))
        .collect();
    residuals.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = residuals.iter().map(|r| r.1).sum::<f64>() / 2.0;
    let mut sum = 0.0;
    residuals.into_iter().find_map(|(residual, evidence)| {
        sum += evidence;
        (sum >= half).then_some(residual)
    })
}
