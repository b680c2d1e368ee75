//! Subpaths whose ends are known beforehand.

use super::super::tile::Queues;
use crate::path::{ActiveList, ChainTable, ScatteredList};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::ResMut;

/// Lists every scattered subpath as active: none plays roulette, since how many vertices it is to have was decided before.
pub fn continue_to_stop(
    mut queues: ResMut<Queues>,
    scattered: Read<ScatteredList, ChainTable>,
    mut active: Write<ActiveList, ChainTable>,
) {
    let (scattered, active) = (scattered.rows(), active.rows());
    for entry in 0..queues.scattered {
        active.put(entry, scattered.at(entry));
    }
    queues.active = std::mem::take(&mut queues.scattered);
}
