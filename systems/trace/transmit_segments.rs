//! What passes along segments.

use super::super::tile::{Counters, Queues, SceneRef, TilePlace};
use crate::geometry::{RayOrigin, SegmentColumns, SegmentTarget, SegmentTransmittance};
use crate::path::{ChainTable, PathLength, ProposalTable, RayChain, RayTable, VertexConnection};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Traces the segments to sampled lights, and takes what is blocked from the vertices' connections.
pub fn transmit_segments(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    mut counters: ResMut<Counters>,
    chains: Read<RayChain, RayTable>,
    origins: Read<RayOrigin, RayTable>,
    targets: Read<SegmentTarget, RayTable>,
    mut transmittances: Write<SegmentTransmittance, RayTable>,
    lengths: Read<PathLength, ChainTable>,
    mut connections: Write<VertexConnection, ProposalTable>,
) {
    let segments = SegmentColumns {
        origin: origins.rows(),
        target: targets.rows(),
        len: queues.segments,
    };
    let transmittances = transmittances.rows();
    scene.0.geometry.transmittances(segments, transmittances);
    let (chains, lengths, connections) = (chains.rows(), lengths.rows(), connections.rows());
    for segment in 0..queues.segments {
        let chain = chains.at(segment) as usize;
        let vertex = place.vertex(chain, lengths.at(chain));
        connections.put(vertex, connections.at(vertex) * transmittances.at(segment));
    }
    counters.segments += queues.segments as u64;
    queues.segments = 0;
}
