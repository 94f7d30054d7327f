//! Which vertices have identical coordinates.
//!
//! One hash table of all vertices of a large mesh would miss the cache at every look-up. So vertices are
//! compared within blocks of the file first, where most neighbours meet again. What is left is dealt out to
//! groups by hash, with its coordinates, and compared within groups. Every table stays in the cache, and
//! blocks and groups run in parallel.

use std::collections::HashMap;
use std::hash::{BuildHasher, Hash, Hasher};

use foldhash::fast::FixedState;
use glam::DVec3;
use rayon::prelude::*;

/// How many vertices a block has.
const BLOCK: usize = 1 << 15;

/// How many vertices a group should have, about.
const GROUP: usize = 1 << 13;

type Table = HashMap<Key, u32, FixedState>;

/// For every vertex an earlier one with the same coordinates, or itself if there is none. Following the
/// numbers leads to the first.
pub(super) fn earlier_at_same_place(positions: &[DVec3]) -> Vec<u32> {
    let mut earlier = vec![0; positions.len()];
    let new_in_block: Vec<Vec<u32>> = earlier
        .par_chunks_mut(BLOCK)
        .zip(positions.par_chunks(BLOCK))
        .enumerate()
        .map_init(Table::default, |table, (block, (earlier, positions))| {
            table.clear();
            let mut new = Vec::new();
            for (vertex, (earlier, position)) in
                (block * BLOCK..).zip(earlier.iter_mut().zip(positions))
            {
                *earlier = *table.entry(Key::of(position)).or_insert(vertex as u32);
                if *earlier as usize == vertex {
                    new.push(*earlier);
                }
            }
            new
        })
        .collect();
    if new_in_block.len() > 1 {
        for [vertex, first] in repeats_across_blocks(positions, &new_in_block) {
            earlier[vertex as usize] = first;
        }
    }
    earlier
}

/// Vertices that are new in their block but not in the file, each with the first at its place.
fn repeats_across_blocks(positions: &[DVec3], new_in_block: &[Vec<u32>]) -> Vec<[u32; 2]> {
    let count: usize = new_in_block.iter().map(Vec::len).sum();
    let group_count = (count / GROUP).next_power_of_two().min(1 << 12);
    let hasher = FixedState::default();
    let mut groups: Vec<Vec<(Key, u32)>> = (0..group_count)
        .map(|_| Vec::with_capacity(count / group_count * 9 / 8))
        .collect();
    for &vertex in new_in_block.iter().flatten() {
        let key = Key::of(&positions[vertex as usize]);
        let group = (hasher.hash_one(&key) >> 32) as usize & (group_count - 1);
        groups[group].push((key, vertex));
    }
    let repeats = groups
        .into_par_iter()
        .map_init(Table::default, |table, group| {
            table.clear();
            let with_first = group
                .into_iter()
                .map(|(key, vertex)| [vertex, *table.entry(key).or_insert(vertex)]);
            with_first
                .filter(|[vertex, first]| vertex != first)
                .collect()
        });
    repeats.collect::<Vec<Vec<_>>>().concat()
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
    /// Word by word: as an array it would be hashed as a string of bytes, which takes longer.
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.iter().for_each(|&word| state.write_u64(word));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeats_within_and_across_blocks_lead_to_the_first() {
        let count = 60 * BLOCK;
        let positions: Vec<DVec3> = (0..count)
            .map(|i| {
                DVec3::new(
                    (i / 3 % 1013) as f64,
                    (i / 3 % 757) as f64,
                    -0.0 * (i % 2) as f64,
                )
            })
            .collect();
        let earlier = earlier_at_same_place(&positions);
        for i in 0..count {
            let mut at = i;
            while earlier[at] as usize != at {
                assert!((earlier[at] as usize) < at);
                at = earlier[at] as usize;
            }
            assert_eq!(at, i / 3 % (1013 * 757) * 3);
        }
    }
}
