//! All emitters of a scene.

use super::{sphere, triangle};
use crate::color::Rgb;
use crate::geometry::{offset_distance, offset_origin};
use crate::sampling::discrete::Discrete;
use glam::Vec3;
use std::f64::consts::PI;

/// A primitive that emits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    /// Its shape in world space.
    pub shape: EmitterShape,
    /// Emitted radiance, W sr⁻¹ m⁻² per channel.
    pub radiance: Rgb,
    /// Area in squared scene units.
    pub area: f32,
}

/// The shape of an emitter, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EmitterShape {
    /// A triangle by its corners.
    Triangle([Vec3; 3]),
    /// A sphere.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
    },
}

/// Light that may reach a reference point, before anything in between is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit direction from the reference point to the light.
    pub direction: Vec3,
    /// Where on the light, moved off its surface: the far end of the segment to trace.
    pub target: Vec3,
    /// Radiance towards the reference point, W sr⁻¹ m⁻².
    pub radiance: Rgb,
    /// Density of the direction per solid angle, the choice of the light included.
    pub density: f32,
}

/// Emitters by number, and the distribution over them.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    emitters: Vec<Emitter>,
    /// Unit geometric normals of triangles; spheres have one per point.
    normals: Vec<Vec3>,
    /// In proportion to power.
    choice: Discrete,
}

impl LightTable {
    /// A table of emitters, chosen in proportion to π · area · mean radiance.
    #[must_use]
    pub fn new(emitters: Vec<Emitter>) -> Self {
        let power = |e: &Emitter| PI * f64::from(e.area) * f64::from(e.radiance.mean());
        let choice = Discrete::new(emitters.iter().map(power));
        let normal = |emitter: &Emitter| match emitter.shape {
            EmitterShape::Triangle(corners) => triangle::normal(corners),
            EmitterShape::Sphere { .. } => Vec3::ZERO,
        };
        let normals = emitters.iter().map(normal).collect();
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

    /// Chooses a light with `choice` and a point on it with `u`, as seen from `from`. `None` if no light reaches
    /// `from` from there: its back, its edge, or the reference point inside it.
    #[inline]
    #[must_use]
    pub fn sample(&self, from: Vec3, choice: f64, u: [f32; 2]) -> Option<LightSample> {
        let number = self.choice.sample(choice)?;
        let emitter = &self.emitters[number];
        let point = match emitter.shape {
            EmitterShape::Triangle(corners) => triangle::sample(corners, self.normals[number], emitter.area, from, u)?,
            EmitterShape::Sphere { center, radius } => sphere::sample(center, radius, from, u)?,
        };
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
        })
    }

    /// The density, per solid angle at `from`, with which [`sample`](Self::sample) finds the point `position` with the
    /// unit geometric normal `normal` on emitter `light`.
    #[inline]
    #[must_use]
    pub fn density(&self, light: u32, from: Vec3, position: Vec3, normal: Vec3) -> f32 {
        let number = light as usize;
        let emitter = &self.emitters[number];
        let density = match emitter.shape {
            EmitterShape::Triangle(_) => triangle::density(emitter.area, from, position, normal),
            EmitterShape::Sphere { center, radius } => sphere::density(center, radius, from),
        };
        self.choice.probability(number) * density
    }

    /// Radiance that emitter `light` sends from a point with geometric normal `normal` along the unit direction
    /// `towards`.
    #[inline]
    #[must_use]
    pub fn radiance(&self, light: u32, normal: Vec3, towards: Vec3) -> Rgb {
        if normal.dot(towards) > 0.0 {
            self.emitters[light as usize].radiance
        } else {
            Rgb::BLACK
        }
    }
}
