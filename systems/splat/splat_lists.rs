//! Splats of independent samples that bring light to many pixels.

use super::super::tile::{SplatFilms, TilePlace};
use crate::color::Rgb;
use crate::film::Splat;
use crate::path::{BookedWeight, ChainTable, ProposedSplatCount, ProposedSplatTable, SplatColor, SplatPixel};
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use std::sync::PoisonError;

/// Splats handed to the film at a time: few enough for the stack.
const BATCH: usize = 256;

/// Adds each chain's list to the film of the step: steps take turns among some films, which are independent of each other
/// then, and whose spread is the picture's error.
pub fn splat_lists(
    films: Res<SplatFilms>,
    place: Res<TilePlace>,
    counts: Read<ProposedSplatCount, ChainTable>,
    weights: Read<BookedWeight, ChainTable>,
    pixels: Read<SplatPixel, ProposedSplatTable>,
    colors: Read<SplatColor, ProposedSplatTable>,
) {
    let (counts, weights, pixels, colors) = (counts.rows(), weights.rows(), pixels.rows(), colors.rows());
    let film = &films.films[(place.step % films.films.len() as u64) as usize];
    let mut film = film.lock().unwrap_or_else(PoisonError::into_inner);
    let mut batch = [Splat {
        pixel: 0,
        value: Rgb::BLACK,
    }; BATCH];
    let mut filled = 0;
    for chain in 0..place.chains as usize {
        let scale = weights.at(chain) * films.scale;
        for entry in (0..counts.at(chain)).map(|k| place.vertex(chain, k)) {
            let value = colors.at(entry) * scale;
            if value.is_black() {
                continue;
            }
            batch[filled] = Splat {
                pixel: pixels.at(entry),
                value,
            };
            filled += 1;
            if filled == BATCH {
                film.add(&batch);
                filled = 0;
            }
        }
    }
    film.add(&batch[..filled]);
}
