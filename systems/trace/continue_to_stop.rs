//! Subpaths whose ends are known beforehand.

use super::super::tile::{Queues, TilePlace};
use crate::path::whole::{StopDepth, TO_JOINT};
use crate::path::{ActiveList, ChainTable, PathLength, ProposalTable, ScatteredList, VERTEX_DISCRETE, VertexKind};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Lists every scattered subpath as active, but those that end where they are not scattered into a discrete lobe: none plays roulette,
/// since how many vertices it is to have was decided before.
pub fn continue_to_stop(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    scattered: Read<ScatteredList, ChainTable>,
    lengths: Read<PathLength, ChainTable>,
    stops: Read<StopDepth, ChainTable>,
    kinds: Read<VertexKind, ProposalTable>,
    mut active: Write<ActiveList, ChainTable>,
) {
    let (scattered, active) = (scattered.rows(), active.rows());
    let (lengths, stops, kinds) = (lengths.rows(), stops.rows(), kinds.rows());
    let mut going = 0;
    for path in (0..std::mem::take(&mut queues.scattered)).map(|entry| scattered.at(entry)) {
        let number = path as usize;
        let to_joint = stops.at(number) & TO_JOINT != 0;
        if to_joint && kinds.at(place.vertex(number, lengths.at(number))) != VERTEX_DISCRETE {
            continue;
        }
        active.put(going, path);
        going += 1;
    }
    queues.active = going;
}
