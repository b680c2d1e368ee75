//! The loop.

use super::super::TraceLoop;
use super::super::tile::Queues;
use bevy_ecs::world::World;

/// Repeats the trace loop's schedule until no chain waits for a ray.
pub fn trace_loop(world: &mut World) {
    while world.resource::<Queues>().active > 0 {
        world.run_schedule(TraceLoop);
    }
}
