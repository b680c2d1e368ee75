//! Materials as most tests ask them: without textures, light followed from the camera.

use chainlight::material::{Evaluated, Model, ScatterDraw, Scattered, Transport};
use chainlight::texture::{Shading, TextureTable};
use glam::{Vec2, Vec3};

/// A point without texture coordinates, of a scene without textures.
pub const PLAIN: Shading<'static> = Shading {
    uv: Vec2::ZERO,
    textures: &TextureTable::NONE,
};

/// A model on a [`PLAIN`] surface.
pub trait OnPlain: Model {
    /// Scatters a path from the camera.
    fn scatter(&self, wi: Vec3, direction: [f32; 2]) -> Option<Scattered> {
        let lobe = 0.0;
        self.sample(&PLAIN, wi, ScatterDraw { direction, lobe }, Transport::Radiance)
    }

    /// Scatters a path from the camera, decided by one number alone.
    fn decide(&self, wi: Vec3, u: f32) -> Option<Scattered> {
        self.scatter(wi, [u, 0.0])
    }

    /// Value and densities for a path from the camera.
    fn value(&self, wi: Vec3, wo: Vec3) -> Evaluated {
        self.evaluate(&PLAIN, wi, wo, Transport::Radiance)
    }
}

impl<M: Model> OnPlain for M {}
