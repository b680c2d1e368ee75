//! A surface point on a path: connecting it to a sampled light (next-event estimation), and scattering off it.

use super::draws::LightDraw;
use super::mis;
use crate::color::Rgb;
use crate::geometry::offset_origin;
use crate::material::{Frame, Scattered, Transport};
use crate::scene::Scene;
use glam::{Vec2, Vec3};

/// A surface point that scatters, as its path sees it.
#[derive(Clone, Copy, Debug)]
pub struct Scatterer {
    /// World-space position.
    pub position: Vec3,
    /// Unit geometric normal.
    pub normal: Vec3,
    /// Unit shading normal.
    pub shading_normal: Vec3,
    /// Offset of rays, see [`offset_origin`].
    pub offset: f32,
    /// Material number.
    pub material: u32,
    /// Texture coordinates; zero where the plan keeps none.
    pub uv: Vec2,
    /// Unit tangent, orthogonal to the shading normal; zero where the plan keeps none, and any will do.
    pub tangent: Vec3,
    /// Unit direction in which the path arrived.
    pub direction: Vec3,
}

/// A connection to a light: what it brings if nothing is in the way, and the segment to look along.
#[derive(Clone, Copy, Debug)]
pub struct Connection {
    /// f · |cos| · radiance / density, weighted against meeting the light by scattering.
    pub value: Rgb,
    /// The segment's start, off the surface.
    pub origin: Vec3,
    /// The segment's end, off the light.
    pub target: Vec3,
}

impl Scatterer {
    /// Whether light that arrives against `outgoing` crosses the surface as the material says. With shading normals a
    /// direction can be above the shading surface and below the real one: such light leaks (Veach 1997, §5.3.2).
    #[inline]
    #[must_use]
    pub fn sides_agree(&self, outgoing: Vec3) -> bool {
        let shading = self.shading_normal.dot(outgoing) * self.shading_normal.dot(self.direction);
        let geometric = self.normal.dot(outgoing) * self.normal.dot(self.direction);
        shading * geometric > 0.0
    }

    /// The local frame of materials.
    #[inline]
    #[must_use]
    pub fn frame(&self) -> Frame {
        if self.tangent == Vec3::ZERO {
            Frame::new(self.shading_normal)
        } else {
            Frame::with_tangent(self.shading_normal, self.tangent)
        }
    }

    /// Scatters the path: `sample` draws in the local frame, given the local direction back along the path. The world
    /// direction in which the path goes on, and what was drawn; `None` if the path ends here.
    #[inline]
    #[must_use]
    pub fn scatter(&self, sample: impl FnOnce(Vec3) -> Option<Scattered>) -> Option<(Vec3, Scattered)> {
        let frame = self.frame();
        let outcome = sample(frame.to_local(-self.direction))?;
        let direction = frame.to_world(outcome.wo).normalize();
        // Reflection stays on its side and refraction crosses, on the shading surface as on the real one.
        (self.sides_agree(direction) && !outcome.ratio.is_black()).then_some((direction, outcome))
    }

    /// Samples a light for this point. `None` if no light can reach it that way.
    #[inline]
    #[must_use]
    pub fn connect(&self, scene: &Scene, draw: LightDraw) -> Option<Connection> {
        let light = scene.lights.sample(self.position, draw.choice, draw.point)?;
        if !self.sides_agree(light.direction) {
            return None;
        }
        let frame = self.frame();
        let (wi, wo) = (frame.to_local(-self.direction), frame.to_local(light.direction));
        let scattering = scene
            .materials
            .evaluate(self.material, self.uv, wi, wo, Transport::Radiance);
        if scattering.value.is_black() {
            return None;
        }
        // What scattering never meets is found here alone.
        let rival = if light.discrete { 0.0 } else { scattering.density };
        let weight = mis::power_heuristic(light.density, rival);
        Some(Connection {
            value: scattering.value * light.radiance * (weight / light.density),
            origin: offset_origin(self.position, self.normal, self.offset, light.direction),
            target: light.target,
        })
    }
}
