//! Neighbourhoods of a flat piece: what a surface is fitted to first.

use crate::few::a_few;
use crate::hypothesis::View;

/// Least cosine between the normals of a neighbourhood and of the piece it surrounds.
const STAR_COS: f64 = 0.7;
const RING_COS: f64 = 0.9;
/// Most pieces in a neighbourhood.
pub(crate) const MOST_IN_RING: usize = 60;
/// Least cosine (18 degrees) between the normals of a disc and of its seed, most pieces in a disc, and by
/// what the next disc is smaller: on dense meshes rings turn too little to tell one surface from another.
const DISC_COS: f64 = 0.95;
const MOST_IN_DISC: usize = 16000;
pub(crate) const DISC_SHRINKS: usize = 4;
/// Most neighbourhoods of three pieces tried for one seed.
const MOST_TRIPLES: usize = 12;
/// Most vertices of a seed that are looked round.
const MOST_STARS: usize = 8;
/// Pieces of a strip on each rung of the ladder of tolerances: the looser, the larger a surface must be to be believed.
const STRIP: [usize; 3] = [8, 8, 24];

/// Pieces whose areas differ by more than this factor are of different sizes: those of a straight wire and of its bend
/// differ by a hundred and more.
const ONE_SIZE: f64 = 10.0;

/// Square of a piece's length over its area from which it is far longer than wide: triangles from rim to rim of a long
/// cylinder have some hundreds. With 20 `cable_cover-fine` of the bench takes a tenth longer, and scores are as before.
const LONG: f64 = 200.0;

/// Marks of pieces or vertices that are forgotten all at once.
#[derive(Default)]
pub(crate) struct Marks {
    of: Vec<u32>,
    now: u32,
}

impl Marks {
    pub fn begin(&mut self, count: usize) {
        self.of.resize(count, 0);
        self.now += 1;
    }

    pub fn holds(&self, item: u32) -> bool {
        self.of[item as usize] == self.now
    }

    /// Marks an item; true if it was not marked yet.
    pub fn mark(&mut self, item: u32) -> bool {
        let was = std::mem::replace(&mut self.of[item as usize], self.now);
        was != self.now
    }
}

/// Walks about pieces that may take part.
pub(crate) struct Around<'a> {
    pub view: View<'a>,
    /// May a piece take part?
    pub open: &'a [bool],
    pub marks: Marks,
}

impl<'a> Around<'a> {
    pub fn new(view: View<'a>, open: &'a [bool]) -> Self {
        Self {
            view,
            open,
            marks: Marks::default(),
        }
    }

    /// Pieces beside a piece that may take part, over links that are no walls.
    pub fn neighbours(&self, piece: u32) -> impl Iterator<Item = u32> {
        let open = self.open;
        self.view
            .pieces
            .smooth_links(piece)
            .map(move |link| link.across(piece))
            .filter(move |&p| open[p as usize])
    }

    /// The seed with two neighbours, and with a neighbour and its neighbour.
    pub fn triples(&self, seed: u32) -> Vec<[u32; 3]> {
        let near: Vec<u32> = self.neighbours(seed).take(6).collect();
        let mut triples = Vec::new();
        for (i, &a) in near.iter().enumerate() {
            triples.extend(near[..i].iter().map(|&b| [seed, a, b]));
        }
        for &a in &near {
            let beyond = self
                .neighbours(a)
                .filter(|p| *p != seed && !near.contains(p));
            triples.extend(beyond.take(3).map(|b| [seed, a, b]));
        }
        triples.truncate(MOST_TRIPLES);
        triples
    }

    /// How many vertices pieces have at most, each of which shares an edge with one before.
    pub fn most_vertices(&self, pieces: &[u32]) -> usize {
        let corners = pieces
            .iter()
            .map(|&p| self.view.pieces.vertices.row(p).len());
        corners.sum::<usize>() - 2 * (pieces.len() - 1)
    }

    /// The seed and what goes on from it with the least turns: along a strip of triangles between two rims, of
    /// which every star holds pieces beyond the rims. Where that leads to pieces of quite another size, as over the rim
    /// of a long cylinder to a finely divided bend, the strip of those of the seed's size, too.
    pub fn strips(&self, seed: u32, rung: usize) -> Vec<Vec<u32>> {
        let alike = |p: u32| self.are_alike(p, seed, ONE_SIZE);
        let any = self.strip(seed, rung, |_| true);
        let own = (self.is_long(seed) && !any.iter().all(|&p| alike(p)))
            .then(|| self.strip(seed, rung, alike));
        [any].into_iter().chain(own).collect()
    }

