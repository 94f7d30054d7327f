//! Hypotheses: a surface, the pieces that lie on it, and how far they prove it.

use std::f64::consts::PI;

use foldhash::HashSet;
use glam::DVec3;

use crate::few::a_few;
use crate::ground::Ground;
use crate::guess::{Facets, guesses};
use crate::pieces::Pieces;
use crate::refine::refine_patiently;
use crate::surface::{Kind, Surface};

/// A surface with the connected pieces that lie on it.
#[derive(Clone, Debug)]
pub(crate) struct Hypothesis {
    pub surface: Surface,
    /// Does the distance grow towards the outside (1) or the inside (-1) of the part?
    pub sign: f64,
    pub pieces: Vec<u32>,
    /// Greatest distance at which a vertex was taken to lie on it.
    pub tolerance: f64,
    /// Distinct vertices less degrees of freedom.
    pub evidence: i64,
    /// Root mean square distance of its vertices.
    pub rms: f64,
    /// Do its vertices lie on it as exactly as they are stored? A free form comes near many surfaces, and
    /// grows until the tolerance ends it; hardly one leaves its vertices at the precision of their numbers.
    pub exact: bool,
    /// Is it over-determined across rows, so that chance cannot explain the fit?
    pub strong: bool,
}

/// The mesh as the search sees it.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    pub ground: Ground<'a>,
    pub pieces: &'a Pieces,
}

