//! Paths from the camera.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::super::trace::draws::Draws;
use crate::color::Rgb;
use crate::geometry::NOT_EMITTING;
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut, SystemParam};

/// The columns of where a camera subpath starts.
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

/// Starts a path on the lens of every chain, through a film position drawn from the filter about its pixel, or
/// where its primary coordinates say.
pub fn start_camera_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    draws: Draws,
    keys: Read<ChainKey, ChainTable>,
    film: Read<ProposedFilm, ChainTable>,
    mut pixels: Write<FilmPixel, ChainTable>,
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
    let (keys, pixels, primary, draws) = (keys.rows(), pixels.rows(), film.rows(), draws.columns(&place));
    let (directions, lengths, active) = (directions.rows(), lengths.rows(), active.rows());
    let (throughputs, scales) = (throughputs.rows(), scales.rows());
    let (kinds, positions, normals) = (start.kinds.rows(), start.positions.rows(), start.normals.rows());
    let (offsets, ratios, densities) = (start.offsets.rows(), start.ratios.rows(), start.densities.rows());
    let (lights, forwards, tails) = (start.lights.rows(), start.forwards.rows(), start.tails.rows());
    let directional = scene.camera.is_directional();
    for chain in 0..place.chains as usize {
        let lens = if scene.camera.has_aperture() {
            draws.lens(chain)
        } else {
            LENS_CENTER
        };
        let film = if primary.is_empty() {
            film_position(scene, place.key(chain, keys.at(chain)), pixels.at(chain))
        } else {
            let (pixel, film) = FilmCoordinates(primary.at(chain)).on_film(scene);
            pixels.put(chain, pixel);
            film
        };
        let ray = scene.camera.ray(film, lens);
        directions.put(chain, ray.direction);
        lengths.put(chain, 0);
        active.put(queues.active, chain as u32);
        queues.active += 1;
        if !throughputs.is_empty() {
            throughputs.put(chain, Rgb::ONE);
        }
        if !scales.is_empty() {
            scales.put(chain, 1.0);
        }
        // Vertex 0 of a subpath has the subpath's own number.
        positions.put(chain, ray.origin);
        offsets.put(chain, 0.0);
        ratios.put(chain, Rgb::ONE);
        kinds.put(chain, VERTEX_LENS);
        if directional {
            kinds.put(chain, VERTEX_INFINITE);
            normals.put(chain, ray.direction);
        }
        if !forwards.is_empty() {
            densities.put(chain, scene.camera.density(ray.direction));
            lights.put(chain, NOT_EMITTING);
            // The lens is nothing that light can meet: how it was drawn is compared with nothing.
            forwards.put(chain, 1.0);
            tails.put(chain, 0.0);
        }
    }
}
