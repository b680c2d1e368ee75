//! Splats of chains.

use super::super::tile::{GroupFilmRef, TilePlace};
use crate::chain::Acceptance;
use crate::color::Rgb;
use crate::film::Splat;
use crate::path::{ChainTable, ProposedSplatCount, ProposedSplatTable, SplatColor, SplatCount, SplatPixel, SplatTable};
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use std::sync::PoisonError;

/// Splats handed to the film at a time: few enough for the stack.
const BATCH: usize = 256;

/// Adds both states of every decision to the group's film, each with its expected weight: the proposal's whole splat list
/// with a, the current state's with 1 − a (Veach and Guibas 1997, section 5.1). Runs before accepted lists are taken over.
pub fn splat_states(
    film: Res<GroupFilmRef>,
    place: Res<TilePlace>,
    acceptances: Read<Acceptance, ChainTable>,
    counts: Read<SplatCount, ChainTable>,
    pixels: Read<SplatPixel, SplatTable>,
    colors: Read<SplatColor, SplatTable>,
    proposed_counts: Read<ProposedSplatCount, ChainTable>,
    proposed_pixels: Read<SplatPixel, ProposedSplatTable>,
    proposed_colors: Read<SplatColor, ProposedSplatTable>,
) {
    let acceptances = acceptances.rows();
    let current = (counts.rows(), pixels.rows(), colors.rows());
    let proposed = (proposed_counts.rows(), proposed_pixels.rows(), proposed_colors.rows());
    // One lock for a whole tile: tiles that run at the same time belong to different groups, as a rule.
    let mut film = film.0.lock().unwrap_or_else(PoisonError::into_inner);
    let mut batch = [Splat {
        pixel: 0,
        value: Rgb::BLACK,
    }; BATCH];
    let mut filled = 0;
    let mut put = |pixel: u32, value: Rgb| {
        batch[filled] = Splat { pixel, value };
        filled += 1;
        if filled == BATCH {
            film.add(&batch);
            filled = 0;
        }
    };
    for chain in 0..place.chains as usize {
        let accepted = acceptances.at(chain);
        let kept = (1.0 - accepted) as f32;
        if kept > 0.0 {
            for k in 0..current.0.at(chain) {
                let splat = place.vertex(chain, k);
                put(current.1.at(splat), current.2.at(splat) * kept);
            }
        }
        let accepted = accepted as f32;
        if accepted > 0.0 {
            for k in 0..proposed.0.at(chain) {
                let splat = place.vertex(chain, k);
                put(proposed.1.at(splat), proposed.2.at(splat) * accepted);
            }
        }
    }
    let rest = filled;
    film.add(&batch[..rest]);
}
