//! Lights: what emits, how a light and a point on it are chosen, and with what density.
//!
//! One row per emitting primitive (a triangle or a sphere), chosen in proportion to its power. Emission is one-sided:
//! on the side of the geometric normal, the same radiance in every direction (W sr⁻¹ m⁻²).

mod sphere;
mod table;
mod triangle;

pub use table::{Emitter, EmitterShape, LightSample, LightTable};

use glam::Vec3;

/// A point chosen on an emitter as seen from some reference point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct EmitterPoint {
    /// Position, world space.
    position: Vec3,
    /// Unit geometric normal.
    normal: Vec3,
    /// Density of the point per solid angle at the reference point, given the emitter.
    density: f32,
}
