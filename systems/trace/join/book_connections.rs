//! Light that arrived.

use super::super::super::tile::{Queues, TilePlace};
use crate::chain::ProposedClass;
use crate::geometry::SegmentTransmittance;
use crate::layer::{LayerColor, ProposedLayerTable, SegmentLayer, SplatLayer};
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Adds what the offered segments let through to their chains' lists: to the entry of the chain's own pixel, which is the
/// first, or as an entry of its own; and to their layers.
pub fn book_connections(
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    chains: Read<RayChain, RayTable>,
    lights: Read<SegmentLight, RayTable>,
    reached: Read<SegmentPixel, RayTable>,
    transmittances: Read<SegmentTransmittance, RayTable>,
    segment_classes: Read<SegmentClass, RayTable>,
    segment_layers: Read<SegmentLayer, RayTable>,
    mut counts: Write<ProposedSplatCount, ChainTable>,
    mut brightest: Write<BrightestLight, ChainTable>,
    mut classes: Write<ProposedClass, ChainTable>,
    mut pixels: Write<SplatPixel, ProposedSplatTable>,
    mut colors: Write<SplatColor, ProposedSplatTable>,
    mut splat_layers: Write<SplatLayer, ProposedSplatTable>,
    mut layer_colors: Write<LayerColor, ProposedLayerTable>,
) {
    let (chains, lights, reached) = (chains.rows(), lights.rows(), reached.rows());
    let (transmittances, segment_classes) = (transmittances.rows(), segment_classes.rows());
    let (counts, pixels, colors) = (counts.rows(), pixels.rows(), colors.rows());
    let (segment_layers, splat_layers) = (segment_layers.rows(), splat_layers.rows());
    let layer_colors = layer_colors.rows();
    let (brightest, classes) = (brightest.rows(), classes.rows());
    for segment in 0..std::mem::take(&mut queues.segments) {
        let light = lights.at(segment) * transmittances.at(segment);
        if light.is_black() {
            continue;
        }
        let chain = chains.at(segment) as usize;
        let pixel = reached.at(segment);
        if pixel == OWN_PIXEL {
            colors.put(chain, colors.at(chain) + light);
            if !layer_colors.is_empty() {
                let layer = place.vertex(chain, segment_layers.at(segment));
                layer_colors.put(layer, layer_colors.at(layer) + light);
            }
        } else {
            let count = counts.at(chain);
            let entry = place.vertex(chain, count);
            pixels.put(entry, pixel);
            colors.put(entry, light);
            if !splat_layers.is_empty() {
                splat_layers.put(entry, segment_layers.at(segment));
            }
            counts.put(chain, count + 1);
        }
        if !brightest.is_empty() && target_of(light) > brightest.at(chain) {
            brightest.put(chain, target_of(light));
            classes.put(chain, segment_classes.at(segment));
        }
    }
}
