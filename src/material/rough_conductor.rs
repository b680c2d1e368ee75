//! `RoughConductor`: a metal whose surface is rough: a blurred mirror.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `metal` | a metal by its symbol, such as `"Au"` ([`METALS`](super::metals::METALS)) | | this, or `eta` and `k` |
//! | `eta`, `k` | real part of the index of refraction, and absorption coefficient | none, [0, 1000] per channel | |
//! | `distribution` | of the facets' slopes: `Ggx` (long tails) or `Beckmann` | | `Ggx` |
//! | `alpha` | roughness in all directions | none, [1e-4, 1] | this, or both of the next |
//! | `alpha_u`, `alpha_v` | roughness along and across the direction in which the texture coordinate u grows | none, [1e-4, 1] | |
//! | `reflectance` | scale of the reflection, a colour or a texture | none, [0, 1] per channel | 1 |
//! | `two_sided` | whether the back reflects like the front | | true |
//!
//! Use it for all metal that is not polished: 0.05 is satin, 0.3 is sandblasted. `alpha_u` unlike `alpha_v` is brushed metal;
//! shapes without texture coordinates then brush it in a direction of their own. Do not use it for mirrors: below 1e-4 take
//! `Conductor`. Light that meets a second facet is lost, so that rough metals are too dark: hardly at the roughness
//! 0.2, by a third at 0.5, by two thirds at 1 (see [`microfacet`](super::microfacet)).
//!
//! f = F(h) D(h) G₁(i) G₁(o) / (4 cos θᵢ cos θₒ) with half vector h (Cook and Torrance 1982; Walter et al. 2007, eq. 20).
//! Directions are drawn through visible normals, so that the throughput ratio is F G₁(o).

use super::microfacet::{Microfacets, above, outward};
use super::{Evaluated, MaterialKind, Model, ScatterDraw, Scattered, Transport, fresnel};
use crate::color::Rgb;
use crate::texture::{Color, Shading};
use glam::Vec3;

/// One rough metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughConductor {
    /// The facets.
    pub microfacets: Microfacets,
    /// Real part of the index of refraction, per channel.
    pub eta: Rgb,
    /// Absorption coefficient, per channel.
    pub k: Rgb,
    /// Scale of the reflection, per channel.
    pub reflectance: Color,
    /// Whether the back reflects like the front.
    pub two_sided: bool,
}

impl RoughConductor {
    /// What facets reflect of light that meets them at an angle of this cosine.
    #[inline]
    fn reflected(&self, at: &Shading<'_>, cosine: f64) -> Rgb {
        self.reflectance.at(at) * fresnel::conductor_rgb(cosine as f32, self.eta, self.k)
    }
}

impl Model for RoughConductor {
    const KIND: MaterialKind = MaterialKind::RoughConductor;

    /// `None` where facets reflect into other facets, and on the black back of a one-sided surface.
    #[inline(never)]
    fn sample(&self, at: &Shading<'_>, wi: Vec3, draw: ScatterDraw, _: Transport) -> Option<Scattered> {
        if wi.z == 0.0 || (wi.z < 0.0 && !self.two_sided) {
            return None;
        }
        let i = above(wi, wi.z < 0.0);
        let h = self.microfacets.sample_visible(i, draw.direction);
        let o = Microfacets::reflect(i, h);
        if o.z <= 0.0 {
            return None;
        }
        let mirrored = self.microfacets.mirrored(i, o, h);
        Scattered {
            wo: outward(o, wi.z < 0.0),
            ratio: self.reflected(at, i.dot(h)) * mirrored.ratio as f32,
            density: mirrored.density as f32,
            reverse: mirrored.reverse as f32,
            discrete: false,
            relative_ior: 1.0,
        }
        .if_representable()
    }

    #[inline(never)]
    fn evaluate(&self, at: &Shading<'_>, wi: Vec3, wo: Vec3, _: Transport) -> Evaluated {
        let over = wi.z < 0.0;
        if wi.z == 0.0 || wo.z == 0.0 || over != (wo.z < 0.0) || (over && !self.two_sided) {
            return Evaluated::ZERO;
        }
        let (i, o) = (above(wi, over), above(wo, over));
        let h = (i + o).normalize();
        let mirrored = self.microfacets.mirrored(i, o, h);
        Evaluated {
            value: self.reflected(at, i.dot(h)) * (mirrored.density * mirrored.ratio) as f32,
            density: mirrored.density as f32,
            reverse: mirrored.reverse as f32,
        }
    }
}
