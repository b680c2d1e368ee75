//! What passes along the segments on offer.

use super::super::super::tile::{Counters, Queues, SceneRef};
use crate::geometry::{RayOrigin, SegmentColumns, SegmentTarget, SegmentTransmittance};
use crate::path::RayTable;
use crate::table::{Read, Write};
use bevy_ecs::system::{Res, ResMut};

/// Traces the segments that strategies offer.
pub fn transmit_connections(
    scene: Res<SceneRef>,
    queues: Res<Queues>,
    mut counters: ResMut<Counters>,
    origins: Read<RayOrigin, RayTable>,
    targets: Read<SegmentTarget, RayTable>,
    mut transmittances: Write<SegmentTransmittance, RayTable>,
) {
    let segments = SegmentColumns {
        origin: origins.rows(),
        target: targets.rows(),
        len: queues.segments,
    };
    scene.0.geometry.transmittances(segments, transmittances.rows());
    counters.segments += queues.segments as u64;
}
