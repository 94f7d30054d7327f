//! Maximum flow, and with it the minimum cut, by Dinic's method (1970).

use std::collections::VecDeque;

/// A network of nodes with capacities between them. Nodes 0 and 1 are the source and the sink.
pub struct Flow {
    /// Arcs from each node.
    arcs_of: Vec<Vec<u32>>,
    /// Where each arc leads. Arc `i ^ 1` is the same arc backwards.
    to: Vec<u32>,
    /// What each arc can still carry.
    left: Vec<u64>,
}

/// Where the flow comes from.
pub const SOURCE: u32 = 0;
/// Where it goes.
pub const SINK: u32 = 1;

/// No way from the source.
const FAR: u32 = u32::MAX;

impl Flow {
    /// A network without arcs, of so many nodes beside source and sink; the first of them is number 2.
    pub fn new(nodes: usize) -> Self {
        Self {
            arcs_of: vec![Vec::new(); nodes + 2],
            to: Vec::new(),
            left: Vec::new(),
        }
    }

    /// Lets `capacity` flow between two nodes, either way.
    pub fn join(&mut self, a: u32, b: u32, capacity: u64) {
        self.arc(a, b, capacity, capacity);
    }

    /// Lets `capacity` flow from the source to a node.
    pub fn from_source(&mut self, node: u32, capacity: u64) {
        self.arc(SOURCE, node, capacity, 0);
    }

    /// Lets `capacity` flow from a node to the sink.
    pub fn to_sink(&mut self, node: u32, capacity: u64) {
        self.arc(node, SINK, capacity, 0);
    }

    fn arc(&mut self, a: u32, b: u32, forth: u64, back: u64) {
        for (from, to, capacity) in [(a, b, forth), (b, a, back)] {
            self.arcs_of[from as usize].push(self.to.len() as u32);
            self.to.push(to);
            self.left.push(capacity);
        }
    }

    /// Sends as much as can flow from source to sink, and gives how much that is. Then
    /// [`Flow::on_source_side`] tells the cut that holds it back.
    ///
    /// Cost: nodes squared times arcs at worst; on bands of a mesh about arcs times the width of the band.
    pub fn run(&mut self) -> u64 {
        let mut whole = 0;
        loop {
            let levels = self.levels();
            if levels[SINK as usize] == FAR {
                return whole;
            }
            let mut next = vec![0; self.arcs_of.len()];
            while let Some(sent) = self.send(&levels, &mut next) {
                whole += sent;
            }
        }
    }

    /// One a node: can more still reach it? Of all minimum cuts this is the one nearest to the source.
    pub fn on_source_side(&self) -> Vec<bool> {
        self.levels().iter().map(|&level| level != FAR).collect()
    }

    /// Steps from the source over arcs that are not full.
    fn levels(&self) -> Vec<u32> {
        let mut levels = vec![FAR; self.arcs_of.len()];
        levels[SOURCE as usize] = 0;
        let mut queue = VecDeque::from([SOURCE]);
        while let Some(node) = queue.pop_front() {
            for &arc in &self.arcs_of[node as usize] {
                let to = self.to[arc as usize] as usize;
                if self.left[arc as usize] > 0 && levels[to] == FAR {
                    levels[to] = levels[node as usize] + 1;
                    queue.push_back(to as u32);
                }
            }
        }
        levels
    }

    /// Sends along one shortest way what it can carry. `next` is the first arc of each node that may still lead
    /// to the sink.
    fn send(&mut self, levels: &[u32], next: &mut [usize]) -> Option<u64> {
        let mut way: Vec<u32> = Vec::new();
        let mut node = SOURCE as usize;
        while node != SINK as usize {
            let Some(&arc) = self.arcs_of[node].get(next[node]) else {
                // A dead end: step back, and never come here again.
                let arc = way.pop()?;
                node = self.to[(arc ^ 1) as usize] as usize;
                next[node] += 1;
                continue;
            };
            let to = self.to[arc as usize] as usize;
            if self.left[arc as usize] > 0 && levels[to] == levels[node] + 1 {
                way.push(arc);
                node = to;
            } else {
                next[node] += 1;
            }
        }
        let sent = way.iter().map(|&arc| self.left[arc as usize]).min()?;
        for arc in way {
            self.left[arc as usize] -= sent;
            self.left[(arc ^ 1) as usize] += sent;
        }
        Some(sent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_chain_carries_what_its_narrowest_link_carries_and_is_cut_there() {
        let mut chain = Flow::new(3);
        chain.from_source(2, 9);
        chain.join(2, 3, 7);
        chain.join(3, 4, 2);
        chain.to_sink(4, 9);
        assert_eq!(chain.run(), 2);
        assert_eq!(chain.on_source_side()[2..], [true, true, false]);
    }

    #[test]
    fn two_ways_carry_the_sum_and_a_bridge_between_them_helps_where_it_must() {
        // The textbook network in which the first shortest ways must be taken back in part.
        let mut bridge = Flow::new(2);
        bridge.from_source(2, 10);
        bridge.from_source(3, 1);
        bridge.join(2, 3, 5);
        bridge.to_sink(2, 3);
        bridge.to_sink(3, 10);
        assert_eq!(bridge.run(), 9);
    }

    #[test]
    fn without_a_way_nothing_flows() {
        let mut apart = Flow::new(2);
        apart.from_source(2, 4);
        apart.to_sink(3, 4);
        assert_eq!(apart.run(), 0);
        assert_eq!(apart.on_source_side()[2..], [true, false]);
    }

    fn cut_cost(arcs: &[(u32, u32, u64)], nodes: u32, on_source_side: impl Fn(u32) -> bool) -> u64 {
        let side = |node: u32| node == SOURCE || (node != SINK && on_source_side(node));
        let sides = arcs
            .iter()
            .map(|&(a, b, capacity)| (side(a), side(b), a, b, capacity));
        let _ = nodes;
        sides
            .filter(|&(from, to, a, b, _)| from != to && (from || (a != SOURCE && b != SINK)))
            .map(|(.., capacity)| capacity)
            .sum()
    }

    proptest! {
        #[test]
        fn the_flow_is_the_cost_of_the_cheapest_of_all_cuts(
            nodes in 1u32..7,
            between in prop::collection::vec((0u32..7, 0u32..7, 1u64..20), 0..15),
            ends in prop::collection::vec((0u32..7, prop::bool::ANY, 1u64..20), 1..8),
        ) {
            let mut arcs = Vec::new();
            let mut flow = Flow::new(nodes as usize);
            for (a, b, capacity) in between {
                let (a, b) = (a % nodes + 2, b % nodes + 2);
                if a != b {
                    flow.join(a, b, capacity);
                    arcs.push((a, b, capacity));
                }
            }
            for (node, source, capacity) in ends {
                let node = node % nodes + 2;
                if source {
                    flow.from_source(node, capacity);
                    arcs.push((SOURCE, node, capacity));
                } else {
                    flow.to_sink(node, capacity);
                    arcs.push((node, SINK, capacity));
                }
            }
            let cheapest = (0u32..1 << nodes)
                .map(|set| cut_cost(&arcs, nodes, |node| set >> (node - 2) & 1 == 1))
                .min();
            let found = flow.run();
            prop_assert_eq!(Some(found), cheapest);
            let sides = flow.on_source_side();
            prop_assert_eq!(found, cut_cost(&arcs, nodes, |node| sides[node as usize]));
        }
    }
}
