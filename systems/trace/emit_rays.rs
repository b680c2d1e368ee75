//! Rays for those who wait.

use super::super::tile::{Queues, TilePlace};
use crate::geometry::{RayDirection, RayOrigin, offset_origin};
use crate::path::{
    ActiveList, ChainTable, Direction, PathLength, ProposalTable, RayChain, RayTable, VertexNormal, VertexOffset,
    VertexPosition,
};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Writes the next ray of every active path: from its last vertex along its direction. Empties the active list.
pub fn emit_rays(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    active: Read<ActiveList, ChainTable>,
    lengths: Read<PathLength, ChainTable>,
    directions: Read<Direction, ChainTable>,
    positions: Read<VertexPosition, ProposalTable>,
    normals: Read<VertexNormal, ProposalTable>,
    offsets: Read<VertexOffset, ProposalTable>,
    mut ray_chains: Write<RayChain, RayTable>,
    mut origins: Write<RayOrigin, RayTable>,
    mut ray_directions: Write<RayDirection, RayTable>,
) {
    let (active, lengths, directions) = (active.rows(), lengths.rows(), directions.rows());
    let (positions, normals, offsets) = (positions.rows(), normals.rows(), offsets.rows());
    let (ray_chains, origins, ray_directions) = (ray_chains.rows(), origins.rows(), ray_directions.rows());
    for ray in 0..queues.active {
        let path = active.at(ray) as usize;
        let direction = directions.at(path);
        let vertex = place.vertex(path, lengths.at(path));
        ray_chains.put(ray, path as u32);
        ray_directions.put(ray, direction);
        origins.put(
            ray,
            offset_origin(positions.at(vertex), normals.at(vertex), offsets.at(vertex), direction),
        );
    }
    queues.rays = queues.active;
    queues.active = 0;
}
