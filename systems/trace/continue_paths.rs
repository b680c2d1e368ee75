//! Who goes on.

use super::super::tile::{Queues, TilePlace};
use super::draws::Draws;
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Plays Russian roulette for every scattered path, and lists the survivors as active.
pub fn continue_paths(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    scattered: Read<ScatteredList, ChainTable>,
    draws: Draws,
    lengths: Read<PathLength, ChainTable>,
    scales: Read<RadianceScale, ChainTable>,
    mut throughputs: Write<Throughput, ChainTable>,
    mut active: Write<ActiveList, ChainTable>,
    mut ratios: Write<VertexRatio, ProposalTable>,
) {
    let (scattered, lengths, scales) = (scattered.rows(), lengths.rows(), scales.rows());
    let draws = draws.columns(&place);
    let (throughputs, active, ratios) = (throughputs.rows(), active.rows(), ratios.rows());
    let mut survivors = 0;
    for entry in 0..queues.scattered {
        let path = scattered.at(entry) as usize;
        let depth = lengths.at(path);
        let throughput = throughputs.at(path);
        let scale = if scales.is_empty() { 1.0 } else { scales.at(path) };
        let survival = roulette::survival(depth, throughput, scale);
        if survival < 1.0 {
            if draws.roulette(path, depth) >= survival {
                continue;
            }
            let vertex = place.vertex(path, depth);
            ratios.put(vertex, ratios.at(vertex) / survival);
            throughputs.put(path, throughput / survival);
        }
        active.put(survivors, path as u32);
        survivors += 1;
    }
    queues.active = survivors;
    queues.scattered = 0;
}
