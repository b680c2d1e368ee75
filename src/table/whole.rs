//! Whole columns as system parameters: a system names a column and its table and gets one plain slice.

use super::Column;
use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::component::Component;
use bevy_ecs::query::{ArchetypeFilter, With};
use bevy_ecs::system::{Query, SystemParam};

/// A table: the marker of its rows.
pub trait Table: Component + Default {
    /// The tables that have some of the same columns, such as that of proposals beside that of current states, as
    /// [`Without`](bevy_ecs::query::Without) their markers; `()` if there is none, and on one side of each pair. A system may read a
    /// column of one and write that of the other.
    type Apart: ArchetypeFilter;
}

/// Reads the whole column `C` of the table marked `T`.
#[derive(SystemParam)]
pub struct Read<'w, 's, C: Column, T: Table> {
    query: Query<'w, 's, &'static C, (With<T>, <T as Table>::Apart)>,
}

impl<C: Column, T: Table> Read<'_, '_, C, T> {
    /// The column as one slice of lane groups; empty if the plan left the column out.
    #[inline]
    #[must_use]
    pub fn rows(&self) -> &[C] {
        self.query
            .contiguous_iter()
            .ok()
            .and_then(|mut tables| tables.next())
            .unwrap_or(&[])
    }
}

/// Writes the whole column `C` of the table marked `T`. Change detection is bypassed: nothing here watches ticks.
#[derive(SystemParam)]
pub struct Write<'w, 's, C: Column, T: Table> {
    query: Query<'w, 's, &'static mut C, (With<T>, <T as Table>::Apart)>,
}

impl<C: Column, T: Table> Write<'_, '_, C, T> {
    /// The column as one mutable slice of lane groups; empty if the plan left the column out.
    #[inline]
    #[must_use]
    pub fn rows(&mut self) -> &mut [C] {
        let table = self
            .query
            .contiguous_iter_mut()
            .ok()
            .and_then(|mut tables| tables.next());
        table.map_or(&mut [], |column| ContiguousMut::bypass_change_detection_split(column).0)
    }
}
