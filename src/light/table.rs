//! All lights of a scene.

use super::{EmissionDensities, Emitted, Emitter, Endpoint, LightSample};
use crate::color::Rgb;
use crate::geometry::{offset_distance, offset_origin};
use crate::material::Frame;
use crate::sampling::discrete::Discrete;
use crate::sampling::warp;
use glam::Vec3;
use std::f32::consts::PI;

/// Emitters by number, and the distribution over them.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    emitters: Vec<Emitter>,
    /// Unit geometric normals of triangles and disks; the others have one per point.
    normals: Vec<Vec3>,
    /// In proportion to power.
    choice: Discrete,
}

impl LightTable {
    /// A table of emitters, chosen in proportion to π · area · mean radiance.
    #[must_use]
    pub fn new(emitters: Vec<Emitter>) -> Self {
        let choice = Discrete::new(emitters.iter().map(Emitter::power));
        let normals = emitters.iter().map(Emitter::flat_normal).collect();
        Self {
            emitters,
            normals,
            choice,
        }
    }

    /// Number of emitters.
    #[must_use]
    pub fn len(&self) -> usize {
        self.emitters.len()
    }

    /// Whether nothing emits.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.choice.is_empty()
    }

    /// The largest emitted radiance of any channel, 0 if nothing emits.
    #[must_use]
    pub fn max_radiance(&self) -> f32 {
        self.emitters
            .iter()
            .map(|e| e.radiance.max_channel())
            .fold(0.0, f32::max)
    }

    /// What kind of vertex a path has on the light.
    #[inline]
    #[must_use]
    pub fn endpoint(&self, _light: u32) -> Endpoint {
        Endpoint::Surface
    }

    /// Whether no path meets the light by chance: a point, or a single direction.
    #[inline]
    #[must_use]
    pub fn is_delta(&self, _light: u32) -> bool {
        false
    }

    /// The lights that rays meet which leave the scene. They overlap: each has a radiance in every direction.
    pub fn infinite(&self) -> impl Iterator<Item = u32> {
        std::iter::empty()
    }

    /// Chooses a light with `choice` and a point on it with `u`, as seen from `from`. `None` if no light reaches
    /// `from` from there: its back, its edge, or the reference point inside it.
    #[inline]
    #[must_use]
    pub fn sample(&self, from: Vec3, choice: f64, u: [f32; 2]) -> Option<LightSample> {
        let number = self.choice.sample(choice)?;
        let emitter = &self.emitters[number];
        let point = emitter.sample(self.normals[number], from, u)?;
        let density = self.choice.probability(number) * point.density;
        // The product of two tiny numbers can vanish; what was drawn must be divisible by its density.
        if density == 0.0 {
            return None;
        }
        let span = point.position - from;
        // The farther the light, the coarser the intersector's view of it, even in f64.
        let offset = offset_distance(point.position, point.normal, emitter.area.sqrt() + span.length());
        Some(LightSample {
            direction: span.normalize(),
            target: offset_origin(point.position, point.normal, offset, point.normal),
            radiance: emitter.radiance,
            density,
            light: number as u32,
            position: point.position,
            normal: point.normal,
            discrete: false,
        })
    }

    /// The density, per solid angle at `from`, with which [`sample`](Self::sample) finds the point `position` with the
    /// unit geometric normal `normal` on emitter `light`. For a light at infinity `position` does not matter, and `normal`
    /// is the direction in which the light travels. Zero for discrete lights.
    #[inline]
    #[must_use]
    pub fn density(&self, light: u32, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        let number = light as usize;
        self.choice.probability(number) * self.emitters[number].density(from, position, normal)
    }

    /// Radiance that emitter `light` sends from a point with geometric normal `normal` along the unit direction
    /// `towards`. For a light at infinity both are the direction in which the light travels.
    #[inline]
    #[must_use]
    pub fn radiance(&self, light: u32, normal: Vec3, towards: Vec3) -> Rgb {
        if normal.dot(towards) > 0.0 {
            self.emitters[light as usize].radiance
        } else {
            Rgb::BLACK
        }
    }

    /// Chooses a light with `choice`, where on it with `point`, and a direction with `direction`, and sends light into the
    /// scene. `None` where nothing leaves that way.
    #[inline]
    #[must_use]
    pub fn emit(&self, choice: f64, point: [f32; 2], direction: [f32; 2]) -> Option<Emitted> {
        let number = self.choice.sample(choice)?;
        let emitter = &self.emitters[number];
        let (position, normal) = emitter.point(self.normals[number], point);
        let local = warp::cosine_hemisphere(direction);
        let direction = Frame::new(normal).to_world(local).normalize();
        let light = number as u32;
        let densities = self.emission_densities(light, position, normal, direction);
        // The cosine over its density is π.
        let ratio = emitter.radiance * (PI / densities.position);
        if !densities.are_usable() || !ratio.is_finite() {
            return None;
        }
        let offset = offset_distance(position, normal, emitter.area.sqrt());
        Some(Emitted {
            light,
            endpoint: Endpoint::Surface,
            origin: offset_origin(position, normal, offset, direction),
            position,
            normal,
            direction,
            ratio,
            densities,
        })
    }

    /// The densities with which [`emit`](Self::emit) draws light that leaves `position` with the unit geometric normal
    /// `normal` on light `light` along the unit direction `towards`. For a light at infinity `position` does not matter;
    /// for discrete lights the densities are those of the place or direction where the light is.
    #[inline]
    #[must_use]
    pub fn emission_densities(&self, light: u32, _position: Vec3, normal: Vec3, towards: Vec3) -> EmissionDensities {
        let number = light as usize;
        EmissionDensities {
            position: self.choice.probability(number) / self.emitters[number].area,
            direction: warp::cosine_hemisphere_density(normal.dot(towards)),
        }
    }
}