    /// Do the areas of two pieces differ by no more than a factor?
    pub fn are_alike(&self, one: u32, other: u32, factor: f64) -> bool {
        let [one, other] = [one, other].map(|p| self.view.pieces.areas[p as usize]);
        (1.0 / factor..=factor).contains(&(one / other))
    }

    /// Is a piece far longer than wide?
    fn is_long(&self, piece: u32) -> bool {
        let positions = self.view.ground.positions;
        let vertices = self.view.pieces.vertices.row(piece);
        let squares = |from: u32| {
            let square =
                move |&v: &u32| positions[v as usize].distance_squared(positions[from as usize]);
            vertices.iter().map(move |v| (square(v), *v))
        };
        let farthest = |from: u32| squares(from).max_by(|a, b| a.0.total_cmp(&b.0));
        // From one end to the other, whichever vertex comes first.
        let length = farthest(vertices[0]).and_then(|(_, end)| farthest(end));
        length.is_some_and(|(square, _)| square > LONG * self.view.pieces.areas[piece as usize])
    }

    /// The strip among pieces that may be of it.
    fn strip(&self, seed: u32, rung: usize, may_be: impl Fn(u32) -> bool) -> Vec<u32> {
        let pieces = self.view.pieces;
        let turn = |a: u32, b: u32| {
            let [a, b] = [a, b].map(|p| pieces.normals[p as usize]);
            a.dot(b)
        };
        let mut strip = vec![seed];
        while strip.len() < STRIP[rung] {
            let beyond = strip.iter().flat_map(|&from| {
                self.neighbours(from)
                    .filter(|&p| may_be(p) && !strip.contains(&p))
                    .map(move |to| (turn(from, to), to))
            });
            let Some((_, next)) = beyond.max_by(|a, b| a.0.total_cmp(&b.0)) else {
                break;
            };
            strip.push(next);
        }
        strip
    }

    /// The pieces round each vertex of the seed.
    pub fn stars(&self, seed: u32) -> Vec<Vec<u32>> {
        let pieces = self.view.pieces;
        let vertices = pieces.vertices.row(seed);
        let normal = pieces.normals[seed as usize];
        let mut stars: Vec<Vec<u32>> = a_few(vertices, MOST_STARS)
            .map(|&vertex| {
                let round = pieces.of_vertex.row(vertex).iter().copied();
                round
                    .filter(|&p| {
                        self.open[p as usize] && pieces.normals[p as usize].dot(normal) >= STAR_COS
                    })
                    .take(MOST_IN_RING)
                    .collect()
            })
            .filter(|star: &Vec<u32>| star.len() >= 3)
            .collect();
        stars.sort_unstable();
        stars.dedup();
        stars
    }

    /// The pieces that share a vertex with the seed, and again.
    pub fn rings(&mut self, seed: u32, rings: usize) -> Vec<u32> {
        let pieces = self.view.pieces;
        let normal = pieces.normals[seed as usize];
        self.marks.begin(pieces.count());
        self.marks.mark(seed);
        let mut region = vec![seed];
        let mut from = 0;
        for _ in 0..rings {
            let to = region.len();
            for i in from..to {
                for &vertex in pieces.vertices.row(region[i]) {
                    for &piece in pieces.of_vertex.row(vertex) {
                        if region.len() < MOST_IN_RING
                            && self.open[piece as usize]
                            && pieces.normals[piece as usize].dot(normal) >= RING_COS
                            && self.marks.mark(piece)
                        {
                            region.push(piece);
                        }
                    }
                }
            }
            from = to;
        }
        region
    }

    /// The seed and the pieces about it, nearest first, as far as the surface turns little.
    pub fn disc(&mut self, seed: u32) -> Vec<u32> {
        let pieces = self.view.pieces;
        let normal = pieces.normals[seed as usize];
        self.marks.begin(pieces.count());
        self.marks.mark(seed);
        let mut disc = vec![seed];
        let mut at = 0;
        while at < disc.len() && disc.len() < MOST_IN_DISC {
            for link in pieces.smooth_links(disc[at]) {
                let across = link.across(disc[at]);
                if self.open[across as usize]
                    && pieces.normals[across as usize].dot(normal) >= DISC_COS
                    && self.marks.mark(across)
                {
                    disc.push(across);
                }
            }
            at += 1;
        }
        disc
    }
}
