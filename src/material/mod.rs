//! Materials: how surfaces scatter light. One file per model, whose head is its manual; one table per model.
//!
//! **Spaces and signs.** A model works in the local frame of the shading normal ([`Frame`]): z is the normal. `wi`
//! points from the surface towards where the path comes from, `wo` towards where it goes on; both point away from the
//! surface. Values are radiance transport from the camera: light that arrives along `wo` leaves along `wi`.
//!
//! **Measures.** A model either has a density per solid angle (and is evaluated for any pair of directions), or it is
//! discrete: it scatters into a few directions alone, has no value for a given pair, and its `density` is the
//! probability of the direction it took.

pub mod conductor;
pub mod dielectric;
pub mod diffuse;
mod frame;
pub mod fresnel;
pub mod microfacet;
mod table;

pub use frame::Frame;
pub use table::{MaterialKind, MaterialTable};

use crate::color::Rgb;
use glam::Vec3;

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered {
    /// The direction in which the path goes on, local frame, unit length.
    pub wo: Vec3,
    /// f · |cos θₒ| / density: what the path's throughput is multiplied by.
    pub ratio: Rgb,
    /// Density of `wo` per solid angle, or its probability if `discrete`.
    pub density: f32,
    /// Whether the direction is one of a few that the material can scatter into.
    pub discrete: bool,
    /// Index of refraction of the side the path goes on into, relative to the side it came from; 1 for reflection.
    pub relative_ior: f32,
}

/// A material's value for a pair of directions, with the density of sampling it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated {
    /// f · |cos θₒ|, per steradian.
    pub value: Rgb,
    /// Density of `wo` per solid angle, given `wi`.
    pub density: f32,
}

impl Evaluated {
    /// Nothing is scattered from one direction to the other.
    pub const ZERO: Self = Self {
        value: Rgb::BLACK,
        density: 0.0,
    };
}
