//! Which things belong together, by chains of pairs.

/// Sets of numbers, each known by its lowest; whatever the order of the pairs, the sets are the same.
pub struct Sets(Vec<u32>);

impl Sets {
    /// Every number below `count` by itself.
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The lowest number of the set `item` is in.
    pub fn first(&mut self, item: u32) -> u32 {
        let mut at = item;
        while self.0[at as usize] != at {
            let above = self.0[self.0[at as usize] as usize];
            self.0[at as usize] = above;
            at = above;
        }
        at
    }

    /// Makes the sets of `a` and `b` one.
    pub fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// How many sets there are.
    pub fn count(&self) -> usize {
        self.0
            .iter()
            .enumerate()
            .filter(|&(item, &above)| item == above as usize)
            .count()
    }

    /// A number for the set of each item, counted from 0 by lowest member, and how many sets there are.
    pub fn numbered(mut self) -> (Vec<u32>, usize) {
        let mut numbers = vec![0; self.0.len()];
        let mut count = 0;
        for item in 0..self.0.len() as u32 {
            let first = self.first(item);
            if first == item {
                numbers[item as usize] = count;
                count += 1;
            } else {
                numbers[item as usize] = numbers[first as usize];
            }
        }
        (numbers, count as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_numbered_by_lowest_member() {
        let mut sets = Sets::new(6);
        for (a, b) in [(5, 1), (3, 4), (4, 1)] {
            sets.unite(a, b);
        }
        assert_eq!(sets.count(), 3);
        assert_eq!(sets.numbered(), (vec![0, 1, 2, 1, 1, 1], 3));
    }
}
