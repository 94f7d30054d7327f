//! Whole columns of components, lent to kernels as slices.

use std::ops::{Deref, DerefMut};

use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

/// One component of every element of a kind, in mesh order: row `i` belongs to element `i`.
///
/// Empty where the mesh has no such element.
///
/// # Panics
///
/// If the component is spread over several archetypes: each element kind is one archetype, spawned whole
/// and in order, and nothing inserts or removes components later ([`crate::rows`]).
#[derive(SystemParam)]
pub struct Column<'w, 's, T: Component> {
    query: Query<'w, 's, &'static T>,
}

impl<T: Component> Deref for Column<'_, '_, T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        whole(self.query.as_readonly())
    }
}

/// As [`Column`], to be written.
///
/// # Panics
///
/// As [`Column`].
#[derive(SystemParam)]
pub struct ColumnMut<'w, 's, T: Component<Mutability = Mutable>> {
    query: Query<'w, 's, &'static mut T>,
}

impl<T: Component<Mutability = Mutable>> Deref for ColumnMut<'_, '_, T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        whole(self.query.as_readonly())
    }
}

impl<T: Component<Mutability = Mutable>> DerefMut for ColumnMut<'_, '_, T> {
    fn deref_mut(&mut self) -> &mut [T] {
        whole_mut(self.query.reborrow())
    }
}

const IN_TABLES: &str = "components of elements are stored in tables";
const ONE_ARCHETYPE: &str = "one archetype an element kind";

fn whole<'w, T: Component>(query: Query<'w, '_, &T>) -> &'w [T] {
    let mut chunks = query.contiguous_iter_inner().expect(IN_TABLES);
    let column = chunks.next().unwrap_or_default();
    assert!(chunks.next().is_none(), "{ONE_ARCHETYPE}");
    column
}

pub(crate) fn whole_mut<'w, T: Component<Mutability = Mutable>>(
    query: Query<'w, '_, &mut T>,
) -> &'w mut [T] {
    let mut chunks = query.contiguous_iter_inner().expect(IN_TABLES);
    let column = chunks
        .next()
        .map(|chunk| chunk.into_iter().into_slice())
        .unwrap_or_default();
    assert!(chunks.next().is_none(), "{ONE_ARCHETYPE}");
    column
}
