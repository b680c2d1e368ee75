//! Columns: the component types of tables, their accessors, and how a plan names and spawns them.

use super::LaneValue;
use bevy_ecs::change_detection::ContiguousMut;
use bevy_ecs::component::{Component, ComponentId, Mutable};
use bevy_ecs::query::QueryBuilder;
use bevy_ecs::world::{EntityWorldMut, World};
use bytemuck::Pod;

/// A column of a table: a component that holds one lane group of some value.
pub trait Column: Component<Mutability = Mutable> + Pod {
    /// What one chain (or ray) has in this column.
    type Value: LaneValue;
    /// The column's name, as plans print it.
    const NAME: &'static str;
    /// The lane group's storage.
    fn lanes(&self) -> &<Self::Value as LaneValue>::Store;
    /// The lane group's storage, to write to.
    fn lanes_mut(&mut self) -> &mut <Self::Value as LaneValue>::Store;
}

/// Access to a whole column by chain (or ray, or vertex) number; the lane groups do not show.
pub trait Rows<C: Column> {
    /// The value of number `index`.
    fn at(&self, index: usize) -> C::Value;
    /// Sets the value of number `index`.
    fn put(&mut self, index: usize, value: C::Value);
}

impl<C: Column> Rows<C> for [C] {
    #[inline]
    fn at(&self, index: usize) -> C::Value {
        C::Value::load(self[index / super::LANES].lanes(), index)
    }
    #[inline]
    fn put(&mut self, index: usize, value: C::Value) {
        C::Value::store(self[index / super::LANES].lanes_mut(), index, value);
    }
}

/// Shows a function the bytes of a column in a world, in the table whose rows have the given marker.
pub type VisitBytes = fn(&mut World, ComponentId, &mut dyn FnMut(&mut [u8]));

/// One column as a plan lists it.
#[derive(Clone, Copy)]
pub struct ColumnSpec {
    /// The column's name.
    pub name: &'static str,
    /// Bytes per chain (or ray, or vertex).
    pub bytes: usize,
    /// The full type name that the built world reports for this component.
    pub type_name: fn() -> &'static str,
    /// Gives a row this column, zeroed.
    pub insert: for<'a, 'w> fn(&'a mut EntityWorldMut<'w>),
    /// Calls a function with the bytes of the column, in the table whose rows have the given marker.
    pub bytes_of: VisitBytes,
}

impl ColumnSpec {
    /// The specification of column `C`.
    #[must_use]
    pub fn of<C: Column>() -> Self {
        Self {
            name: C::NAME,
            bytes: size_of::<C>() / super::LANES,
            type_name: std::any::type_name::<C>,
            insert: |row| {
                row.insert(C::zeroed());
            },
            bytes_of: |world, marker, visit| {
                let mut column = QueryBuilder::<&mut C>::new(world).with_id(marker).build();
                if let Ok(tables) = column.query_mut(world).contiguous_iter_mut() {
                    for table in tables {
                        visit(bytemuck::cast_slice_mut(
                            ContiguousMut::bypass_change_detection_split(table).0,
                        ));
                    }
                }
            },
        }
    }
}

/// Declares columns: `columns! { /// What it holds. pub Position: Vec3; }`. The crate needs `bevy_ecs` and `bytemuck` (with
/// `derive`) among its dependencies.
#[macro_export]
macro_rules! columns {
    ($($(#[$doc:meta])* pub $name:ident : $value:ty;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, bevy_ecs::component::Component, bytemuck::Pod, bytemuck::Zeroable)]
        #[repr(transparent)]
        pub struct $name(pub <$value as $crate::table::LaneValue>::Store);

        impl $crate::table::Column for $name {
            type Value = $value;
            const NAME: &'static str = stringify!($name);
            #[inline]
            fn lanes(&self) -> &<$value as $crate::table::LaneValue>::Store {
                &self.0
            }
            #[inline]
            fn lanes_mut(&mut self) -> &mut <$value as $crate::table::LaneValue>::Store {
                &mut self.0
            }
        }
    )*};
}
