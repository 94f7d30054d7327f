//! Pieces of a free form between its creases: those too alike, and those too small, are united.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use foldhash::HashSet;
use seamline_mesh::Sets;

use crate::creases::Part;

/// A share of the part's area, and a number of faces, below which a piece of it is no patch.
const LEAST_AREA_SHARE: f64 = 0.02;
const LEAST_FACES: usize = 6;
/// Two pieces whose common border turns by less on average are one; and by less than so many medians.
const BORDER_DEG: f64 = 3.0;
const BORDER_MEDIANS: f64 = 2.0;

/// What sums of lengths round off at most, as a share.
const ROUNDING: f64 = 1e-9;

impl Part<'_> {
    /// Pieces between the creases, those too alike united: each face with its piece, numbered from 0. Borders
    /// `though_smooth` count as turning enough; pieces too small are united over them all the same.
    pub fn flood(&self, creased: &HashSet<u32>, though_smooth: &HashSet<u32>) -> Vec<(u32, u32)> {
        let mut faces: Vec<u32> = self.edges.iter().flat_map(|&(_, faces)| faces).collect();
        faces.sort_unstable();
        faces.dedup();
        let row = |face: u32| faces.binary_search(&face).unwrap_or(0);
        let rows: Vec<[usize; 2]> = self.edges.iter().map(|&(_, pair)| pair.map(row)).collect();
        let mut sets = Sets::new(faces.len());
        for (&(edge, _), &[a, b]) in self.edges.iter().zip(&rows) {
            if !creased.contains(&edge) {
                sets.unite(a as u32, b as u32);
            }
        }
        let (piece_of, count) = sets.numbered();
        let mut pieces = Pieces::of(count, self.least_turn());
        for (&face, &piece) in faces.iter().zip(&piece_of) {
            let size = &mut pieces.sizes[piece as usize];
            size.area += self.ground.triangles.areas[face as usize];
            size.faces += 1;
        }
        for (&(edge, _), rows) in self.edges.iter().zip(&rows) {
            let [a, b] = rows.map(|row| piece_of[row]);
            if a != b {
                let stands = though_smooth.contains(&edge);
                let least = if stands { self.least_turn() } else { 0.0 };
                let length = self.ground.edge_length(edge);
                pieces.lengthen([a, b], [length, length * self.turns[&edge].max(least)]);
            }
        }
        let (united, _) = pieces.united().numbered();
        let pieces = piece_of.iter().map(|&piece| united[piece as usize]);
        faces.iter().copied().zip(pieces).collect()
    }

    /// Mean turn of a border, in degrees, below which the pieces beside it are one.
    pub fn least_turn(&self) -> f64 {
        BORDER_DEG.max(BORDER_MEDIANS * self.median)
    }
}

#[derive(Clone, Copy, Default)]
struct Size {
    area: f64,
    faces: usize,
}

/// Pieces and their common borders.
struct Pieces {
    sizes: Vec<Size>,
    /// The pieces beside each: length of the border, and length by degrees it turns.
    beside: Vec<BTreeMap<u32, [f64; 2]>>,
    least_turn: f64,
}

/// A border in the order they are asked in: by mean turn, then by the pieces it lies between.
type Weakest = Reverse<(u64, [u32; 2])>;

fn weakest([a, b]: [u32; 2], [length, turned]: [f64; 2]) -> Weakest {
    // No turn is negative, and bits of those are in the order of the numbers.
    let mean = (turned / length.max(f64::MIN_POSITIVE)).to_bits();
    Reverse((mean, [a.min(b), a.max(b)]))
}

impl Pieces {
    fn of(count: usize, least_turn: f64) -> Self {
        Self {
            sizes: vec![Size::default(); count],
            beside: vec![BTreeMap::new(); count],
            least_turn,
        }
    }

    fn lengthen(&mut self, [a, b]: [u32; 2], by: [f64; 2]) {
        for (piece, other) in [(a, b), (b, a)] {
            let border = self.beside[piece as usize].entry(other).or_default();
            *border = [border[0] + by[0], border[1] + by[1]];
        }
    }

    /// Unites pieces over borders that turn too little, weakest first.
    fn united(mut self) -> Sets {
        let mut sets = Sets::new(self.sizes.len());
        let whole: f64 = self.sizes.iter().map(|size| size.area).sum();
        let mut heap: BinaryHeap<Weakest> = BinaryHeap::new();
        for (a, beside) in self.beside.iter().enumerate() {
            let after = beside.range(a as u32..);
            heap.extend(after.map(|(&b, &border)| weakest([a as u32, b], border)));
        }
        while let Some(border) = heap.pop() {
            let Reverse((mean, [a, b])) = border;
            let now = self.beside[a as usize].get(&b);
            if now.is_none_or(|&now| weakest([a, b], now) != border) {
                continue;
            }
            let small = |piece: u32| {
                let Size { area, faces } = self.sizes[piece as usize];
                area < LEAST_AREA_SHARE * whole || faces < LEAST_FACES
            };
            let alike = f64::from_bits(mean) < (1.0 - ROUNDING) * self.least_turn;
            if alike || small(a) || small(b) {
                sets.unite(a, b);
                let [more, less] = if self.beside[a as usize].len() >= self.beside[b as usize].len()
                {
                    [a, b]
                } else {
                    [b, a]
                };
                heap.extend(self.absorb(more, less));
            }
        }
        sets
    }

    /// Makes `b` part of `a`, and gives the borders of `a` that are new or longer.
    fn absorb(&mut self, a: u32, b: u32) -> Vec<Weakest> {
        let size = std::mem::take(&mut self.sizes[b as usize]);
        self.sizes[a as usize].area += size.area;
        self.sizes[a as usize].faces += size.faces;
        self.beside[a as usize].remove(&b);
        let mut gone = std::mem::take(&mut self.beside[b as usize]);
        gone.remove(&a);
        let taken = gone.into_iter().map(|(other, border)| {
            self.beside[other as usize].remove(&b);
            self.lengthen([a, other], border);
            weakest([a, other], self.beside[a as usize][&other])
        });
        taken.collect()
    }
}
