//! Targets of proposals that bring light to many pixels.

use super::super::layers::LayersRef;
use super::super::tile::{FilmBlocks, TilePlace};
use super::evaluate_targets::normalized;
use crate::chain::{ProposedClass, ProposedTarget, StateClass};
use crate::layer::{LayerColor, ProposedLayerTable, SplatLayer};
use crate::path::{ChainTable, ProposedSplatCount, ProposedSplatTable, SplatColor, SplatPixel, target_of};
use crate::table::{Rows, Write};
use bevy_ecs::system::Res;

/// Writes the target of every proposal, the sum over its list, divides the list and its layers by it, and leaves out what is black. The
/// state's block is that of its brightest entry.
pub fn evaluate_lists(
    place: Res<TilePlace>,
    blocks: Res<FilmBlocks>,
    mut targets: Write<ProposedTarget, ChainTable>,
    mut classes: Write<ProposedClass, ChainTable>,
    mut counts: Write<ProposedSplatCount, ChainTable>,
    mut pixels: Write<SplatPixel, ProposedSplatTable>,
    mut colors: Write<SplatColor, ProposedSplatTable>,
    layers: Option<Res<LayersRef>>,
    mut splat_layers: Write<SplatLayer, ProposedSplatTable>,
    mut layer_colors: Write<LayerColor, ProposedLayerTable>,
) {
    let (targets, classes, counts) = (targets.rows(), classes.rows(), counts.rows());
    let (pixels, colors) = (pixels.rows(), colors.rows());
    let (splat_layers, layer_colors) = (splat_layers.rows(), layer_colors.rows());
    let layer_count = layers.map_or(0, |layers| layers.0.len() as u32);
    for chain in 0..place.chains as usize {
        let (mut target, mut most, mut pixel) = (0.0, 0.0, 0);
        let listed = counts.at(chain);
        for entry in (0..listed).map(|k| place.vertex(chain, k)) {
            let light = target_of(colors.at(entry));
            target += light;
            if light > most {
                (most, pixel) = (light, pixels.at(entry));
            }
        }
        targets.put(chain, target);
        let block = blocks.0.block_of(pixel).unwrap_or(0) as u32;
        classes.put(chain, StateClass(classes.at(chain)).in_block(block).0);
        let mut kept = 0;
        if target > 0.0 && target.is_finite() {
            for entry in (0..listed).map(|k| place.vertex(chain, k)) {
                let light = colors.at(entry);
                if !light.is_black() {
                    let to = place.vertex(chain, kept);
                    pixels.put(to, pixels.at(entry));
                    colors.put(to, normalized(light, target));
                    if !splat_layers.is_empty() {
                        splat_layers.put(to, splat_layers.at(entry));
                    }
                    kept += 1;
                }
            }
            if !layer_colors.is_empty() {
                for layer in (0..layer_count).map(|layer| place.vertex(chain, layer)) {
                    layer_colors.put(layer, normalized(layer_colors.at(layer), target));
                }
            }
        }
        counts.put(chain, kept);
    }
}
