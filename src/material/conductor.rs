//! `Conductor`: a smooth metal: a mirror whose reflectance follows Fresnel's equations for a complex index.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `metal` | a metal by its symbol, such as `"Au"` ([`METALS`](super::metals::METALS)) | | this, or both of the next |
//! | `eta` | real part of the index of refraction | none, [0, 1000] per channel | |
//! | `k` | absorption coefficient | none, [0, 1000] per channel | |
//! | `reflectance` | scale of the reflection, a colour or a texture | none, [0, 1] per channel | 1 |
//! | `two_sided` | whether the back reflects like the front | | true |
//!
//! Use it for polished metal and, with `eta` 0 and `k` 1, for an ideal mirror. It is discrete: light through it can only
//! be found by following the mirrored direction, so what a mirror throws onto a matt surface (a caustic) is noisy under
//! path tracing unless the light is large. Do not use it for metal with the least blur or brushing (`RoughConductor`), nor for
//! a mirror image over a colour (`Plastic`). Reflectance is that of Fresnel's equations for light without polarisation (Born
//! and Wolf 1999, §14.2).

use super::{DiscreteLobe, MaterialKind, Model, ScatterDraw, Scattered, Transport, fresnel};
use crate::color::Rgb;
use crate::texture::{Color, Shading};
use glam::Vec3;

/// One smooth metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Real part of the index of refraction, per channel.
    pub eta: Rgb,
    /// Absorption coefficient, per channel.
    pub k: Rgb,
    /// Scale of the reflection, per channel.
    pub reflectance: Color,
    /// Whether the back reflects like the front.
    pub two_sided: bool,
}

impl Model for Conductor {
    const KIND: MaterialKind = MaterialKind::Conductor;

    /// The mirrored direction; `None` on the black back of a one-sided surface.
    #[inline]
    fn sample(&self, at: &Shading<'_>, wi: Vec3, _: ScatterDraw, transport: Transport) -> Option<Scattered> {
        self.discrete(at, wi, DiscreteLobe::Reflection, transport)
    }

    #[inline]
    fn discrete(&self, at: &Shading<'_>, wi: Vec3, lobe: DiscreteLobe, _: Transport) -> Option<Scattered> {
        if lobe == DiscreteLobe::Refraction || wi.z == 0.0 || (wi.z < 0.0 && !self.two_sided) {
            return None;
        }
        let reflected = fresnel::conductor_rgb(wi.z.abs(), self.eta, self.k);
        Some(Scattered {
            wo: Vec3::new(-wi.x, -wi.y, wi.z),
            ratio: self.reflectance.at(at) * reflected,
            density: 1.0,
            reverse: 1.0,
            discrete: true,
            relative_ior: 1.0,
        })
    }
}
