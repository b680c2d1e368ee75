//! Layers of samples of pixels.

use super::super::layers::{LayerFilmsRef, LayersRef};
use super::super::tile::TilePlace;
use crate::layer::{LayerColor, ProposedLayerTable};
use crate::path::{BookedWeight, ChainTable, FilmPixel};
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;

/// Adds what layers have of each chain's sample to their films.
pub fn splat_sample_layers(
    films: Res<LayerFilmsRef>,
    layers: Res<LayersRef>,
    place: Res<TilePlace>,
    pixels: Read<FilmPixel, ChainTable>,
    weights: Read<BookedWeight, ChainTable>,
    colors: Read<LayerColor, ProposedLayerTable>,
) {
    let (pixels, weights, colors) = (pixels.rows(), weights.rows(), colors.rows());
    let mut writer = films.films.writer(films.turn(place.step), films.weight);
    for chain in 0..place.chains as usize {
        let scale = weights.at(chain) * films.scale;
        for layer in 0..layers.0.len() {
            let light = colors.at(place.vertex(chain, layer as u32));
            if !light.is_black() {
                writer.put(layer, pixels.at(chain), light * scale);
            }
        }
    }
}
