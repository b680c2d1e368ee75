//! Random streams of a bootstrap's samples.

use super::super::chains::{bootstrap_step, global_chain};
use super::super::tile::TilePlace;
use crate::chain::KeyChain;
use crate::path::{ChainKey, ChainTable};
use crate::sampling::StreamKey;
use crate::table::{Rows, Write};
use bevy_ecs::system::Res;

/// Gives every chain the key of its sample in this round of the bootstrap.
pub fn key_samples(
    place: Res<TilePlace>,
    mut keys: Write<ChainKey, ChainTable>,
    mut key_chains: Write<KeyChain, ChainTable>,
) {
    let (keys, key_chains) = (keys.rows(), key_chains.rows());
    for chain in 0..place.chains as usize {
        let global = global_chain(&place, chain);
        let key = StreamKey::new(place.seed, global, bootstrap_step(place.step));
        keys.put(chain, key.bits());
        key_chains.put(chain, global);
    }
}
