//! `Environment(radiance)`: the same light from all directions outside the scene.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `radiance` | radiance from every direction | W sr⁻¹ m⁻², [0, 1e12] per channel | this, or `file` |
//!
//! Use it for an overcast sky, and for furnace tests: in it, what reflects everything cannot be seen. Do not use it for light
//! that comes from somewhere: without shadows to speak of, shapes look flat. It is an infinite area light (Pharr, Jakob and
//! Humphreys 2023, §12.5). Directions are uniform over the sphere. The parameters of `Environment(file)` hold for it too, though turning it changes nothing.

use super::infinite::Infinite;
use super::point::UNIFORM;
use crate::color::Rgb;
use glam::Vec3;
use std::f64::consts::{PI, TAU};

/// An environment of one radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constant {
    /// Radiance from every direction, W sr⁻¹ m⁻².
    pub radiance: Rgb,
}

impl Infinite for Constant {
    fn sample(&self, [u, v]: [f64; 2]) -> Option<Vec3> {
        let z = 1.0 - 2.0 * u;
        let r = (1.0 - z * z).max(0.0).sqrt();
        let angle = TAU * v;
        let direction = glam::DVec3::new(r * libm::cos(angle), r * libm::sin(angle), z);
        Some(direction.normalize().as_vec3())
    }

    fn density(&self, _direction: Vec3) -> f32 {
        UNIFORM
    }

    fn radiance(&self, _direction: Vec3) -> Rgb {
        self.radiance
    }

    fn total(&self) -> f64 {
        4.0 * PI * f64::from(self.radiance.mean())
    }

    fn max_radiance(&self) -> f32 {
        self.radiance.max_channel()
    }
}
