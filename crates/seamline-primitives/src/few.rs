//! Some of many, where all would tell no more.

/// At most `most` of them, evenly from all over.
pub(crate) fn a_few<T>(all: &[T], most: usize) -> impl Iterator<Item = &T> {
    all.iter().step_by(all.len().div_ceil(most).max(1))
}
