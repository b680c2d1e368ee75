//! Connections to lights.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::draws::{DrawColumns, Draws};
use super::scatter::{ScattererColumns, Scatterers};
use crate::geometry::{RayOrigin, SegmentTarget};
use crate::layer::{ConnectionEnd, VertexConnectionEnd};
use crate::path::{ChainTable, ConnectList, ProposalTable, RayChain, RayTable, VertexConnection};
use crate::scene::Scene;
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
    mut ends: Write<VertexConnectionEnd, ProposalTable>,
    mut ray_chains: Write<RayChain, RayTable>,
    mut origins: Write<RayOrigin, RayTable>,
    mut targets: Write<SegmentTarget, RayTable>,
) {
    let run = Run {
        scene: &scene.0,
        place: &place,
        list: list.rows(),
        draws: draws.columns(&place),
        scatterers: scatterers.columns(),
        connections: connections.rows(),
        ends: ends.rows(),
        ray_chains: ray_chains.rows(),
        origins: origins.rows(),
        targets: targets.rows(),
    };
    // Compiled twice: what a scene has none of is not asked about at every vertex.
    queues.segments = if run.scatterers.is_plain() && run.ends.is_empty() {
        run.connect(true, queues.connect)
    } else {
        run.connect(false, queues.connect)
    };
    queues.connect = 0;
}

/// One run of the system: its columns as slices.
struct Run<'a> {
    scene: &'a Scene,
    place: &'a TilePlace,
    list: &'a [ConnectList],
    draws: DrawColumns<'a>,
    scatterers: ScattererColumns<'a>,
    connections: &'a mut [VertexConnection],
    ends: &'a mut [VertexConnectionEnd],
    ray_chains: &'a mut [RayChain],
    origins: &'a mut [RayOrigin],
    targets: &'a mut [SegmentTarget],
}

impl Run<'_> {
    /// Connects the first `count` listed vertices; the number of segments that this gives.
    #[inline(always)]
    fn connect(self, plain: bool, count: usize) -> usize {
        let mut segments = 0;
        for entry in 0..count {
            let chain = self.list.at(entry) as usize;
            let (depth, vertex, scatterer) = self.scatterers.at(plain, self.place, chain);
            let Some(connection) = scatterer.connect(self.scene, self.draws.light(chain, depth), self.place.heuristic)
            else {
                continue;
            };
            self.connections.put(vertex, connection.value);
            if !plain && !self.ends.is_empty() {
                let (side, onward) = (scatterer.normal, connection.target - scatterer.position);
                let end = ConnectionEnd {
                    transmits: (side.dot(scatterer.direction) > 0.0) == (side.dot(onward) > 0.0),
                    end: self.scene.lights.endpoint(connection.light).into(),
                };
                self.ends.put(vertex, end.packed());
            }
            self.ray_chains.put(segments, chain as u32);
            self.origins.put(segments, connection.origin);
            self.targets.put(segments, connection.target);
            segments += 1;
        }
        segments
    }
}
