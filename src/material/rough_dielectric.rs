//! `RoughDielectric`: a rough interface between two clear media, such as ground glass: reflects and refracts, blurred.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `interior_ior` | index of refraction behind the surface | none, [0.1, 10] | required |
//! | `exterior_ior` | index of refraction in front of it, where the geometric normal points | none, [0.1, 10] | 1 |
//! | `distribution` | of the facets' slopes: `Ggx` (long tails) or `Beckmann` | | `Ggx` |
//! | `alpha` | roughness in all directions | none, [1e-4, 1] | this, or both of the next |
//! | `alpha_u`, `alpha_v` | roughness along and across the direction in which the texture coordinate u grows | none, [1e-4, 1] | |
//! | `reflectance` | scale of the reflection | none, [0, 1] per channel | 1 |
//! | `transmittance` | scale of the refraction | none, [0, 1] per channel | 1 |
//!
//! Use it on closed shapes: frosted glass, ice. Unlike `Dielectric` it has a density, so that lights can be sampled through
//! it: a slightly rough glass is often an easier scene than a smooth one. Do not use it for clear glass: below 1e-4 take
//! `Dielectric`. Light that meets a second facet is lost (see [`microfacet`](super::microfacet)).
//!
//! Each facet is a smooth interface (Walter et al. 2007, eq. 20 and 21; radiance scaled by the squared ratio of indices as
//! it crosses). A facet is drawn among those seen, and the lobe number chooses between reflection and refraction by the
//! facet's own reflectance. Between equal indices nothing is there: light passes straight through, and scenes have a smooth `Dielectric` instead.
//! Between nearly equal ones refraction is as narrow as roughness times the difference, maybe narrower than directions are
//! rounded. What is drawn is exact all the same: its density and ratio come from the facet's normal, and not from the
//! half vector, which is the direction of a tiny difference.

use super::microfacet::{Microfacets, above, outward};
use super::{Evaluated, MaterialKind, Model, ScatterDraw, Scattered, Transport, fresnel};
use crate::color::Rgb;
use crate::texture::Shading;
use glam::{DVec3, Vec3};

/// One rough interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric {
    /// The facets.
    pub microfacets: Microfacets,
    /// Interior over exterior index of refraction.
    pub relative_ior: f32,
    /// Scale of the reflection, per channel.
    pub reflectance: Rgb,
    /// Scale of the refraction, per channel.
    pub transmittance: Rgb,
}

/// Facets of one normal that refract between two directions.
struct Refracted {
    density: f64,
    reverse: f64,
    ratio: f64,
}

impl RoughDielectric {
    /// Refraction by facets of the normal `h`: `passed` is the share that they do not reflect, `length` that of
    /// wi + index · wo, which is along `h`. The Jacobian is that of Walter et al. (2007, eq. 17).
    #[inline]
    fn refracted(&self, [i, o, h]: [DVec3; 3], index: f64, passed: f64, length: f64) -> Refracted {
        let common = passed * self.microfacets.density(h) * (i.dot(h) * o.dot(h)).abs() / (length * length);
        let o = DVec3::new(o.x, o.y, -o.z);
        let area = self.microfacets.projected_area(o);
        Refracted {
            density: common * index * index / self.microfacets.projected_area(i),
            reverse: common / area,
            ratio: o.z / area,
        }
    }

    /// Index of the far side over that of the near side; the two are reciprocal beyond `f32`, and so are values.
    #[inline]
    fn index(&self, over: bool) -> f64 {
        let index = f64::from(self.relative_ior);
        if over { 1.0 / index } else { index }
    }

    /// Light between equal indices.
    fn straight_through(&self, wi: Vec3) -> Scattered {
        Scattered {
            wo: -wi,
            ratio: self.transmittance,
            density: 1.0,
            reverse: 1.0,
            discrete: true,
            relative_ior: 1.0,
        }
    }
}

