//! What a bootstrap's samples are worth.

use super::super::tile::{Counters, TilePlace};
use crate::chain::{BootstrapWeight, ForwardDensity, ProposedTarget};
use crate::path::ChainTable;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Writes f(y)/T(y) of every sample. One that is not finite is counted and worth nothing.
pub fn weigh_samples(
    place: Res<TilePlace>,
    mut counters: ResMut<Counters>,
    targets: Read<ProposedTarget, ChainTable>,
    densities: Read<ForwardDensity, ChainTable>,
    mut weights: Write<BootstrapWeight, ChainTable>,
) {
    let (targets, densities, weights) = (targets.rows(), densities.rows(), weights.rows());
    for chain in 0..place.chains as usize {
        let weight = f64::from(targets.at(chain)) * libm::exp(-densities.at(chain));
        if weight.is_finite() && weight >= 0.0 {
            weights.put(chain, weight);
        } else {
            counters.note_non_finite(place.first_chain + chain as u32, place.step);
            weights.put(chain, 0.0);
        }
    }
}
