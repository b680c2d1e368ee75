//! Lights: what emits, how a light and a point on it are chosen, and with what density.
//!
//! One row per emitting primitive, then one per light that is no shape; all are chosen in proportion to their power.
//! Emission of a primitive is one-sided: on the side of the geometric normal, the same radiance in every direction
//! (W sr⁻¹ m⁻²). Each kind of light is a file, whose head is its manual:
//!
//! | kind | met by paths | vertex of a path on it |
//! |---|---|---|
//! | emitter: triangle, sphere, disk, cylinder | yes | a point of its surface |
//! | [`Point`], [`Spot`] | no | the point |
//! | [`Directional`] | no | the direction |
//! | [`Constant`], [`Image`], [`Sun`], [`Sky`] | by rays that leave the scene; they add up | a direction |
//!
//! Light from infinity enters the scene through a disc as wide as the scene's bounding sphere: its direction is drawn
//! first, then a point of the disc that faces it, outside the sphere.

mod constant;
mod cylinder;
mod directional;
mod disk;
mod emitter;
mod hosek_wilkie;
mod image;
mod infinite;
mod kind;
mod point;
mod sample;
mod sky;
mod sphere;
mod sphere_map;
mod spot;
mod sun;
mod table;
mod triangle;

pub use constant::Constant;
pub use directional::Directional;
pub use emitter::{Emitter, EmitterShape};
pub use hosek_wilkie::TURBIDITY;
pub use image::{Image, ImageError};
pub use kind::Light;
pub use point::Point;
pub use sample::{EmissionDensities, Emitted, Endpoint, LightSample};
pub use sky::Sky;
pub use spot::Spot;
pub use sun::{SUN_RADIUS, Sun};
pub use table::LightTable;

use glam::Vec3;

/// A point chosen on an emitter as seen from some reference point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct EmitterPoint {
    /// Position, world space.
    position: Vec3,
    /// Unit geometric normal.
    normal: Vec3,
    /// Unit direction from the reference point.
    direction: Vec3,
    /// Density of the point per solid angle at the reference point, given the emitter.
    density: f32,
}

impl EmitterPoint {
    /// A point that was drawn uniformly over an area; `None` if the reference point `from` sees its back or its edge.
    #[inline(always)]
    fn uniform_in_area(area: f32, from: Vec3, position: Vec3, normal: Vec3) -> Option<Self> {
        let density = area_density(area, from, position, normal);
        (density > 0.0 && density.is_finite()).then_some(Self {
            position,
            normal,
            direction: (position - from).normalize(),
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
