//! Lights: what emits, how a light and a point on it are chosen, and with what density.
//!
//! One row per emitting primitive, chosen in proportion to its power. Emission is one-sided: on the side of the geometric
//! normal, the same radiance in every direction (W sr⁻¹ m⁻²).

mod cylinder;
mod disk;
mod emitter;
mod sample;
mod sphere;
mod table;
mod triangle;

pub use emitter::{Emitter, EmitterShape};
pub use sample::{EmissionDensities, Emitted, Endpoint, LightSample};
pub use table::LightTable;

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

impl EmitterPoint {
    /// A point that was drawn uniformly over an area; `None` if the reference point `from` sees its back or its edge.
    #[inline]
    fn uniform_in_area(area: f32, from: Vec3, position: Vec3, normal: Vec3) -> Option<Self> {
        let density = area_density(area, from, position, normal);
        (density > 0.0 && density.is_finite()).then_some(Self {
            position,
            normal,
            density,
        })
    }
}

/// The density, per solid angle at `from`, of a point that is drawn uniformly over an area; 0 where `from` sees its back.
#[inline]
#[must_use]
fn area_density(area: f32, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
    let to_reference = from - position;
    let distance_squared = to_reference.length_squared();
    // |r|² / (A cos θ) with cos θ = n·r / |r|.
    let projected = normal.dot(to_reference);
    if projected > 0.0 {
        distance_squared * distance_squared.sqrt() / (projected * area)
    } else {
        0.0
    }
}
