//! `Plastic`: a smooth clear coat over a matt base: a mirror image over a colour, as on billiard balls and varnish.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `interior_ior` | index of refraction of the coat | none, [0.1, 10] | 1.49 (acrylic glass) |
//! | `exterior_ior` | index of refraction of what is before it | none, [0.1, 10] | 1 |
//! | `diffuse_reflectance` | of the base, a colour or a texture | none, [0, 1] per channel | 0.5 |
//! | `specular_reflectance` | scale of the mirror image, a colour or a texture | none, [0, 1] per channel | 1 |
//! | `nonlinear` | whether light that the coat throws back onto the base is coloured each time | | false |
//! | `two_sided` | whether the back reflects like the front | | true |
//!
//! Use it for polished plastic, lacquer, glazed tiles, wet paint. `nonlinear` makes colours deeper, as real coats do; without
//! it a base keeps the colour that it has without coat. The image of a light in it is discrete and is only found by paths
//! that happen to follow it. Do not use it for coats with a blurred highlight (satin paint, most plastic that was not
//! polished), which it shows as mirrors, nor for metal under a lacquer: its base is matt.
//!
//! It is a matt base below a smooth interface (Wolff 1994), with all reflections between the two (Saunderson 1942).
//! Light enters through the coat, is scattered by the base, and is reflected back and forth between both before it leaves:
//! f = (1 − Fᵢ)(1 − Fₒ) ρ / (π n² (1 − ρ F̄)) with F̄ the share of diffuse light that the coat reflects inwards
//! ([`diffuse_reflectance`](super::fresnel::diffuse_reflectance)); ρ F̄ is F̄ unless `nonlinear`. With ρ = 1 nothing is lost.
//! The lobe number chooses between mirror and base, in proportion to what each reflects.

use super::{DiscreteLobe, Evaluated, MaterialKind, Model, ScatterDraw, Scattered, Transport, fresnel};
use crate::color::Rgb;
use crate::sampling::warp;
use crate::texture::{Color, Shading};
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// One coated surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    /// Index of the coat over that before it.
    relative_ior: f64,
    /// Share of diffuse light below the coat that it reflects.
    internal: f32,
    /// Of the base, per channel.
    diffuse_reflectance: Color,
    /// Scale of the mirror image, per channel.
    specular_reflectance: Color,
    nonlinear: bool,
    two_sided: bool,
}

/// The two lobes as seen from one direction.
struct Lobes {
    /// Share that the coat reflects.
    reflected: f64,
    /// Probability of following the mirror.
    mirror: f32,
}

impl Lobes {
    /// The mirror image, of this scale.
    #[inline]
    fn reflect(&self, specular: Rgb, wi: Vec3) -> Scattered {
        Scattered {
            wo: Vec3::new(-wi.x, -wi.y, wi.z),
            ratio: specular * (self.reflected / f64::from(self.mirror)) as f32,
            density: self.mirror,
            reverse: self.mirror,
            discrete: true,
            relative_ior: 1.0,
        }
    }
}

impl Plastic {
    /// A coat of the index `relative_ior` over that before it; reflectances of base and mirror image per channel.
    #[must_use]
    pub fn new(
        relative_ior: f32,
        [diffuse_reflectance, specular_reflectance]: [Color; 2],
        nonlinear: bool,
        two_sided: bool,
    ) -> Self {
        let relative_ior = f64::from(relative_ior);
        Self {
            relative_ior,
            internal: fresnel::diffuse_reflectance(1.0 / relative_ior) as f32,
            diffuse_reflectance,
            specular_reflectance,
            nonlinear,
            two_sided,
        }
    }

    /// The base's reflectance with all that the coat throws back onto it, of light inside: ρ / (1 − ρ F̄).
    #[inline]
    fn base(&self, at: &Shading<'_>) -> Rgb {
        let reflectance = self.diffuse_reflectance.at(at);
        reflectance.map(|rho| rho / (1.0 - self.internal * if self.nonlinear { rho } else { 1.0 }))
    }

