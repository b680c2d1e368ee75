//! Paths from lights.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::super::trace::draws::Draws;
use crate::color::Rgb;
use crate::light::Endpoint;
use crate::path::*;
use crate::table::{Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};

/// The columns of where a light subpath starts.
#[derive(SystemParam)]
pub struct Start<'w, 's> {
    kinds: Write<'w, 's, VertexKind, ProposalTable>,
    positions: Write<'w, 's, VertexPosition, ProposalTable>,
    normals: Write<'w, 's, VertexNormal, ProposalTable>,
    offsets: Write<'w, 's, VertexOffset, ProposalTable>,
    ratios: Write<'w, 's, VertexRatio, ProposalTable>,
    densities: Write<'w, 's, VertexDensity, ProposalTable>,
    lights: Write<'w, 's, VertexLight, ProposalTable>,
    forwards: Write<'w, 's, VertexForward, ProposalTable>,
    tails: Write<'w, 's, VertexTail, ProposalTable>,
}

/// Starts a subpath on a light for every chain: a light in proportion to its power, a point on it, and a direction. A chain
/// whose draw sends no light out has none: its length is [`NO_SUBPATH`].
pub fn start_light_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    draws: Draws,
    mut directions: Write<Direction, ChainTable>,
    mut lengths: Write<PathLength, ChainTable>,
    mut throughputs: Write<Throughput, ChainTable>,
    mut scales: Write<RadianceScale, ChainTable>,
    mut active: Write<ActiveList, ChainTable>,
    mut start: Start,
) {
    if place.first_coordinate == 0 && !queues.starting {
        return;
    }
    let scene = &*scene.0;
    let draws = draws.columns(&place);
    let (directions, lengths, active) = (directions.rows(), lengths.rows(), active.rows());
    let (throughputs, scales) = (throughputs.rows(), scales.rows());
    let (kinds, positions, normals) = (start.kinds.rows(), start.positions.rows(), start.normals.rows());
    let (offsets, ratios, densities) = (start.offsets.rows(), start.ratios.rows(), start.densities.rows());
    let (lights, forwards, tails) = (start.lights.rows(), start.forwards.rows(), start.tails.rows());
    for chain in 0..place.chains as usize {
        // Vertex 0 of a subpath has the subpath's own number.
        let path = place.lights_from as usize + chain;
        let (light, direction) = draws.emission(path);
        let Some(emitted) = scene.lights.emit(light.choice, light.point, direction) else {
            lengths.put(path, NO_SUBPATH);
            continue;
        };
        directions.put(path, emitted.direction);
        lengths.put(path, 0);
        if !throughputs.is_empty() {
            throughputs.put(path, Rgb::ONE);
        }
        if !scales.is_empty() {
            scales.put(path, 1.0);
        }
        let (kind, position, offset) = match emitted.endpoint {
            Endpoint::Surface => {
                let offset = (emitted.origin - emitted.position).dot(emitted.normal);
                (VERTEX_LIGHT, emitted.position, offset)
            }
            Endpoint::Point => (VERTEX_LIGHT, emitted.position, 0.0),
            Endpoint::Infinite => (VERTEX_INFINITE, emitted.origin, 0.0),
        };
        kinds.put(path, kind);
        positions.put(path, position);
        normals.put(path, emitted.normal);
        offsets.put(path, offset);
        ratios.put(path, emitted.ratio);
        densities.put(path, emitted.densities.direction);
        lights.put(path, emitted.light);
        if !forwards.is_empty() {
            forwards.put(path, f64::from(emitted.densities.position));
            tails.put(path, 0.0);
        }
        // Where paths are one edge long at most, light subpaths are seen where they start.
        if scene.max_depth > 1 {
            active.put(queues.active, path as u32);
            queues.active += 1;
        }
    }
}
