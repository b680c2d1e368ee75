//! Paths from the camera.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::super::trace::draws::Draws;
use super::starts::{FirstVertex, Starts};
use crate::color::Rgb;
use crate::geometry::NOT_EMITTING;
use crate::path::*;
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::{Res, ResMut};
use glam::Vec3;

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
    mut starts: Starts,
) {
    if place.first_coordinate == 0 && !queues.starting {
        return;
    }
    let scene = &*scene.0;
    let camera = &scene.camera;
    let (keys, pixels, primary, draws) = (keys.rows(), pixels.rows(), film.rows(), draws.columns(&place));
    let mut starts = starts.columns();
    for chain in 0..place.chains as usize {
        let lens = if camera.has_aperture() {
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
        let ray = camera.ray(film, lens);
        let (kind, normal) = if camera.is_directional() {
            (VERTEX_INFINITE, ray.direction)
        } else {
            (VERTEX_LENS, Vec3::ZERO)
        };
        let first = FirstVertex {
            kind,
            position: ray.origin,
            normal,
            offset: 0.0,
            direction: ray.direction,
            ratio: Rgb::ONE,
            density: if starts.weighs() {
                camera.density(ray.direction)
            } else {
                0.0
            },
            light: NOT_EMITTING,
            // The lens is nothing that light can meet: how it was drawn is compared with nothing.
            forward: 1.0,
        };
        starts.begin(&mut queues, chain, &first, true);
    }
}