impl View<'_> {
    /// Do all vertices of a piece lie on the surface, and does its normal agree at its faces' centroids?
    pub fn fits(&self, piece: u32, surface: &Surface, sign: f64, tolerance: f64) -> bool {
        self.fits_turned(piece, surface, sign, tolerance, NORMALS_AGREE)
    }

    pub fn fits_turned(
        &self,
        piece: u32,
        surface: &Surface,
        sign: f64,
        tolerance: f64,
        least_cos: f64,
    ) -> bool {
        let lies =
            |&v: &u32| surface.distance(self.ground.positions[v as usize]).abs() <= tolerance;
        self.faces_as(piece, surface, sign, least_cos)
            && self.pieces.vertices.row(piece).iter().all(lies)
    }

    /// Does the normal of a piece agree with the surface's at its faces' centroids?
    pub fn faces_as(&self, piece: u32, surface: &Surface, sign: f64, least_cos: f64) -> bool {
        let normal = self.pieces.normals[piece as usize];
        let lean = self.pieces.leans[piece as usize];
        let least_cos = if lean > 0.0 {
            (least_cos.acos() + lean).min(PI).cos()
        } else {
            least_cos
        };
        let agrees = |x: DVec3| sign * surface.gradient(x).dot(normal) >= least_cos;
        let faces = self.pieces.faces.row(piece);
        let agree = if faces.len() <= 2 {
            agrees(self.pieces.centroids[piece as usize])
        } else {
            // The centroid of a piece bent like a ring lies far from it.
            let mut centroids = faces
                .iter()
                .map(|&f| self.ground.triangles.centroids[f as usize]);
            centroids.all(agrees)
        };
        normal == DVec3::ZERO || agree
    }

    /// Greatest distance of pieces' faces, at their centroids, from the surface their vertices lie on.
    pub fn sagitta(&self, surface: &Surface, pieces: &[u32]) -> f64 {
        let faces = pieces.iter().flat_map(|&p| self.pieces.faces.row(p));
        faces
            .map(|&f| {
                surface
                    .distance(self.ground.triangles.centroids[f as usize])
                    .abs()
            })
            .fold(0.0, f64::max)
    }

    /// The plane of a piece's centroid and normal.
    pub fn plane_of(&self, piece: u32) -> Surface {
        Surface {
            kind: Kind::Plane,
            point: self.pieces.centroids[piece as usize],
            axis: self.pieces.normals[piece as usize],
            a: 0.0,
            b: 0.0,
        }
    }

    /// Do the vertices of a piece lie in the plane of its centroid and normal?
    pub fn is_flat(&self, piece: u32, tolerance: f64) -> bool {
        let normal = self.pieces.normals[piece as usize];
        let centroid = self.pieces.centroids[piece as usize];
        let vertices = self.pieces.vertices.row(piece).iter();
        vertices
            .map(|&v| {
                (self.ground.positions[v as usize] - centroid)
                    .dot(normal)
                    .abs()
            })
            .all(|away| away <= tolerance)
    }

    /// Distinct vertices of pieces, in order.
    pub fn vertices_of(&self, pieces: &[u32]) -> Vec<u32> {
        let rows = pieces.iter().map(|&p| self.pieces.vertices.row(p));
        if pieces.len() * SCARCE < self.ground.positions.len() {
            // Most pieces are triangles.
            let mut vertices = Vec::with_capacity(3 * pieces.len());
            rows.for_each(|row| vertices.extend_from_slice(row));
            vertices.sort_unstable();
            vertices.dedup();
            return vertices;
        }
        let mut among = vec![false; self.ground.positions.len()];
        for &vertex in rows.flatten() {
            among[vertex as usize] = true;
        }
        let numbered = among.into_iter().zip(0..);
        numbered.filter_map(|(is, v)| is.then_some(v)).collect()
    }

    /// Positions of distinct vertices of pieces, `most` at most, from all over them.
    pub fn some_points(&self, pieces: &[u32], most: usize) -> Vec<DVec3> {
        let few: Vec<u32> = a_few(pieces, most).copied().collect();
        a_few(&self.vertices_of(&few), most)
            .map(|&v| self.ground.positions[v as usize])
            .collect()
    }

    /// Normals and centroids of pieces.
    pub fn facets(&self, pieces: &[u32]) -> Facets {
        let pick =
            |of: &[DVec3]| -> Vec<DVec3> { pieces.iter().map(|&p| of[p as usize]).collect() };
        Facets {
            normals: pick(&self.pieces.normals),
            centroids: pick(&self.pieces.centroids),
        }
    }

    /// The mean normals and centroids of each two pieces that are linked: triangles to and fro between two rims lean
    /// one way and the other, two together neither way.
    pub fn linked_facets(&self, pieces: &[u32]) -> Facets {
        let among: HashSet<u32> = pieces.iter().copied().collect();
        let links = pieces.iter().flat_map(|&p| {
            let links = self.pieces.smooth_links(p).map(|link| link.pieces);
            links.filter(move |pair| pair[0] == p)
        });
        let pairs: Vec<[u32; 2]> = links.filter(|pair| among.contains(&pair[1])).collect();
        let mean =
            |of: &[DVec3], pair: &[u32; 2]| (of[pair[0] as usize] + of[pair[1] as usize]) / 2.0;
        Facets {
            normals: pairs
                .iter()
                .map(|pair| mean(&self.pieces.normals, pair).normalize_or_zero())
                .collect(),
            centroids: pairs
                .iter()
                .map(|pair| mean(&self.pieces.centroids, pair))
                .collect(),
        }
    }

    pub fn area(&self, pieces: &[u32]) -> f64 {
        pieces.iter().map(|&p| self.pieces.areas[p as usize]).sum()
    }

    /// Weighs pieces that lie on a surface.
    pub fn weigh(
        &self,
        surface: Surface,
        sign: f64,
        pieces: Vec<u32>,
        tolerance: f64,
    ) -> Hypothesis {
        let vertices = self.vertices_of(&pieces);
        let evidence = vertices.len() as i64 - surface.kind.degrees_of_freedom() as i64;
        let points: Vec<DVec3> = vertices
            .iter()
            .map(|&v| self.ground.positions[v as usize])
            .collect();
        let apart = 4.0 * tolerance;
        let few: Vec<DVec3> = a_few(&points, MOST_LEVELLED).copied().collect();
        let strong = is_strong(&surface, &few, apart)
            && match surface.kind {
                Kind::Plane | Kind::Cylinder | Kind::Cone => true,
                Kind::Sphere | Kind::Torus => !self.lie_on_a_cone(&pieces, &points, tolerance),
            };
        let rms = surface.rms(&points);
        Hypothesis {
            rms,
            exact: rms <= self.ground.precision,
            strong,
            surface,
            sign,
            pieces,
            tolerance,
            evidence,
        }
    }

    /// Do the vertices of a sphere's or a torus' pieces lie on a cone as well? Those of one strip of revolution do.
    fn lie_on_a_cone(&self, pieces: &[u32], points: &[DVec3], tolerance: f64) -> bool {
        let some: Vec<u32> = a_few(pieces, MOST_ON_A_CONE).copied().collect();
        let facets = self.facets(&some);
        let few: Vec<DVec3> = a_few(points, MOST_ON_A_CONE).copied().collect();
        guesses(Kind::Cone, &facets.between(&few))
            .into_iter()
            .filter_map(|guess| refine_patiently(guess, &few, tolerance))
            .any(|fit| fit.rms <= tolerance)
    }
}

