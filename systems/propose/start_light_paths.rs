//! Paths from lights.

use super::super::tile::{Queues, SceneRef, TilePlace};
use super::super::trace::draws::Draws;
use super::starts::{FirstVertex, Starts};
use crate::light::Endpoint;
use crate::path::*;
use bevy_ecs::system::{Res, ResMut};

/// Starts a subpath on a light for every chain: a light in proportion to its power, a point on it, and a direction. A chain
/// whose draw sends no light out has none: its length is [`NO_SUBPATH`].
pub fn start_light_paths(
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    mut queues: ResMut<Queues>,
    draws: Draws,
    mut starts: Starts,
) {
    if place.first_coordinate == 0 && !queues.starting {
        return;
    }
    let scene = &*scene.0;
    let (draws, mut starts) = (draws.columns(&place), starts.columns());
    for chain in 0..place.chains as usize {
        let path = place.lights_from as usize + chain;
        let (light, direction) = draws.emission(path);
        let Some(emitted) = scene.lights.emit(light.choice, light.point, direction) else {
            starts.without(path);
            continue;
        };
        let (kind, position, offset) = match emitted.endpoint {
            Endpoint::Surface => {
                let offset = (emitted.origin - emitted.position).dot(emitted.normal);
                (VERTEX_LIGHT, emitted.position, offset)
            }
            Endpoint::Point => (VERTEX_LIGHT, emitted.position, 0.0),
            Endpoint::Infinite => (VERTEX_INFINITE, emitted.origin, 0.0),
        };
        let first = FirstVertex {
            kind,
            position,
            normal: emitted.normal,
            offset,
            direction: emitted.direction,
            ratio: emitted.ratio,
            density: emitted.densities.direction,
            light: emitted.light,
            forward: f64::from(emitted.densities.position),
        };
        // Where paths are one edge long at most, light subpaths are seen where they start.
        starts.begin(&mut queues, path, &first, scene.max_depth > 1);
    }
}
