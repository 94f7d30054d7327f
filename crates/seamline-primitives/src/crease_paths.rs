//! Creases where vertices are noisy: found where the surface turns, completed to closed borders by cheapest paths. Noise
//! bends the chains that go straight on without it: at .3 % of the mean edge a fine loft has ARI .27 by these alone and .91
//! with both.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use foldhash::{HashMap, HashSet};
use seamline_mesh::Sets;

use crate::creases::Part;

/// Median turn, in degrees, above which the steps of the tessellation are as large as creases, and none are looked
/// for: among coarse meshes smooth handles would be cut to pieces.
const COARSE_DEG: f64 = 2.0;
/// A crease turns by this, and by so many times the median.
const CREASE_DEG: f64 = 10.0;
const CREASE_MEDIANS: f64 = 6.0;
/// From its ends it goes on where it turns by this share of that, within so many degrees of straight on.
const GOES_ON: f64 = 0.5;
const GOES_ON_WITHIN_DEG: f64 = 45.0;
/// Fewer edges than this are no crease.
const FEWEST_EDGES: usize = 6;
/// A path turns by at most this at a vertex, and costs at most this.
const PATH_TURN_DEG: f64 = 60.0;
const MOST_COST: f64 = 300.0;

impl Part<'_> {
    /// Edges of creases.
    pub fn creased_by_turn(&self) -> HashSet<u32> {
        if self.median > COARSE_DEG {
            return HashSet::default();
        }
        let edges = self.edges.iter().map(|&(edge, _)| edge);
        let turns_enough = |edge: &u32| self.turns[edge] >= self.crease_deg();
        let mut creased: HashSet<u32> = edges.filter(turns_enough).collect();
        self.extend(&mut creased);
        self.drop_short(&mut creased);
        self.complete(&mut creased);
        creased
    }

    /// Turn of a crease in degrees.
    fn crease_deg(&self) -> f64 {
        CREASE_DEG.max(CREASE_MEDIANS * self.median)
    }

    fn inner_edges_at(&self, vertex: u32) -> impl Iterator<Item = u32> {
        let edges = self
            .ground
            .topology
            .vertex_edges
            .row(vertex as usize)
            .iter();
        edges.copied().filter(|edge| self.turns.contains_key(edge))
    }

    /// Does a vertex lie on the part's border?
    fn on_border(&self, vertex: u32) -> bool {
        self.inner_edges_at(vertex).count()
            < self.ground.topology.vertex_edges.row(vertex as usize).len()
    }

    /// Degrees between going along `from` towards `vertex` and going on along `to`.
    fn turning(&self, from: u32, vertex: u32, to: u32) -> f64 {
        let at = |v: u32| self.ground.positions[v as usize];
        let before = at(vertex) - at(self.ground.topology.far_end(from, vertex));
        let after = at(self.ground.topology.far_end(to, vertex)) - at(vertex);
        before.angle_between(after).to_degrees()
    }

    /// Ends of creases: vertices of one creased edge that are not on the border.
    fn open_ends(&self, creased: &HashSet<u32>) -> Vec<(u32, u32)> {
        let mut at: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for &edge in creased {
            for vertex in self.ground.topology.edge_vertices[edge as usize] {
                at.entry(vertex).or_default().push(edge);
            }
        }
        at.into_iter()
            .filter(|(vertex, edges)| edges.len() == 1 && !self.on_border(*vertex))
            .map(|(vertex, edges)| (vertex, edges[0]))
            .collect()
    }

    /// Lets creases go on from their ends while the surface still turns.
    fn extend(&self, creased: &mut HashSet<u32>) {
        for (mut vertex, mut edge) in self.open_ends(creased) {
            while let Some(next) = self
                .inner_edges_at(vertex)
                .filter(|next| self.turns[next] >= GOES_ON * self.crease_deg())
                .filter(|&next| self.turning(edge, vertex, next) < GOES_ON_WITHIN_DEG)
                .max_by(|a, b| self.turns[a].total_cmp(&self.turns[b]))
            {
                if !creased.insert(next) {
                    break;
                }
                vertex = self.ground.topology.far_end(next, vertex);
                edge = next;
                let meets = self
                    .inner_edges_at(vertex)
                    .any(|e| e != next && creased.contains(&e));
                if meets || self.on_border(vertex) {
                    break;
                }
            }
        }
    }

    fn drop_short(&self, creased: &mut HashSet<u32>) {
        let edges: Vec<u32> = {
            let mut edges: Vec<u32> = creased.iter().copied().collect();
            edges.sort_unstable();
            edges
        };
        let mut first_at: HashMap<u32, u32> = HashMap::default();
        let mut sets = Sets::new(edges.len());
        for (i, &edge) in edges.iter().enumerate() {
            for vertex in self.ground.topology.edge_vertices[edge as usize] {
                let first = *first_at.entry(vertex).or_insert(i as u32);
                sets.unite(first, i as u32);
            }
        }
        let mut sizes: HashMap<u32, usize> = HashMap::default();
        for i in 0..edges.len() as u32 {
            *sizes.entry(sets.first(i)).or_default() += 1;
        }
        for (i, edge) in edges.iter().enumerate() {
            if sizes[&sets.first(i as u32)] < FEWEST_EDGES {
                creased.remove(edge);
            }
        }
    }

    /// Joins each open end to the border or to another crease by the cheapest path.
    fn complete(&self, creased: &mut HashSet<u32>) {
        let mut connected = Connected::by(self, creased);
        for (vertex, edge) in self.open_ends(creased) {
            if let Some(path) = self.cheapest_path(vertex, edge, creased, &mut connected) {
                for &edge in &path {
                    connected.along(self, edge);
                }
                creased.extend(path);
            }
        }
    }

    fn cheapest_path(
        &self,
        start: u32,
        from: u32,
        creased: &HashSet<u32>,
        connected: &mut Connected,
    ) -> Option<Vec<u32>> {
        let mut goal = |vertex: u32| {
            let meets = || self.inner_edges_at(vertex).any(|e| creased.contains(&e));
            self.on_border(vertex) || (meets() && !connected.are(vertex, start))
        };
        // Costs in thousandths, so that they order; a state is an edge and the vertex it leads to.
        let mut heap = BinaryHeap::from([(Reverse(0u64), from, start)]);
        let mut came: HashMap<(u32, u32), (u64, Option<(u32, u32)>)> =
            HashMap::from_iter([((from, start), (0, None))]);
        while let Some((Reverse(cost), edge, vertex)) = heap.pop() {
            if came[&(edge, vertex)].0 < cost {
                continue;
            }
            if vertex != start && goal(vertex) {
                let mut path = Vec::new();
                let mut at = (edge, vertex);
                while let Some(before) = came[&at].1 {
                    path.push(at.0);
                    at = before;
                }
                return Some(path);
            }
            for next in self.inner_edges_at(vertex).filter(|&e| e != edge) {
                let turning = self.turning(edge, vertex, next);
                if turning > PATH_TURN_DEG {
                    continue;
                }
                let step = (10.0 - 18.0 * self.turns[&next] / self.crease_deg()).max(1.0);
                let total = cost + ((step + 2.0 * turning) * 1000.0) as u64;
                let to = (next, self.ground.topology.far_end(next, vertex));
                if total <= (MOST_COST * 1000.0) as u64
                    && came.get(&to).is_none_or(|&(known, _)| total < known)
                {
                    came.insert(to, (total, Some((edge, vertex))));
                    heap.push((Reverse(total), to.0, to.1));
                }
            }
        }
        None
    }
}

/// Which vertices creases connect.
struct Connected {
    /// Of each vertex of the part.
    rows: HashMap<u32, u32>,
    sets: Sets,
}

impl Connected {
    fn by(part: &Part, creased: &HashSet<u32>) -> Self {
        let mut rows: HashMap<u32, u32> = HashMap::default();
        for &(edge, _) in part.edges {
            for vertex in part.ground.topology.edge_vertices[edge as usize] {
                let next = rows.len() as u32;
                rows.entry(vertex).or_insert(next);
            }
        }
        let mut connected = Self {
            sets: Sets::new(rows.len()),
            rows,
        };
        for &edge in creased {
            connected.along(part, edge);
        }
        connected
    }

    /// Takes an edge for a crease.
    fn along(&mut self, part: &Part, edge: u32) {
        let [a, b] = part.ground.topology.edge_vertices[edge as usize].map(|v| self.rows[&v]);
        self.sets.unite(a, b);
    }

    fn are(&mut self, a: u32, b: u32) -> bool {
        let [a, b] = [a, b].map(|v| self.rows[&v]);
        self.sets.first(a) == self.sets.first(b)
    }
}
