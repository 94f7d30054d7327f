//! Rows of numbers of different lengths, one after the other.

/// Row `i` holds the values given for `i`, in the order of the pairs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    starts: Vec<u32>,
    values: Vec<u32>,
}

impl Rows {
    /// From pairs of row and value.
    pub fn of_pairs(row_count: usize, pairs: &[(u32, u32)]) -> Self {
        let mut starts = vec![0u32; row_count + 1];
        for &(row, _) in pairs {
            starts[row as usize + 1] += 1;
        }
        for row in 0..row_count {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut values = vec![0; pairs.len()];
        for &(row, value) in pairs {
            values[next[row as usize] as usize] = value;
            next[row as usize] += 1;
        }
        Self { starts, values }
    }

    /// One more row.
    pub fn push(&mut self, row: impl Iterator<Item = u32>) {
        if self.starts.is_empty() {
            self.starts.push(0);
        }
        self.values.extend(row);
        self.starts.push(self.values.len() as u32);
    }

    /// Row `i` of these holds the rows of those that hold `i`, rising, `row_count` in all.
    pub fn turned(&self, row_count: usize) -> Self {
        let rows = (0..).zip(self.starts.windows(2));
        let pairs = rows.flat_map(|(row, ends)| {
            let values = &self.values[ends[0] as usize..ends[1] as usize];
            values.iter().map(move |&value| (value, row))
        });
        Self::of_pairs(row_count, &pairs.collect::<Vec<_>>())
    }

    /// One row.
    #[inline]
    pub fn row(&self, row: u32) -> &[u32] {
        &self.values[self.starts[row as usize] as usize..self.starts[row as usize + 1] as usize]
    }
}
