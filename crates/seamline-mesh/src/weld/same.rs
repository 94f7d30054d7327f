//! Which vertices have identical coordinates.
//!
//! A hash table of all vertices of a large mesh misses the cache at every look-up. So vertices are dealt
//! out to groups by their hash first; each group's table stays in the cache, and groups run in parallel.

use std::collections::HashMap;
use std::hash::{BuildHasher, Hash, Hasher};
use std::sync::atomic::{AtomicU32, Ordering};

use foldhash::fast::FixedState;
use glam::DVec3;
use rayon::prelude::*;

/// How many vertices a group should have, about.
const GROUP: usize = 1 << 15;

/// For every vertex the lowest-numbered one with the same coordinates.
pub(super) fn first_at_same_place(positions: &[DVec3]) -> Vec<u32> {
    let hasher = FixedState::default();
    let group_count = (positions.len() / GROUP).next_power_of_two().min(1 << 12);
    let group_of = |p: &DVec3| (hasher.hash_one(Key::of(p)) >> 32) as usize & (group_count - 1);

    let firsts: Vec<AtomicU32> = (0..positions.len())
        .into_par_iter()
        .map(|_| AtomicU32::new(0))
        .collect();
    deal(positions, group_count, group_of)
        .into_par_iter()
        .for_each_init(
            || HashMap::with_capacity_and_hasher(GROUP / 4, FixedState::default()),
            |first_at, group| {
                first_at.clear();
                for vertex in group {
                    let first = *first_at
                        .entry(Key::of(&positions[vertex as usize]))
                        .or_insert(vertex);
                    // Each vertex is in one group only, so that nobody else writes here.
                    firsts[vertex as usize].store(first, Ordering::Relaxed);
                }
            },
        );
    firsts.into_iter().map(AtomicU32::into_inner).collect()
}

/// The vertices of each group, in order.
fn deal(
    positions: &[DVec3],
    group_count: usize,
    group_of: impl Fn(&DVec3) -> usize + Sync,
) -> Vec<Vec<u32>> {
    if group_count == 1 {
        return vec![(0..positions.len() as u32).collect()];
    }
    let group_of_vertex: Vec<u16> = positions
        .par_iter()
        .with_min_len(4096)
        .map(|p| group_of(p) as u16)
        .collect();
    let mut groups = vec![Vec::with_capacity(GROUP + GROUP / 2); group_count];
    for (vertex, &group) in group_of_vertex.iter().enumerate() {
        groups[usize::from(group)].push(vertex as u32);
    }
    groups
}

/// Equal for equal coordinates; `-0.0` is `0.0`.
#[derive(PartialEq, Eq)]
struct Key([u64; 3]);

impl Key {
    fn of(p: &DVec3) -> Self {
        Self((*p + DVec3::ZERO).to_array().map(f64::to_bits))
    }
}

impl Hash for Key {
    /// Word by word: as an array it would be hashed as a string of bytes, which takes three times as long.
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.iter().for_each(|&word| state.write_u64(word));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_groups_agree_with_one() {
        let count = 40 * GROUP;
        let positions: Vec<DVec3> = (0..count)
            .map(|i| DVec3::new((i % 1013) as f64, (i % 757) as f64, -0.0 * (i % 2) as f64))
            .collect();
        let period = 1013 * 757;
        let expected = (0..count).map(|i| (i % period) as u32);
        assert!(first_at_same_place(&positions).into_iter().eq(expected));
    }
}
