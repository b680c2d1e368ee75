//! Samples of pixels.

use super::super::tile::{FilmRef, TilePlace};
use crate::color::Rgb;
use crate::film::Splat;
use crate::path::{BookedWeight, ChainTable, Contribution, FilmPixel};
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;

/// Splats handed to the film at a time: enough to share its locks, few enough for the stack.
const BATCH: usize = 256;

/// Adds each chain's booked contribution to its pixel as one sample.
pub fn splat_samples(
    film: Res<FilmRef>,
    place: Res<TilePlace>,
    pixels: Read<FilmPixel, ChainTable>,
    contributions: Read<Contribution, ChainTable>,
    weights: Read<BookedWeight, ChainTable>,
) {
    let (pixels, contributions, weights) = (pixels.rows(), contributions.rows(), weights.rows());
    let mut batch = [Splat {
        pixel: 0,
        value: Rgb::BLACK,
    }; BATCH];
    let chains = place.chains as usize;
    for first in (0..chains).step_by(BATCH) {
        let count = BATCH.min(chains - first);
        for (offset, splat) in batch[..count].iter_mut().enumerate() {
            let chain = first + offset;
            *splat = Splat {
                pixel: pixels.at(chain),
                value: contributions.at(chain) * weights.at(chain),
            };
        }
        film.0.add_samples(&batch[..count]);
    }
}