/// Vertices for each piece above which sorting a few is less work than going over all.
const SCARCE: usize = 64;
/// Most pieces and points that a cone is fitted to, to see whether there is one.
const MOST_ON_A_CONE: usize = 100;
/// Most points that levels are counted of.
const MOST_LEVELLED: usize = 2000;

/// Least cosine between a piece's normal and the surface's at its centroid.
pub(crate) const NORMALS_AGREE: f64 = 0.85;

/// Is the fit over-determined across rows? Vertices along one ruling or one circle of revolution count once:
/// any strip of any surface of revolution is an exact cone, and any two strips an exact torus.
fn is_strong(surface: &Surface, points: &[DVec3], apart: f64) -> bool {
    match surface.kind {
        Kind::Plane => true,
        Kind::Sphere => points.len() >= 8 && fills_space(points, apart),
        Kind::Cylinder => {
            let (u, v) = surface.axis.any_orthonormal_pair();
            let angle = |x: DVec3| (x - surface.point).dot(v).atan2((x - surface.point).dot(u));
            row_count(points.iter().map(|&x| angle(x) * surface.a), apart, 0.0) >= 4
        }
        Kind::Cone => {
            row_count(
                points.iter().map(|&x| surface.about_axis(x).height),
                apart,
                LEVEL_SHARE,
            ) >= 3
        }
        Kind::Torus => {
            let angle = |x: DVec3| {
                let at = surface.about_axis(x);
                at.height.atan2(at.distance - surface.a)
            };
            row_count(
                points.iter().map(|&x| angle(x) * surface.b),
                apart,
                LEVEL_SHARE,
            ) >= 4
        }
    }
}

/// How many of the levels are rows: those of the fewest vertices are not, as long as these are few.
fn row_count(values: impl Iterator<Item = f64>, apart: f64, share: f64) -> usize {
    let mut on_each = levels(values, apart, share);
    on_each.sort_unstable();
    let mut strays = (STRAYS * on_each.iter().sum::<usize>() as f64) as usize;
    let is_stray = |&on: &usize| match strays.checked_sub(on) {
        Some(rest) => {
            strays = rest;
            true
        }
        None => false,
    };
    on_each.into_iter().skip_while(is_stray).count()
}

/// Values that differ by more than `apart`, and by more than a share of the range, and how many there are of each: the
/// axis of a narrow ring may tilt about the sphere it lies on, and then one circle seems to have many heights.
fn levels(values: impl Iterator<Item = f64>, apart: f64, share: f64) -> Vec<usize> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_unstable_by(f64::total_cmp);
    let range = values.last().unwrap_or(&0.0) - values.first().unwrap_or(&0.0);
    let apart = apart.max(share * range);
    let mut on_each = Vec::new();
    let mut rest = &values[..];
    while let Some(first) = rest.first() {
        let on = rest.partition_point(|value| value - first <= apart);
        on_each.push(on);
        rest = &rest[on..];
    }
    on_each
}

/// Share of the vertices that may be off rows, of fewer than 50 none: the seam of a surface of revolution is divided
/// more finely than its rows are apart, and the row of one vertex would make a torus of three rings, through which
/// there always is one, a proved one. With none of them vases and bulbs come out in bands (ARI .003 less over 132
/// meshes); at .05 and .1 narrow true fillets are lost.
const STRAYS: f64 = 0.02;
/// Share of the range of heights that two levels are apart at least.
const LEVEL_SHARE: f64 = 0.05;

/// Four levels at least along each principal axis?
fn fills_space(points: &[DVec3], apart: f64) -> bool {
    let centre = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut m = [[0.0; 3]; 3];
    for x in points {
        let x = (*x - centre).to_array();
        for i in 0..3 {
            for j in 0..3 {
                m[i][j] += x[i] * x[j];
            }
        }
    }
    let (_, axes) = crate::eigen::symmetric(m);
    axes.into_iter().all(|axis| {
        let axis = DVec3::from_array(axis);
        levels(
            points.iter().map(|&x| (x - centre).dot(axis)),
            apart,
            LEVEL_SHARE,
        )
        .len()
            >= 4
    })
}
