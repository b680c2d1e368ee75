//! What rays meet.

use super::super::tile::{Counters, Queues, SceneRef};
use crate::geometry::{HitColumns, HitDistance, HitInstance, HitPrimitive, HitUv, RayColumns, RayDirection, RayOrigin};
use crate::path::RayTable;
use crate::table::{Read, Write};
use bevy_ecs::system::{Res, ResMut};

/// Finds the closest hits of the whole ray queue.
pub fn intersect_rays(
    scene: Res<SceneRef>,
    queues: Res<Queues>,
    mut counters: ResMut<Counters>,
    origins: Read<RayOrigin, RayTable>,
    directions: Read<RayDirection, RayTable>,
    mut distances: Write<HitDistance, RayTable>,
    mut instances: Write<HitInstance, RayTable>,
    mut primitives: Write<HitPrimitive, RayTable>,
    mut uvs: Write<HitUv, RayTable>,
) {
    let rays = RayColumns {
        origin: origins.rows(),
        direction: directions.rows(),
        len: queues.rays,
    };
    let hits = HitColumns {
        distance: distances.rows(),
        instance: instances.rows(),
        primitive: primitives.rows(),
        uv: uvs.rows(),
    };
    scene.0.geometry.closest_hits(rays, hits);
    counters.rays += queues.rays as u64;
}
