//! `Point`: a point that shines alike in all directions.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `position` | where it is | scene units | required |
//! | `intensity` | power per solid angle | W sr⁻¹, [0, 1e12] per channel | required |
//!
//! Use it for lamps far smaller than their distance to everything, where hard shadows are wanted. No path meets it: a
//! mirror does not show it, and a caustic of it is found by tracing light from it alone. Light reaches a surface at
//! distance d with irradiance I cos θ / d² (Pharr, Jakob and Humphreys 2023, §12.2). Do not use it where mirrors or glass
//! throw its light onto other things that are then seen in mirrors or glass: no technique finds that. A small sphere that emits has a size, and can be met.

use crate::color::Rgb;
use crate::sampling::warp;
use glam::Vec3;
use std::f32::consts::PI;

/// A point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Position, world space.
    pub position: Vec3,
    /// Power per solid angle, W sr⁻¹.
    pub intensity: Rgb,
}

/// Density per solid angle of a direction that is uniform over the sphere.
pub(super) const UNIFORM: f32 = 0.25 / PI;

impl Point {
    /// Unit direction from `from` to the light, and 1 / d²; `None` where it is not finite.
    pub(super) fn seen(position: Vec3, from: Vec3) -> Option<(Vec3, f32)> {
        let span = position.as_dvec3() - from.as_dvec3();
        let falloff = (1.0 / span.length_squared()) as f32;
        (falloff > 0.0 && falloff.is_finite()).then(|| (span.normalize().as_vec3(), falloff))
    }

    /// Mean of the channels' powers in W.
    pub(super) fn power(&self) -> f64 {
        f64::from(self.intensity.mean()) / f64::from(UNIFORM)
    }

    /// The direction of a ray that leaves the light.
    pub(super) fn direction(u: [f32; 2]) -> Vec3 {
        warp::uniform_sphere(u).normalize()
    }
}
