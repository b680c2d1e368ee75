//! What a material model is: how it draws a direction, and its value for a pair of directions.

use super::MaterialKind;
use crate::color::Rgb;
use crate::texture::Shading;
use glam::Vec3;
use std::fmt::Debug;

/// Which quantity a path carries from its start on. The two differ where scattering is not symmetric: at refraction
/// (Veach 1997, §5.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transport {
    /// Paths from the camera: light travels against the path.
    Radiance,
    /// Paths from a light: light travels along the path.
    Importance,
}

/// The uniform numbers in [0, 1) that one scattering is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatterDraw {
    /// Choose the direction.
    pub direction: [f32; 2],
    /// Chooses between lobes, for models that have several ([`MaterialKind::chooses_lobes`]); 0 elsewhere.
    pub lobe: f32,
}

/// Which of the directions that discrete scattering leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiscreteLobe {
    /// Mirrored: the path stays on its side.
    Reflection,
    /// Bent: the path goes through.
    Refraction,
}

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered {
    /// The direction in which the path goes on, local frame, unit length.
    pub wo: Vec3,
    /// f · |cos θₒ| / density: what the path's throughput is multiplied by.
    pub ratio: Rgb,
    /// Density of `wo` per solid angle, or its probability if `discrete`.
    pub density: f32,
    /// The same the other way: of `wi`, given `wo`. If `discrete`, the probability times the relative size of the solid
    /// angles that the two directions span, |cos θᵢ| / (|cos θₒ| · `relative_ior`²), so that ratios of the two are those of
    /// densities.
    pub reverse: f32,
    /// Whether the direction is one of a few that the material can scatter into.
    pub discrete: bool,
    /// Index of refraction of the side the path goes on into, relative to the side it came from; 1 for reflection.
    pub relative_ior: f32,
}

impl Scattered {
    /// Nothing where rounding to `f32` left a direction in the surface itself, or no density.
    #[inline]
    pub(super) fn if_representable(self) -> Option<Self> {
        (self.wo.z != 0.0 && self.density > 0.0 && self.density.is_finite()).then_some(self)
    }
}

/// A material's value for a pair of directions, with the densities of sampling it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated {
    /// f · |cos θₒ|, per steradian.
    pub value: Rgb,
    /// Density of `wo` per solid angle, given `wi`.
    pub density: f32,
    /// Density of `wi` per solid angle, given `wo`.
    pub reverse: f32,
}

impl Evaluated {
    /// Nothing is scattered from one direction to the other.
    pub const ZERO: Self = Self {
        value: Rgb::BLACK,
        density: 0.0,
        reverse: 0.0,
    };
}

/// A material model. Its lobes are discrete, or have a density, or some are one and some the other.
pub trait Model: Copy + Debug + Send + Sync + 'static {
    /// Which.
    const KIND: MaterialKind;

    /// Draws the direction in which a path that came from `wi` goes on; `None` where it is absorbed.
    #[must_use]
    fn sample(&self, at: &Shading<'_>, wi: Vec3, draw: ScatterDraw, transport: Transport) -> Option<Scattered>;

    /// What [`sample`](Self::sample) returns where it draws this discrete lobe; `None` where it never does.
    #[must_use]
    fn discrete(&self, at: &Shading<'_>, wi: Vec3, lobe: DiscreteLobe, transport: Transport) -> Option<Scattered> {
        let _ = (at, wi, lobe, transport);
        None
    }

    /// Value and densities for a pair of directions: of all lobes that have a density. Zero for models that have none.
    #[must_use]
    fn evaluate(&self, at: &Shading<'_>, wi: Vec3, wo: Vec3, transport: Transport) -> Evaluated {
        let _ = (at, wi, wo, transport);
        Evaluated::ZERO
    }
}
