//! The decision of independent estimators.

use super::super::tile::{Counters, TilePlace};
use crate::color::Rgb;
use crate::path::{BookedWeight, ChainTable, Contribution, Decisions};
use crate::table::{Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Takes every proposal with weight one. One dense pass over every chain: each decides exactly once a step. A
/// contribution that is not finite is counted, its chain and step kept for replay, and booked as black.
pub fn accept_always(
    place: Res<TilePlace>,
    mut counters: ResMut<Counters>,
    mut contributions: Write<Contribution, ChainTable>,
    mut weights: Write<BookedWeight, ChainTable>,
    mut decisions: Write<Decisions, ChainTable>,
) {
    let (contributions, weights, decisions) = (contributions.rows(), weights.rows(), decisions.rows());
    for chain in 0..place.chains as usize {
        if !contributions.at(chain).is_finite() {
            contributions.put(chain, Rgb::BLACK);
            counters.note_non_finite(place.first_chain + chain as u32, place.step);
        }
        weights.put(chain, 1.0);
        decisions.put(chain, decisions.at(chain).wrapping_add(1));
    }
    counters.decisions += u64::from(place.chains);
}
