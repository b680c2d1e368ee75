//! What is drawn of lights: a light as seen from a point, and light on its way into the scene, with densities.

use crate::color::Rgb;
use glam::Vec3;

/// Light that may reach a reference point, before anything in between is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit direction from the reference point to the light.
    pub direction: Vec3,
    /// Where on the light, moved off its surface: the far end of the segment to trace. For a light at infinity a point
    /// in its direction, outside the scene.
    pub target: Vec3,
    /// What makes `f · |cos| · radiance / density` the estimate of the light: the radiance towards the reference point,
    /// W sr⁻¹ m⁻²; for discrete lights the irradiance on a plane that faces the light, W m⁻².
    pub radiance: Rgb,
    /// Density of the direction per solid angle, the choice of the light included; for discrete lights the probability of
    /// the choice.
    pub density: f32,
    /// The light's number.
    pub light: u32,
    /// Position on the light, world space. For a light at infinity the same as `target`.
    pub position: Vec3,
    /// Unit geometric normal of the light's surface. Where there is none, the direction in which the light travels.
    pub normal: Vec3,
    /// Whether the light is in so few places or directions that no path meets it by chance: it takes no share with
    /// scattering, its weight is 1.
    pub discrete: bool,
}

/// What kind of vertex a path has on a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Endpoint {
    /// A point of a surface.
    Surface,
    /// A point that all light comes from: it has no normal, and no cosine counts there.
    Point,
    /// A direction: its light comes in parallel from outside the scene.
    Infinite,
}

/// Light on its way into the scene: the first ray of a path that starts on a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitted {
    /// The light's number.
    pub light: u32,
    /// What the path starts on.
    pub endpoint: Endpoint,
    /// Start of the ray: off the light's surface, or on a disc outside the scene that faces `direction`.
    pub origin: Vec3,
    /// Position on the light, world space; for a light at infinity the same as `origin`.
    pub position: Vec3,
    /// Unit geometric normal of the light's surface. Where there is none, `direction`, so that the cosine to it is 1.
    pub normal: Vec3,
    /// Unit direction in which the light travels.
    pub direction: Vec3,
    /// Radiance times |cos θ| over all densities, the choice of the light included: its mean over all that is drawn is the
    /// power of the lights in W.
    pub ratio: Rgb,
    /// The densities with which it was drawn.
    pub densities: EmissionDensities,
}

/// Densities with which light is sent into the scene. Both are 0 for what is never sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmissionDensities {
    /// Density of the path's first vertex, the choice of the light included: per unit area of a surface; per unit solid
    /// angle for a light at infinity; the probability of the choice for a point or a single direction.
    pub position: f32,
    /// Density of the ray, given that vertex: per unit solid angle of its direction; for a light at infinity per unit area
    /// of the disc that faces it.
    pub direction: f32,
}

impl EmissionDensities {
    /// Of what is never sent.
    pub const ZERO: Self = Self {
        position: 0.0,
        direction: 0.0,
    };

    /// Whether what was drawn with these can be divided by them.
    pub(super) fn are_usable(self) -> bool {
        let usable = |density: f32| density > 0.0 && density.is_finite();
        usable(self.position) && usable(self.direction)
    }
}
