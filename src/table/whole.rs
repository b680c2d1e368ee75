//! Whole columns as system parameters: a system names a column and its table and gets one plain slice.

use super::Column;
use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::component::Component;
use bevy_ecs::query::With;
use bevy_ecs::system::{Query, SystemParam};

/// Reads the whole column `C` of the table marked `T`.
#[derive(SystemParam)]
pub struct Read<'w, 's, C: Column, T: Component> {
    query: Query<'w, 's, &'static C, With<T>>,
}

impl<C: Column, T: Component> Read<'_, '_, C, T> {
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
pub struct Write<'w, 's, C: Column, T: Component> {
    query: Query<'w, 's, &'static mut C, With<T>>,
}

impl<C: Column, T: Component> Write<'_, '_, C, T> {
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
