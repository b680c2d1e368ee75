//! A vertex of a whole path, and how light passes it.

use crate::material::{DiscreteLobe, Transport};
use crate::path::measure::Site;
use crate::path::{Scatterer, VERTEX_DISCRETE};
use crate::scene::Scene;
use glam::Vec3;

/// A vertex of a whole path.
#[derive(Clone, Copy, Debug)]
pub struct WholeVertex {
    /// Its surface; of ends, position and normal alone count. Its direction is that in which a path from the camera arrives, as the
    /// ray went that found this vertex or the one before it, whichever end it came from.
    pub surface: Scatterer,
    /// Its kind: [`VERTEX_DISCRETE`] where this path goes through it by a discrete lobe.
    pub kind: u32,
}

/// How light passes a vertex, as a path from the camera does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// f · |cos| over the density, per channel: the path's throughput is multiplied by it.
    pub ratio: [f64; 3],
    /// Density of going on towards the light, per solid angle; a probability if it is discrete.
    pub onward: f32,
    /// The same towards the camera, see [`Scattered::reverse`](crate::material::Scattered::reverse).
    pub back: f32,
}

impl Passage {
    /// Through an end of the path, where nothing is scattered.
    pub const END: Self = Self {
        ratio: [1.0; 3],
        onward: 0.0,
        back: 0.0,
    };
}

impl WholeVertex {
    /// Where it is.
    #[inline]
    #[must_use]
    pub const fn site(&self) -> Site {
        Site {
            kind: self.kind,
            position: self.surface.position,
            normal: self.surface.normal,
        }
    }

    /// How light passes an inner vertex from which the path goes on in the unit direction `outgoing`; `None` where none does.
    #[must_use]
    pub fn passage(&self, scene: &Scene, outgoing: Vec3) -> Option<Passage> {
        let surface = &self.surface;
        if self.kind != VERTEX_DISCRETE {
            let found = surface.evaluate(scene, outgoing, Transport::Radiance)?;
            let inverse = 1.0 / f64::from(found.density);
            return Some(Passage {
                ratio: found.value.to_array().map(|value| f64::from(value) * inverse),
                onward: found.density,
                back: found.reverse,
            });
        }
        if !surface.sides_agree(outgoing) {
            return None;
        }
        let wi = surface.frame().to_local(-surface.direction);
        let lobe = self.lobe(outgoing);
        let found = scene
            .materials
            .discrete(surface.material, surface.uv, wi, lobe, Transport::Radiance)?;
        Some(Passage {
            ratio: found.ratio.to_array().map(f64::from),
            onward: found.density,
            back: found.reverse,
        })
    }

    /// The probability that a subpath from the camera which arrives here is scattered into no discrete lobe.
    #[must_use]
    pub fn stopping(&self, scene: &Scene) -> f64 {
        let surface = &self.surface;
        if !scene.materials.kind(surface.material).has_discrete_lobe() {
            return 1.0;
        }
        let going = [DiscreteLobe::Reflection, DiscreteLobe::Refraction].map(|lobe| {
            let (materials, transport) = (&scene.materials, Transport::Radiance);
            let scatter = |wi| materials.discrete(surface.material, surface.uv, wi, lobe, transport);
            let found = surface.scatter(transport, scatter);
            found.map_or(0.0, |(_, outcome)| f64::from(outcome.density))
        });
        (1.0 - going[0] - going[1]).max(0.0)
    }

    /// The discrete lobe by which a path goes on in the direction `outgoing`.
    #[must_use]
    pub fn lobe(&self, outgoing: Vec3) -> DiscreteLobe {
        let normal = self.surface.normal;
        if (normal.dot(outgoing) > 0.0) == (normal.dot(self.surface.direction) < 0.0) {
            DiscreteLobe::Reflection
        } else {
            DiscreteLobe::Refraction
        }
    }
}
