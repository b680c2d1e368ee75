//! One pixel per chain.

use super::super::tile::{Counters, Queues, TilePlace};
use crate::color::Rgb;
use crate::path::{ChainKey, ChainTable, Contribution, FilmPixel};
use crate::sampling::StreamKey;
use crate::table::{Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Gives every chain its pixel (chain number = pixel number) and the key of this step's random streams.
pub fn assign_pixels(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    mut counters: ResMut<Counters>,
    mut keys: Write<ChainKey, ChainTable>,
    mut pixels: Write<FilmPixel, ChainTable>,
    mut contributions: Write<Contribution, ChainTable>,
) {
    let (keys, pixels, contributions) = (keys.rows(), pixels.rows(), contributions.rows());
    for chain in 0..place.chains as usize {
        let global = place.first_chain + chain as u32;
        keys.put(chain, StreamKey::new(place.seed, global, place.step).bits());
        if !pixels.is_empty() {
            pixels.put(chain, global);
        }
        if !contributions.is_empty() {
            contributions.put(chain, Rgb::BLACK);
        }
    }
    *queues = Queues::default();
    counters.steps += 1;
}
