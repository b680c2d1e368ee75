//! Layers of lists of splats.

use super::super::chains::GroupPlace;
use super::super::layers::{LayerFilmsRef, LayersRef};
use super::super::tile::{Queues, TilePlace};
use crate::chain::{Acceptance, AcceptedList};
use crate::layer::{LayerColor, LayerTable, LayerWriter, OWN_LAYERS, ProposedLayerTable, SplatLayer};
use crate::path::{
    BookedWeight, ChainTable, ProposedSplatCount, ProposedSplatTable, SplatColor, SplatCount, SplatPixel, SplatTable,
};
use crate::table::{Column, Read, Rows, Table, Write};
use bevy_ecs::system::{Res, SystemParam};

/// Lists of splats in the table `S`, whose splats to chains' own pixels are split in the table `L`.
#[derive(SystemParam)]
pub struct Lists<'w, 's, Count: Column<Value = u32>, S: Table, L: Table> {
    counts: Read<'w, 's, Count, ChainTable>,
    pixels: Read<'w, 's, SplatPixel, S>,
    colors: Read<'w, 's, SplatColor, S>,
    layers: Read<'w, 's, SplatLayer, S>,
    own: Read<'w, 's, LayerColor, L>,
}

/// Those of proposals.
type Proposed<'w, 's> = Lists<'w, 's, ProposedSplatCount, ProposedSplatTable, ProposedLayerTable>;
/// Those of current states.
type Current<'w, 's> = Lists<'w, 's, SplatCount, SplatTable, LayerTable>;

/// [`Lists`] as slices.
struct ListColumns<'a, Count> {
    counts: &'a [Count],
    pixels: &'a [SplatPixel],
    colors: &'a [SplatColor],
    layers: &'a [SplatLayer],
    own: &'a [LayerColor],
}

impl<Count: Column<Value = u32>, S: Table, L: Table> Lists<'_, '_, Count, S, L> {
    fn columns(&self) -> ListColumns<'_, Count> {
        ListColumns {
            counts: self.counts.rows(),
            pixels: self.pixels.rows(),
            colors: self.colors.rows(),
            layers: self.layers.rows(),
            own: self.own.rows(),
        }
    }
}

impl<Count: Column<Value = u32>> ListColumns<'_, Count> {
    /// Adds a chain's list times `weight`, layer by layer.
    #[inline]
    fn put(&self, place: &TilePlace, layers: usize, chain: usize, weight: f32, writer: &mut LayerWriter<'_>) {
        for entry in (0..self.counts.at(chain)).map(|k| place.vertex(chain, k)) {
            let (pixel, layer) = (self.pixels.at(entry), self.layers.at(entry));
            if layer != OWN_LAYERS {
                writer.put(layer as usize, pixel, self.colors.at(entry) * weight);
                continue;
            }
            for layer in 0..layers {
                let light = self.own.at(place.vertex(chain, layer as u32));
                if !light.is_black() {
                    writer.put(layer, pixel, light * weight);
                }
            }
        }
    }
}

/// Adds each chain's list to the films of layers, as [`splat_lists`](super::splat_lists) does to those of the picture.
pub fn splat_list_layers(
    films: Res<LayerFilmsRef>,
    layers: Res<LayersRef>,
    place: Res<TilePlace>,
    weights: Read<BookedWeight, ChainTable>,
    lists: Proposed,
) {
    let (weights, lists) = (weights.rows(), lists.columns());
    let mut writer = films.films.writer(films.turn(place.step), films.weight);
    for chain in 0..place.chains as usize {
        lists.put(
            &place,
            layers.0.len(),
            chain,
            weights.at(chain) * films.scale,
            &mut writer,
        );
    }
}

/// Adds both states of every decision to the films of layers, as [`splat_states`](super::splat_states) does to those of the picture.
pub fn splat_state_layers(
    films: Res<LayerFilmsRef>,
    layers: Res<LayersRef>,
    place: Res<TilePlace>,
    group: Res<GroupPlace>,
    acceptances: Read<Acceptance, ChainTable>,
    current: Current,
    proposed: Proposed,
) {
    let (acceptances, layers) = (acceptances.rows(), layers.0.len());
    let (current, proposed) = (current.columns(), proposed.columns());
    let mut writer = films.films.writer(group.group as usize, films.weight);
    for chain in 0..place.chains as usize {
        let accepted = acceptances.at(chain);
        let kept = (1.0 - accepted) as f32;
        if kept > 0.0 {
            current.put(&place, layers, chain, kept, &mut writer);
        }
        if accepted > 0.0 {
            proposed.put(&place, layers, chain, accepted as f32, &mut writer);
        }
    }
}

/// Makes the layers of every accepted proposal's list those of the current state's, before
/// [`take_splats`](super::take_splats) takes the list itself.
pub fn take_layers(
    layers: Res<LayersRef>,
    place: Res<TilePlace>,
    queues: Res<Queues>,
    accepted: Read<AcceptedList, ChainTable>,
    proposed: Proposed,
    mut splat_layers: Write<SplatLayer, SplatTable>,
    mut own: Write<LayerColor, LayerTable>,
) {
    let (accepted, splat_layers, own) = (accepted.rows(), splat_layers.rows(), own.rows());
    let proposed = proposed.columns();
    for chain in (0..queues.accepted).map(|entry| accepted.at(entry) as usize) {
        for entry in (0..proposed.counts.at(chain)).map(|k| place.vertex(chain, k)) {
            splat_layers.put(entry, proposed.layers.at(entry));
        }
        if !own.is_empty() {
            for layer in (0..layers.0.len()).map(|layer| place.vertex(chain, layer as u32)) {
                own.put(layer, proposed.own.at(layer));
            }
        }
    }
}
