//! `Dielectric`: a smooth interface between two clear media, such as glass in air: reflects and refracts.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `interior_ior` | index of refraction behind the surface | none, [0.1, 10] | required |
//! | `exterior_ior` | index of refraction in front of it, where the geometric normal points | none, [0.1, 10] | 1 |
//! | `reflectance` | scale of the reflection | none, [0, 1] per channel | 1 |
//! | `transmittance` | scale of the refraction | none, [0, 1] per channel | 1 |
//!
//! Use it on closed shapes: glass, water, gems; a single sheet of it is an interface, not a pane. It is discrete, and a
//! caustic behind it is found by path tracing only where a path happens to meet the light. Radiance is scaled by the
//! squared ratio of indices as it crosses (Veach 1997, §5.2); on the way out again the scale returns. An interface
//! between equal indices reflects nothing and bends nothing; if it also lets all light pass, it is left out of the scene, and
//! crossings of it count for no edge of a path. Do not use it for a window of one sheet, which would be solid glass to its
//! other side, for frosted glass (`RoughDielectric`), nor for what absorbs light along its way: glass as deep as it is wide has no
//! colour here but that of its surface. Reflectance is that of Fresnel's equations for light without polarisation (Born and
//! Wolf 1999, §1.5.2).

use super::fresnel::{self, DielectricFresnel};
use super::{DiscreteLobe, MaterialKind, Model, ScatterDraw, Scattered, Transport};
use crate::color::Rgb;
use crate::texture::Shading;
use glam::Vec3;

/// One smooth interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Interior over exterior index of refraction.
    pub relative_ior: f32,
    /// Scale of the reflection, per channel.
    pub reflectance: Rgb,
    /// Scale of the refraction, per channel.
    pub transmittance: Rgb,
}

impl Model for Dielectric {
    const KIND: MaterialKind = MaterialKind::Dielectric;

    /// Reflects or refracts, each with its share of the power; the first number of the direction decides. `None` exactly at
    /// grazing incidence.
    #[inline]
    fn sample(&self, _: &Shading<'_>, wi: Vec3, draw: ScatterDraw, transport: Transport) -> Option<Scattered> {
        let side = self.side(wi)?;
        Some(if draw.direction[0] < side.fresnel.reflectance {
            self.reflect(wi, &side)
        } else {
            self.refract(wi, &side, transport)
        })
    }

    #[inline]
    fn discrete(&self, _: &Shading<'_>, wi: Vec3, lobe: DiscreteLobe, transport: Transport) -> Option<Scattered> {
        let side = self.side(wi)?;
        match lobe {
            DiscreteLobe::Reflection => (side.fresnel.reflectance > 0.0).then(|| self.reflect(wi, &side)),
            DiscreteLobe::Refraction => (side.fresnel.reflectance < 1.0).then(|| self.refract(wi, &side, transport)),
        }
    }
}

/// The interface as a path meets it.
struct Side {
    /// Index of the side beyond over that of the side where the path comes from.
    relative_ior: f32,
    fresnel: DielectricFresnel,
}

impl Dielectric {
    /// `None` exactly at grazing incidence.
    #[inline]
    fn side(&self, wi: Vec3) -> Option<Side> {
        let relative_ior = if wi.z > 0.0 {
            self.relative_ior
        } else {
            1.0 / self.relative_ior
        };
        (wi.z != 0.0).then(|| Side {
            relative_ior,
            fresnel: fresnel::dielectric(wi.z.abs(), relative_ior),
        })
    }

    #[inline]
    fn reflect(&self, wi: Vec3, side: &Side) -> Scattered {
        Scattered {
            wo: Vec3::new(-wi.x, -wi.y, wi.z),
            ratio: self.reflectance,
            density: side.fresnel.reflectance,
            reverse: side.fresnel.reflectance,
            discrete: true,
            relative_ior: 1.0,
        }
    }

    #[inline]
    fn refract(&self, wi: Vec3, side: &Side, transport: Transport) -> Scattered {
        let inverse = 1.0 / side.relative_ior;
        let wo = Vec3::new(
            -wi.x * inverse,
            -wi.y * inverse,
            side.fresnel.cos_transmitted.copysign(-wi.z),
        );
        let probability = 1.0 - side.fresnel.reflectance;
        let scale = match transport {
            // Radiance spreads over a larger or smaller solid angle.
            Transport::Radiance => inverse * inverse,
            Transport::Importance => 1.0,
        };
        Scattered {
            wo: wo.normalize(),
            ratio: self.transmittance * scale,
            density: probability,
            reverse: probability * (wi.z.abs() / side.fresnel.cos_transmitted) * (inverse * inverse),
            discrete: true,
            relative_ior: side.relative_ior,
        }
    }
}
