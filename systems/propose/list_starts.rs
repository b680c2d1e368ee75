//! Subpaths whose start is among the primary coordinates.

use super::super::tile::{Queues, TilePlace};
use crate::path::{ChainTable, DrawList, PathLength, ProposedDepth};
use crate::table::{Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Lists every subpath for the coordinates of its start: the first round of the trace loop draws them, and starts the subpath
/// then.
pub fn list_starts(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    mut lengths: Write<PathLength, ChainTable>,
    mut depths: Write<ProposedDepth, ChainTable>,
    mut list: Write<DrawList, ChainTable>,
) {
    let (lengths, depths, list) = (lengths.rows(), depths.rows(), list.rows());
    queues.draw = 0;
    for chain in 0..place.chains as usize {
        for path in place.subpaths(chain) {
            lengths.put(path, 0);
            depths.put(path, 0);
            list.put(queues.draw, path as u32);
            queues.draw += 1;
        }
    }
    queues.starting = true;
}
