//! Connections to lights.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::draws::Draws;
use super::scatter::Scatterers;
use crate::geometry::{RayOrigin, SegmentTarget};
use crate::path::{ChainTable, ConnectList, ProposalTable, RayChain, RayTable, VertexConnection};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Samples a light for every listed vertex, and writes the segment to it if the light could arrive.
pub fn connect_lights(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    list: Read<ConnectList, ChainTable>,
    draws: Draws,
    scatterers: Scatterers,
    mut connections: Write<VertexConnection, ProposalTable>,
    mut ray_chains: Write<RayChain, RayTable>,
    mut origins: Write<RayOrigin, RayTable>,
    mut targets: Write<SegmentTarget, RayTable>,
) {
    let scene = &*scene.0;
    let (list, draws, scatterers) = (list.rows(), draws.columns(&place), scatterers.columns());
    let (ray_chains, origins, targets) = (ray_chains.rows(), origins.rows(), targets.rows());
    let connections = connections.rows();
    let mut segments = 0;
    for entry in 0..queues.connect {
        let chain = list.at(entry) as usize;
        let (depth, vertex, scatterer) = scatterers.at(&place, chain);
        let Some(connection) = scatterer.connect(scene, draws.light(chain, depth), place.heuristic) else {
            continue;
        };
        connections.put(vertex, connection.value);
        ray_chains.put(segments, chain as u32);
        origins.put(segments, connection.origin);
        targets.put(segments, connection.target);
        segments += 1;
    }
    queues.segments = segments;
    queues.connect = 0;
}