/// What refraction does to radiance, and not to power.
#[inline]
fn radiance_scale(index: f64, transport: Transport) -> f64 {
    match transport {
        Transport::Radiance => 1.0 / (index * index),
        Transport::Importance => 1.0,
    }
}

impl Model for RoughDielectric {
    const KIND: MaterialKind = MaterialKind::RoughDielectric;

    /// `None` where facets send light into other facets, and exactly at grazing incidence.
    #[inline(never)]
    fn sample(&self, _: &Shading<'_>, wi: Vec3, draw: ScatterDraw, transport: Transport) -> Option<Scattered> {
        if wi.z == 0.0 {
            return None;
        }
        if self.relative_ior == 1.0 {
            return Some(self.straight_through(wi));
        }
        let over = wi.z < 0.0;
        let (i, index) = (above(wi, over), self.index(over));
        let h = self.microfacets.sample_visible(i, draw.direction);
        let cosine = i.dot(h);
        if cosine <= 0.0 {
            return None;
        }
        let (reflectance, cos_transmitted) = fresnel::dielectric_exact(cosine, index);
        if f64::from(draw.lobe) < reflectance {
            let o = Microfacets::reflect(i, h);
            if o.z <= 0.0 {
                return None;
            }
            let mirrored = self.microfacets.mirrored(i, o, h);
            return Scattered {
                wo: outward(o, over),
                ratio: self.reflectance * mirrored.ratio as f32,
                density: (reflectance * mirrored.density) as f32,
                reverse: (reflectance * mirrored.reverse) as f32,
                discrete: false,
                relative_ior: 1.0,
            }
            .if_representable();
        }
        // cos/n − cos_t as a quotient without the difference: all that bends light between nearly equal indices.
        let bend = (1.0 - 1.0 / (index * index)) / (cosine / index + cos_transmitted);
        let o = -(i / index) - h * bend;
        if o.z >= 0.0 {
            return None;
        }
        let refracted = self.refracted([i, o, h], index, 1.0 - reflectance, index * bend);
        Scattered {
            wo: outward(o, over),
            ratio: self.transmittance * (refracted.ratio * radiance_scale(index, transport)) as f32,
            density: refracted.density as f32,
            reverse: refracted.reverse as f32,
            discrete: false,
            relative_ior: index as f32,
        }
        .if_representable()
    }

    #[inline(never)]
    fn evaluate(&self, _: &Shading<'_>, wi: Vec3, wo: Vec3, transport: Transport) -> Evaluated {
        if wi.z == 0.0 || wo.z == 0.0 || self.relative_ior == 1.0 {
            return Evaluated::ZERO;
        }
        let over = wi.z < 0.0;
        let (i, o, index) = (above(wi, over), above(wo, over), self.index(over));
        if o.z > 0.0 {
            let h = (i + o).normalize();
            let (reflectance, _) = fresnel::dielectric_exact(i.dot(h), index);
            let mirrored = self.microfacets.mirrored(i, o, h);
            return Evaluated {
                value: self.reflectance * (reflectance * mirrored.density * mirrored.ratio) as f32,
                density: (reflectance * mirrored.density) as f32,
                reverse: (reflectance * mirrored.reverse) as f32,
            };
        }
        let sum = i + o * index;
        let length = sum.length();
        if sum.z == 0.0 {
            return Evaluated::ZERO;
        }
        let h = sum / length.copysign(sum.z);
        let (cosine, behind) = (i.dot(h), o.dot(h));
        if cosine <= 0.0 || behind >= 0.0 {
            return Evaluated::ZERO;
        }
        let passed = 1.0 - fresnel::dielectric_between(cosine, -behind, index);
        let refracted = self.refracted([i, o, h], index, passed, length);
        let value = refracted.density * refracted.ratio * radiance_scale(index, transport);
        Evaluated {
            value: self.transmittance * value as f32,
            density: refracted.density as f32,
            reverse: refracted.reverse as f32,
        }
    }
}