    /// What each lobe reflects of light from an angle of this cosine; `None` if nothing.
    #[inline]
    fn lobes(&self, specular: Rgb, base: Rgb, cosine: f32) -> Option<Lobes> {
        let (reflected, _) = fresnel::dielectric_exact(f64::from(cosine), self.relative_ior);
        let mirror = f64::from(specular.mean()) * reflected;
        let diffuse = f64::from(base.mean() * (1.0 - self.internal)) * (1.0 - reflected);
        (mirror + diffuse > 0.0).then(|| Lobes {
            reflected,
            mirror: (mirror / (mirror + diffuse)) as f32,
        })
    }

    /// f · π of the base: what enters and leaves through the coat.
    #[inline]
    fn through(&self, base: Rgb, incoming: &Lobes, outgoing: &Lobes) -> Rgb {
        let squared = self.relative_ior * self.relative_ior;
        base * ((1.0 - incoming.reflected) * (1.0 - outgoing.reflected) / squared) as f32
    }
}

impl Model for Plastic {
    const KIND: MaterialKind = MaterialKind::Plastic;

    /// `None` on the black back of a one-sided surface, and where neither lobe reflects anything.
    #[inline(never)]
    fn sample(&self, at: &Shading<'_>, wi: Vec3, draw: ScatterDraw, _: Transport) -> Option<Scattered> {
        if wi.z == 0.0 || (wi.z < 0.0 && !self.two_sided) {
            return None;
        }
        let (specular, base) = (self.specular_reflectance.at(at), self.base(at));
        let lobes = self.lobes(specular, base, wi.z.abs())?;
        if draw.lobe < lobes.mirror {
            return Some(lobes.reflect(specular, wi));
        }
        let mut wo = warp::cosine_hemisphere(draw.direction);
        let outgoing = self.lobes(specular, base, wo.z)?;
        let (onward, back) = (1.0 - lobes.mirror, 1.0 - outgoing.mirror);
        let density = onward * warp::cosine_hemisphere_density(wo.z);
        wo.z = wo.z.copysign(wi.z);
        Scattered {
            wo,
            ratio: self.through(base, &lobes, &outgoing) / onward,
            density,
            reverse: back * warp::cosine_hemisphere_density(wi.z.abs()),
            discrete: false,
            relative_ior: 1.0,
        }
        .if_representable()
    }

    #[inline(never)]
    fn discrete(&self, at: &Shading<'_>, wi: Vec3, lobe: DiscreteLobe, _: Transport) -> Option<Scattered> {
        if lobe == DiscreteLobe::Refraction || wi.z == 0.0 || (wi.z < 0.0 && !self.two_sided) {
            return None;
        }
        let specular = self.specular_reflectance.at(at);
        let lobes = self.lobes(specular, self.base(at), wi.z.abs())?;
        (lobes.mirror > 0.0).then(|| lobes.reflect(specular, wi))
    }

    #[inline(never)]
    fn evaluate(&self, at: &Shading<'_>, wi: Vec3, wo: Vec3, _: Transport) -> Evaluated {
        let over = wi.z < 0.0;
        if wi.z == 0.0 || wo.z == 0.0 || over != (wo.z < 0.0) || (over && !self.two_sided) {
            return Evaluated::ZERO;
        }
        let (specular, base) = (self.specular_reflectance.at(at), self.base(at));
        let (ci, co) = (wi.z.abs(), wo.z.abs());
        let (Some(incoming), Some(outgoing)) = (self.lobes(specular, base, ci), self.lobes(specular, base, co)) else {
            return Evaluated::ZERO;
        };
        Evaluated {
            value: self.through(base, &incoming, &outgoing) * (FRAC_1_PI * co),
            density: (1.0 - incoming.mirror) * warp::cosine_hemisphere_density(co),
            reverse: (1.0 - outgoing.mirror) * warp::cosine_hemisphere_density(ci),
        }
    }
}
