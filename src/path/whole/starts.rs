//! The ends of whole paths: where subpaths start.

use super::WholeVertex;
use crate::light::{Emitted, Endpoint};
use crate::path::{FilmCoordinates, LightDraw, Scatterer, VERTEX_INFINITE, VERTEX_LENS, VERTEX_LIGHT, VERTEX_SURFACE};
use crate::sampling::StreamKey;
use crate::scene::Scene;
use glam::{Vec2, Vec3};

/// A new subpath from the camera.
#[derive(Clone, Copy, Debug)]
pub struct CameraStart {
    /// The pixel that it is started through.
    pub pixel: u32,
    /// The place on the film, in pixels.
    pub film: Vec2,
    /// x₀.
    pub vertex: WholeVertex,
    /// The unit direction of its first ray.
    pub direction: Vec3,
}

impl CameraStart {
    /// A place on the film that `key` draws, seen from the point of the lens that `lens` chooses.
    #[must_use]
    pub fn draw(scene: &Scene, key: StreamKey, lens: [f32; 2]) -> Self {
        let (pixel, film) = FilmCoordinates::independent(key).on_film(scene);
        let ray = scene.camera.ray(film, lens);
        Self {
            pixel,
            film,
            vertex: WholeVertex::lens(scene, ray.origin, ray.direction),
            direction: ray.direction,
        }
    }
}

/// A new subpath from a light.
#[derive(Clone, Copy, Debug)]
pub struct LightStart {
    /// The light.
    pub light: u32,
    /// y₀.
    pub vertex: WholeVertex,
    /// The unit direction of its first ray.
    pub direction: Vec3,
}

impl LightStart {
    /// A point of a light that `draw` chooses, and a way from it. `None` where no light is.
    #[must_use]
    pub fn draw(scene: &Scene, (draw, direction): (LightDraw, [f32; 2])) -> Option<Self> {
        let emitted = scene.lights.emit(draw.choice, draw.point, direction)?;
        Some(Self {
            light: emitted.light,
            vertex: WholeVertex::light(&emitted),
            direction: emitted.direction,
        })
    }
}

impl WholeVertex {
    /// An end of a path: a place and a normal, and no surface that scatters.
    #[must_use]
    pub const fn end(kind: u32, position: Vec3, normal: Vec3, offset: f32) -> Self {
        Self {
            surface: Scatterer {
                position,
                normal,
                shading_normal: normal,
                offset,
                material: 0,
                uv: Vec2::ZERO,
                tangent: Vec3::ZERO,
                direction: Vec3::ZERO,
            },
            kind,
        }
    }

    /// The vertex x₀ of a ray that leaves the camera.
    #[must_use]
    pub fn lens(scene: &Scene, origin: Vec3, direction: Vec3) -> Self {
        if scene.camera.is_directional() {
            Self::end(VERTEX_INFINITE, origin, direction, 0.0)
        } else {
            Self::end(VERTEX_LENS, origin, Vec3::ZERO, 0.0)
        }
    }

    /// The vertex y₀ of light that was sent.
    fn light(emitted: &Emitted) -> Self {
        match emitted.endpoint {
            Endpoint::Surface => {
                let offset = (emitted.origin - emitted.position).dot(emitted.normal);
                Self::end(VERTEX_LIGHT, emitted.position, emitted.normal, offset)
            }
            Endpoint::Point => Self::end(VERTEX_LIGHT, emitted.position, emitted.normal, 0.0),
            Endpoint::Infinite => Self::end(VERTEX_INFINITE, emitted.origin, emitted.normal, 0.0),
        }
    }

    /// A light that `draw` chooses as seen from `position`, and the point or direction of it: strategy s = 1.
    #[must_use]
    pub fn sampled_light(scene: &Scene, position: Vec3, draw: LightDraw) -> Option<(u32, Self)> {
        let sample = scene.lights.sample(position, draw.choice, draw.point)?;
        let end = match scene.lights.endpoint(sample.light) {
            Endpoint::Infinite => Self::end(VERTEX_INFINITE, sample.position, sample.normal, 0.0),
            Endpoint::Point => Self::end(VERTEX_LIGHT, sample.position, sample.normal, 0.0),
            Endpoint::Surface => {
                let offset = (sample.target - sample.position).dot(sample.normal);
                Self::end(VERTEX_LIGHT, sample.position, sample.normal, offset)
            }
        };
        Some((sample.light, end))
    }

    /// Vertex `depth` of a subpath that keeps `count` vertices of a path x₀ … xₖ, where `of(i)` is vertex i: from the light, if
    /// `from_light` says k, each is reached against the edge behind it. How the last one scatters is drawn anew.
    #[must_use]
    pub fn kept(of: impl Fn(u32) -> Self, depth: u32, count: u32, from_light: Option<u32>) -> Self {
        let number = from_light.map_or(depth, |k| k - depth);
        let mut kept = of(number);
        if depth + 1 == count && depth > 0 {
            kept.kind = VERTEX_SURFACE;
        }
        if from_light.is_some() && depth > 0 {
            kept.surface.direction = -of(number + 1).surface.direction;
        }
        kept
    }
}
