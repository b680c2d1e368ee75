//! The loop.

use super::super::TraceLoop;
use super::super::tile::{Depths, Queues, grow_tables};
use bevy_ecs::world::World;

/// Repeats the trace loop's schedule until no chain waits for a ray, and makes room for paths that get deeper than any
/// before.
pub fn trace_loop(world: &mut World) {
    let mut depth = 0;
    while is_busy(world.resource::<Queues>()) {
        depth += 1;
        // One more: a light subpath's vertex brings an entry to its chain's list, behind that of the chain's own pixel.
        if depth >= world.resource::<Depths>().held() {
            grow_tables(world, depth + 1);
        }
        world.run_schedule(TraceLoop);
        world.resource_mut::<Queues>().starting = false;
    }
}

/// Whether some path waits for a ray, or for the numbers to start with.
fn is_busy(queues: &Queues) -> bool {
    queues.active > 0 || queues.starting
}
