//! A path's light by layers.

use super::super::layers::{LayerWork, LayersRef};
use super::super::tile::{SceneRef, TilePlace};
use super::normalized;
use crate::color::Rgb;
use crate::layer::{
    ConnectionEnd, End, LayerColor, LayerState, OWN_LAYERS, ProposedLayerTable, SplatLayer, Stop, VertexConnectionEnd,
    event,
};
use crate::path::measure::Site;
use crate::path::{
    ChainTable, Contribution, PathLength, ProposalTable, ProposedSplatTable, VERTEX_INFINITE, VertexConnection,
    VertexEmission, VertexKind, VertexMaterial, VertexNormal, VertexPosition, VertexRatio, target_of,
};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Local, Res, ResMut, SystemParam};

/// The columns of paths.
#[derive(SystemParam)]
pub struct Paths<'w, 's> {
    lengths: Read<'w, 's, PathLength, ChainTable>,
    contributions: Read<'w, 's, Contribution, ChainTable>,
    kinds: Read<'w, 's, VertexKind, ProposalTable>,
    positions: Read<'w, 's, VertexPosition, ProposalTable>,
    normals: Read<'w, 's, VertexNormal, ProposalTable>,
    materials: Read<'w, 's, VertexMaterial, ProposalTable>,
    ratios: Read<'w, 's, VertexRatio, ProposalTable>,
    emissions: Read<'w, 's, VertexEmission, ProposalTable>,
    connections: Read<'w, 's, VertexConnection, ProposalTable>,
    ends: Read<'w, 's, VertexConnectionEnd, ProposalTable>,
}

/// Splits what [`gather_contribution`](super::gather_contribution) sums among the layers of the paths that bring it. Where chains have
/// states, what layers have of a state's only splat is divided by its target, as the splat is.
pub fn split_layers(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    layers: Res<LayersRef>,
    mut work: ResMut<LayerWork>,
    paths: Paths,
    mut colors: Write<LayerColor, ProposedLayerTable>,
    mut splat_layers: Write<SplatLayer, ProposedSplatTable>,
    mut tried: Local<Vec<f64>>,
) {
    let (scene, layers) = (&*scene.0, &*layers.0);
    let (lengths, contributions) = (paths.lengths.rows(), paths.contributions.rows());
    let (kinds, positions, normals) = (paths.kinds.rows(), paths.positions.rows(), paths.normals.rows());
    let (materials, ratios) = (paths.materials.rows(), paths.ratios.rows());
    let (emissions, connections, ends) = (paths.emissions.rows(), paths.connections.rows(), paths.ends.rows());
    let (colors, splat_layers) = (colors.rows(), splat_layers.rows());
    let site = |vertex: usize| Site {
        kind: kinds.at(vertex),
        position: positions.at(vertex),
        normal: normals.at(vertex),
    };
    for chain in 0..place.chains as usize {
        let color = |layer: usize| place.vertex(chain, layer as u32);
        (0..layers.len()).for_each(|layer| colors.put(color(layer), Rgb::BLACK));
        tried.clear();
        tried.resize(layers.len(), 0.0);
        let (length, mut segments) = (lengths.at(chain), 0.0);
        let (mut throughput, mut state) = (Rgb::ONE, LayerState::CAMERA);
        for depth in 1..=length {
            let (before, vertex) = (place.vertex(chain, depth - 1), place.vertex(chain, depth));
            throughput *= ratios.at(before);
            let mut book = |layer: usize, light: Rgb, edges: u32| {
                tried[layer] += f64::from(edges);
                colors.put(color(layer), colors.at(color(layer)) + light);
            };
            let emission = emissions.at(vertex);
            if !emission.is_black() {
                let end = if kinds.at(vertex) == VERTEX_INFINITE {
                    End::Infinity
                } else {
                    End::Shape
                };
                book(layers.end(state, end), throughput * emission, depth);
            }
            let stop = |vertex: usize| Stop {
                site: site(vertex),
                material: materials.at(vertex),
            };
            if !ends.is_empty()
                && let Some(ConnectionEnd { transmits, end }) = ConnectionEnd::unpacked(ends.at(vertex))
            {
                // Lights are connected to by lobes with a density, whichever lobe the path itself took.
                let event = scene.materials.kind(materials.at(vertex)).event(false, transmits);
                let layer = layers.end(layers.then(state, event), end);
                book(layer, throughput * connections.at(vertex), depth + 1);
                segments += 1.0;
            }
            if depth < length {
                let after = site(place.vertex(chain, depth + 1));
                state = layers.then(state, event(scene, &site(before), &stop(vertex), &after));
            }
        }
        if splat_layers.is_empty() {
            work.book(f64::from(length.max(1)) + segments, &tried);
            continue;
        }
        splat_layers.put(chain, OWN_LAYERS);
        let target = target_of(contributions.at(chain));
        if target > 0.0 && target.is_finite() {
            for layer in (0..layers.len()).map(color) {
                colors.put(layer, normalized(colors.at(layer), target));
            }
        }
    }
}
