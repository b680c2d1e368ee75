//! The loop.

use super::super::TraceLoop;
use super::super::tile::{Depths, Queues, grow_tables};
use bevy_ecs::world::World;

/// Repeats the trace loop's schedule until no chain waits for a ray, and makes room for paths that get deeper than any
/// before.
pub fn trace_loop(world: &mut World) {
    let mut depth = 0;
    while world.resource::<Queues>().active > 0 {
        depth += 1;
        if depth > world.resource::<Depths>().held() {
            grow_tables(world, depth);
        }
        world.run_schedule(TraceLoop);
    }
}
