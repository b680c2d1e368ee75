//! The decision of independent estimators whose samples bring light to many pixels.

use super::super::tile::{Counters, TilePlace};
use crate::color::Rgb;
use crate::path::{BookedWeight, ChainTable, Decisions, ProposedSplatCount, ProposedSplatTable, SplatColor};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Takes every proposal with weight one, as [`accept_always`](super::accept_always) does: a sample with light that is not
/// finite is counted, its chain and step kept for replay, and that light booked as black.
pub fn accept_lists(
    place: Res<TilePlace>,
    mut counters: ResMut<Counters>,
    counts: Read<ProposedSplatCount, ChainTable>,
    mut colors: Write<SplatColor, ProposedSplatTable>,
    mut weights: Write<BookedWeight, ChainTable>,
    mut decisions: Write<Decisions, ChainTable>,
) {
    let (counts, colors) = (counts.rows(), colors.rows());
    let (weights, decisions) = (weights.rows(), decisions.rows());
    for chain in 0..place.chains as usize {
        let mut finite = true;
        for entry in (0..counts.at(chain)).map(|k| place.vertex(chain, k)) {
            if !colors.at(entry).is_finite() {
                colors.put(entry, Rgb::BLACK);
                finite = false;
            }
        }
        if !finite {
            counters.note_non_finite(place.first_chain + chain as u32, place.step);
        }
        weights.put(chain, 1.0);
        decisions.put(chain, decisions.at(chain).wrapping_add(1));
    }
    counters.decisions += u64::from(place.chains);
}
