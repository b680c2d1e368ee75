//! Whole paths of two subpaths: the edge that joins them.

use super::WholeVertex;
use crate::geometry::NOT_EMITTING;
use crate::path::{VERTEX_INFINITE, VERTEX_LENS, VERTEX_LIGHT};
use crate::sampling::{Purpose, StreamKey};
use crate::scene::Scene;
use glam::Vec3;

/// Chooses among lights at infinity that a path meets all at once.
const AMONG_INFINITE: Purpose = Purpose::named("light met at infinity");

/// The unit direction of the edge from `x`, the last vertex of a camera subpath, to `y`, the last of a light subpath; `None` where
/// both are in one place, or the lens does not see `y`.
#[must_use]
pub fn joining(scene: &Scene, x: &WholeVertex, y: &WholeVertex) -> Option<Vec3> {
    if y.kind == VERTEX_INFINITE {
        return Some(-y.surface.normal);
    }
    if matches!(x.kind, VERTEX_LENS | VERTEX_INFINITE) {
        return Some(scene.camera.project(x.surface.position, y.surface.position)?.direction);
    }
    let span = y.surface.position.as_dvec3() - x.surface.position.as_dvec3();
    let squared = span.length_squared();
    (squared > 0.0).then(|| (span / squared.sqrt()).as_vec3())
}

/// Where the segment from `x` to `y` starts and ends; `from_lens` says that `x` is all of the camera subpath.
#[must_use]
pub fn segment(scene: &Scene, x: &WholeVertex, y: &WholeVertex, from_lens: bool) -> Option<(Vec3, Vec3)> {
    if from_lens {
        if y.kind == VERTEX_INFINITE {
            return None;
        }
        let view = scene.camera.project(x.surface.position, y.surface.position)?;
        return Some((y.surface.leaving(-view.direction), view.origin));
    }
    let direction = joining(scene, x, y)?;
    let origin = x.surface.leaving(direction);
    if y.kind == VERTEX_INFINITE {
        return Some((origin, scene.lights.beyond(x.surface.position, direction)));
    }
    Some((origin, y.surface.leaving(-direction)))
}

/// Completes a path whose vertices from the camera are in `path`, with those of the light subpath from its last to y₀.
///
/// `light` is where that subpath starts, or, without one, what the camera subpath has met; `key` chooses among lights at infinity
/// that it meets all at once. The light that the path ends on, if it is one.
#[must_use]
pub fn complete(
    scene: &Scene,
    key: StreamKey,
    path: &mut Vec<WholeVertex>,
    from_light: impl ExactSizeIterator<Item = WholeVertex>,
    light: u32,
) -> Option<u32> {
    let last = path.last_mut()?;
    let mut rest = from_light.peekable();
    let Some(y) = rest.peek() else {
        if last.kind == VERTEX_INFINITE {
            let lights = &scene.lights;
            let u = key.stream(AMONG_INFINITE, 0).next_f64();
            let count = lights.infinite().count();
            return lights.infinite().nth((u * count as f64) as usize);
        }
        last.kind = VERTEX_LIGHT;
        return (light != NOT_EMITTING).then_some(light);
    };
    let mut direction = joining(scene, last, y)?;
    for mut vertex in rest {
        // What led from the light to this vertex leads from it to the light.
        let onward = -vertex.surface.direction;
        vertex.surface.direction = direction;
        direction = onward;
        path.push(vertex);
    }
    Some(light)
}
