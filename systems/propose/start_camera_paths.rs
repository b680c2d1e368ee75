//! Paths from the camera.

use super::super::tile::{Queues, SceneRef, TilePlace};
use crate::color::Rgb;
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};

/// Starts a path on the lens of every chain, through a film position drawn from the filter about its pixel, or
/// where its primary coordinates say.
pub fn start_camera_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    keys: Read<ChainKey, ChainTable>,
    film: Read<ProposedFilm, ChainTable>,
    mut pixels: Write<FilmPixel, ChainTable>,
    mut directions: Write<Direction, ChainTable>,
    mut lengths: Write<PathLength, ChainTable>,
    mut throughputs: Write<Throughput, ChainTable>,
    mut scales: Write<RadianceScale, ChainTable>,
    mut active: Write<ActiveList, ChainTable>,
    mut kinds: Write<VertexKind, ProposalTable>,
    mut positions: Write<VertexPosition, ProposalTable>,
    mut offsets: Write<VertexOffset, ProposalTable>,
    mut ratios: Write<VertexRatio, ProposalTable>,
) {
    let scene = &*scene.0;
    let (keys, pixels, primary) = (keys.rows(), pixels.rows(), film.rows());
    let (directions, lengths, active) = (directions.rows(), lengths.rows(), active.rows());
    let (throughputs, scales) = (throughputs.rows(), scales.rows());
    let (kinds, positions, offsets, ratios) = (kinds.rows(), positions.rows(), offsets.rows(), ratios.rows());
    for chain in 0..place.chains as usize {
        let (film, lens) = if primary.is_empty() {
            let key = place.key(chain, keys.at(chain));
            let lens = if scene.camera.has_aperture() {
                KeyedDraws(key).lens()
            } else {
                LENS_CENTER
            };
            (film_position(scene, key, pixels.at(chain)), lens)
        } else {
            let (pixel, film) = FilmCoordinates(primary.at(chain)).on_film(scene);
            pixels.put(chain, pixel);
            (film, LENS_CENTER)
        };
        let ray = scene.camera.ray(film, lens);
        directions.put(chain, ray.direction);
        lengths.put(chain, 0);
        active.put(chain, chain as u32);
        if !throughputs.is_empty() {
            throughputs.put(chain, Rgb::ONE);
        }
        if !scales.is_empty() {
            scales.put(chain, 1.0);
        }
        // Vertex 0 of a chain has the chain's own number.
        kinds.put(chain, VERTEX_LENS);
        positions.put(chain, ray.origin);
        offsets.put(chain, 0.0);
        ratios.put(chain, Rgb::ONE);
    }
    queues.active = place.chains as usize;
}
