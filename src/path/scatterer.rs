//! A surface point on a path: connecting it to a sampled light (next-event estimation), and scattering off it.

use super::draws::LightDraw;
use super::mis::Heuristic;
use crate::color::Rgb;
use crate::geometry::offset_origin;
use crate::material::{Evaluated, Frame, Scattered, Transport};
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
    /// The light.
    pub light: u32,
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
    #[inline(always)]
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
    #[inline(always)]
    #[must_use]
    pub fn scatter(
        &self,
        transport: Transport,
        sample: impl FnOnce(Vec3) -> Option<Scattered>,
    ) -> Option<(Vec3, Scattered)> {
        let frame = self.frame();
        let mut outcome = sample(frame.to_local(-self.direction))?;
        let direction = frame.to_world(outcome.wo).normalize();
        // Reflection stays on its side and refraction crosses, on the shading surface as on the real one.
        if !self.sides_agree(direction) || outcome.ratio.is_black() {
            return None;
        }
        if transport == Transport::Importance {
            outcome.ratio = outcome.ratio * self.adjoint_correction(direction);
        }
        Some((direction, outcome))
    }

    /// Value and densities for a path that goes on in the unit direction `outgoing`; `None` where nothing is scattered that way.
    #[inline(always)]
    #[must_use]
    pub fn evaluate(&self, scene: &Scene, outgoing: Vec3, transport: Transport) -> Option<Evaluated> {
        if !self.sides_agree(outgoing) {
            return None;
        }
        let frame = self.frame();
        let (wi, wo) = (frame.to_local(-self.direction), frame.to_local(outgoing));
        let mut scattering = scene.materials.evaluate(self.material, self.uv, wi, wo, transport);
        if scattering.value.is_black() {
            return None;
        }
        if transport == Transport::Importance {
            scattering.value = scattering.value * self.adjoint_correction(outgoing);
        }
        Some(scattering)
    }

    /// What makes scattering of light that travels along the path the adjoint of that of paths from the camera, where shading
    /// normals are not the geometric ones: |ωᵢ·Nₛ| |ωₒ·N_g| / (|ωᵢ·N_g| |ωₒ·Nₛ|) (Veach 1997, §5.3, eq. 5.19).
    #[inline]
    #[must_use]
    pub fn adjoint_correction(&self, outgoing: Vec3) -> f32 {
        if self.normal == self.shading_normal {
            return 1.0;
        }
        let shading = self.shading_normal.dot(self.direction) * self.normal.dot(outgoing);
        let geometric = self.normal.dot(self.direction) * self.shading_normal.dot(outgoing);
        (shading / geometric).abs()
    }

    /// Where a segment or a ray starts that leaves in this direction.
    #[inline]
    #[must_use]
    pub fn leaving(&self, direction: Vec3) -> Vec3 {
        offset_origin(self.position, self.normal, self.offset, direction)
    }

    /// Samples a light for this point; weights are made as `heuristic` says. `None` if no light can reach it that way.
    #[inline(always)]
    #[must_use]
    pub fn connect(&self, scene: &Scene, draw: LightDraw, heuristic: Heuristic) -> Option<Connection> {
        let light = scene.lights.sample(self.position, draw.choice, draw.point)?;
        let scattering = self.evaluate(scene, light.direction, Transport::Radiance)?;
        let weight = if light.discrete {
            1.0
        } else {
            heuristic.share(light.density, scattering.density)
        };
        Some(Connection {
            value: scattering.value * light.radiance * (weight / light.density),
            origin: self.leaving(light.direction),
            target: light.target,
            light: light.light,
        })
    }
}
