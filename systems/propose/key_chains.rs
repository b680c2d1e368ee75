//! A new step for every chain.

use super::super::chains::global_chain;
use super::super::tile::{Counters, Queues, TilePlace};
use crate::chain::KeyChain;
use crate::path::{ChainKey, ChainTable};
use crate::sampling::StreamKey;
use crate::table::{Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Gives every chain the key of this step's random streams, and empties all lists.
pub fn key_chains(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    mut counters: ResMut<Counters>,
    mut keys: Write<ChainKey, ChainTable>,
    mut key_chains: Write<KeyChain, ChainTable>,
) {
    let (keys, key_chains) = (keys.rows(), key_chains.rows());
    for chain in 0..place.chains as usize {
        let global = global_chain(&place, chain);
        keys.put(chain, StreamKey::new(place.seed, global, place.step).bits());
        key_chains.put(chain, global);
    }
    *queues = Queues::default();
    counters.steps += 1;
}
