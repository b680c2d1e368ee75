//! Where whole paths are seen.

use crate::path::{KeyedDraws, pixel_of};
use crate::sampling::StreamKey;
use crate::scene::Scene;
use glam::{Vec2, Vec3};

/// Where on the film a path is seen.
#[derive(Clone, Copy, Debug)]
pub struct FilmPlace {
    /// The pixel that it counts for.
    pub pixel: u32,
    /// The place, in pixels.
    pub film: Vec2,
    /// The sum of all pixels' filters there.
    pub filter: f32,
}

impl FilmPlace {
    /// Where a path is seen that was started through a place on the film, `started` for its pixel, if that is known; for one of
    /// those whose filters reach there else, as `key` chooses.
    #[must_use]
    pub fn through(scene: &Scene, key: StreamKey, film: Vec2, started: Option<u32>) -> Option<Self> {
        let (chosen, filter) = pixel_of(scene, film, KeyedDraws(key).splat(0))?;
        Some(Self {
            pixel: started.unwrap_or(chosen),
            film,
            filter,
        })
    }

    /// The same where the lens at `lens` sees a light subpath that ends at `y`.
    #[must_use]
    pub fn by_lens(scene: &Scene, key: StreamKey, lens: Vec3, y: Vec3) -> Option<Self> {
        Self::through(scene, key, scene.camera.project(lens, y)?.film, None)
    }
}
