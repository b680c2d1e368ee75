//! The loop.

use super::super::super::JoinLoop;
use super::super::super::tile::TilePlace;
use bevy_ecs::resource::Resource;
use bevy_ecs::world::World;

/// The strategy that is offered next: (s, t) of the subpaths of a chain.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct JoinCursor {
    /// The chain.
    pub chain: usize,
    /// Vertices of its camera subpath.
    pub t: usize,
    /// Vertices of its light subpath.
    pub s: usize,
}

impl JoinCursor {
    /// The first strategy of a chain.
    #[must_use]
    pub const fn at(chain: usize) -> Self {
        Self { chain, t: 1, s: 0 }
    }
}

/// Repeats the join loop's schedule until every strategy of every chain has been offered.
pub fn join_loop(world: &mut World) {
    world.insert_resource(JoinCursor::at(0));
    while world.resource::<JoinCursor>().chain < world.resource::<TilePlace>().chains as usize {
        world.run_schedule(JoinLoop);
    }
}
