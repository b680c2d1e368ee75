//! `Diffuse`: a perfectly matt surface (Lambert 1760): the same radiance in every direction of its side.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `reflectance` | share of light that is reflected, a colour or a texture | none, [0, 1] per channel | required |
//! | `two_sided` | whether the back reflects like the front | | true |
//!
//! Use it for plaster, paper, unpolished stone. Do not use it for anything with a highlight, however faint, if that
//! highlight matters: no mixture of diffuse surfaces makes one. f = ρ/π; directions are drawn in proportion to the
//! cosine, so that the throughput ratio is ρ itself and no noise comes from the material.

use super::{Evaluated, MaterialKind, Model, ScatterDraw, Scattered, Transport};
use crate::sampling::warp;
use crate::texture::{Color, Shading};
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// One diffuse material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    /// Share of light that is reflected, per channel.
    pub reflectance: Color,
    /// Whether the back reflects like the front.
    pub two_sided: bool,
}

impl Model for Diffuse {
    const KIND: MaterialKind = MaterialKind::Diffuse;

    /// `None` on the black back of a one-sided surface.
    #[inline(always)]
    fn sample(&self, at: &Shading<'_>, wi: Vec3, draw: ScatterDraw, _: Transport) -> Option<Scattered> {
        if wi.z == 0.0 || (wi.z < 0.0 && !self.two_sided) {
            return None;
        }
        let mut wo = warp::cosine_hemisphere(draw.direction);
        let density = warp::cosine_hemisphere_density(wo.z);
        if density == 0.0 {
            return None;
        }
        wo.z = wo.z.copysign(wi.z);
        Some(Scattered {
            wo,
            ratio: self.reflectance.at(at),
            density,
            reverse: warp::cosine_hemisphere_density(wi.z.abs()),
            discrete: false,
            relative_ior: 1.0,
        })
    }

    #[inline(always)]
    fn evaluate(&self, at: &Shading<'_>, wi: Vec3, wo: Vec3, _: Transport) -> Evaluated {
        if wi.z * wo.z <= 0.0 || (wi.z < 0.0 && !self.two_sided) {
            return Evaluated::ZERO;
        }
        let cosine = wo.z.abs();
        Evaluated {
            value: self.reflectance.at(at) * (FRAC_1_PI * cosine),
            density: warp::cosine_hemisphere_density(cosine),
            reverse: warp::cosine_hemisphere_density(wi.z.abs()),
        }
    }
}
