//! Microfacets: rough surfaces as statistics of small mirrors (Torrance and Sparrow 1967; Walter et al. 2007).
//!
//! What a rough material needs of them: how many face which way, how much of them is seen from a direction, and normals
//! drawn in proportion to what is seen. Masking is Smith's, and that of two directions is the product of both
//! (uncorrelated), so that values are reciprocal and tables of other renderers apply. Light that meets a second facet is
//! lost: a rough white metal reflects less than it receives. Of light from straight above it loses 2 % at the roughness 0.2,
//! and 1 − ln 2 is all that is left at the roughness 1 (GGX).
//!
//! Use it by the `distribution` of rough materials: `Ggx` has the long tails that most real surfaces have, `Beckmann` is the
//! statistics of a Gaussian surface. Do not use it for smooth surfaces, which have models of their own.
//!
//! All is computed in `f64`. Nothing divides by the cosine of a direction, which at grazing angles cancels against
//! masking: [`Microfacets::projected_area`] is their quotient in closed form. Directions here have z >= 0 and unit length;
//! x and y are the directions along which the roughnesses `alpha_u` and `alpha_v` hold.

mod beckmann;
mod ggx;
mod mirror;

pub(super) use mirror::{above, outward};

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// How the slopes of microfacets are distributed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "distribution")]
#[schemars(rename = "Distribution")]
pub enum Distribution {
    /// Trowbridge and Reitz (1975), also known as GGX (Walter et al. 2007): long tails, as real surfaces have them.
    #[default]
    Ggx,
    /// Beckmann and Spizzichino (1963): normally distributed slopes; highlights with an edge.
    Beckmann,
}

/// Microfacets of one surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microfacets {
    distribution: Distribution,
    alpha_u: f64,
    alpha_v: f64,
}

impl Microfacets {
    /// Microfacets of the roughnesses `alpha_u` along x and `alpha_v` along y, each from
    /// [`LEAST_ROUGHNESS`](crate::tolerance::LEAST_ROUGHNESS) to 1: √2 times the root mean square of slopes (Beckmann).
    #[must_use]
    pub fn new(distribution: Distribution, [alpha_u, alpha_v]: [f32; 2]) -> Self {
        Self {
            distribution,
            alpha_u: f64::from(alpha_u),
            alpha_v: f64::from(alpha_v),
        }
    }

    /// Whether turning the surface about its normal changes nothing.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        self.alpha_u == self.alpha_v
    }

    /// D(h): area of facets whose normal is `h`, per unit of macroscopic area and solid angle of `h`. Its integral times
    /// the cosine of `h` is 1.
    #[inline]
    #[must_use]
    pub fn density(&self, h: DVec3) -> f64 {
        if h.z <= 0.0 {
            return 0.0;
        }
        let (x, y) = (h.x / self.alpha_u, h.y / self.alpha_v);
        let unit = match self.distribution {
            Distribution::Ggx => ggx::density(x * x + y * y, h.z * h.z),
            Distribution::Beckmann => beckmann::density(x * x + y * y, h.z * h.z),
        };
        unit / (PI * self.alpha_u * self.alpha_v)
    }

    /// The area of facets seen from `w`, per unit of macroscopic area, projected along `w`: cos θ / G₁ = cos θ (1 + Λ)
    /// (Heitz 2014, eq. 12 and 43). At least a half of the facets' own slant when `w` is grazing: never zero.
    #[inline]
    #[must_use]
    pub fn projected_area(&self, w: DVec3) -> f64 {
        let (x, y) = (self.alpha_u * w.x, self.alpha_v * w.y);
        match self.distribution {
            Distribution::Ggx => ggx::projected_area(x * x + y * y, w.z),
            Distribution::Beckmann => beckmann::projected_area(x * x + y * y, w.z),
        }
    }

    /// G₁(w): the share of facets towards `w` that no other facet hides.
    #[inline]
    #[must_use]
    pub fn masking(&self, w: DVec3) -> f64 {
        w.z / self.projected_area(w)
    }

    /// Density per solid angle of the normals that are seen from `w`: D(h) (w·h)⁺ / [`projected_area`](Self::projected_area)
    /// (Heitz 2014, eq. 16).
    #[inline]
    #[must_use]
    pub fn visible_density(&self, w: DVec3, h: DVec3) -> f64 {
        self.density(h) * w.dot(h).max(0.0) / self.projected_area(w)
    }

    /// A normal seen from `w`, with the density of [`visible_density`](Self::visible_density): the surface is scaled to
    /// the roughness 1, sampled there, and scaled back (Heitz and d'Eon 2014, §4).
    #[inline]
    #[must_use]
    pub fn sample_visible(&self, w: DVec3, u: [f32; 2]) -> DVec3 {
        let scaled = DVec3::new(self.alpha_u * w.x, self.alpha_v * w.y, w.z).normalize();
        let normal = match self.distribution {
            Distribution::Ggx => ggx::sample_visible(scaled, u),
            Distribution::Beckmann => beckmann::sample_visible(scaled, u),
        };
        DVec3::new(self.alpha_u * normal.x, self.alpha_v * normal.y, normal.z).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};

    const ALPHAS: [[f32; 2]; 6] = [
        [1.0, 1.0],
        [0.3, 0.3],
        [0.01, 0.01],
        [1e-4, 1e-4],
        [1.0, 1e-4],
        [0.1, 0.4],
    ];

    fn all() -> impl Iterator<Item = Microfacets> {
        [Distribution::Ggx, Distribution::Beckmann]
            .into_iter()
            .flat_map(|distribution| ALPHAS.map(|alpha| Microfacets::new(distribution, alpha)))
    }

    fn toward(cosine: f64, phi: f64) -> DVec3 {
        let sine = (1.0 - cosine * cosine).sqrt();
        DVec3::new(sine * libm::cos(phi), sine * libm::sin(phi), cosine)
    }

    /// Of the plane of slopes, mapped to (-1, 1)², by the midpoint rule: `f` gets the normal, and its result is multiplied
    /// with the solid angle.
    fn over_normals(microfacets: &Microfacets, f: impl Fn(DVec3) -> f64) -> f64 {
        const N: i32 = 1600;
        let mut sum = 0.0;
        for i in 0..N {
            for j in 0..N {
                let [p, q] = [i, j].map(|k| (2.0 * f64::from(k) + 1.0) / f64::from(N) - 1.0);
                let (cp, cq) = (1.0 - p * p, 1.0 - q * q);
                let (x, y) = (microfacets.alpha_u * p / cp, microfacets.alpha_v * q / cq);
                let area =
                    microfacets.alpha_u * (1.0 + p * p) / (cp * cp) * microfacets.alpha_v * (1.0 + q * q) / (cq * cq);
                let h = DVec3::new(x, y, 1.0).normalize();
                sum += f(h) * area * h.z * h.z * h.z;
            }
        }
        sum * 4.0 / f64::from(N * N)
    }

    #[test]
    fn facets_project_onto_the_surface_and_onto_directions() {
        for microfacets in all() {
            let surface = over_normals(&microfacets, |h| microfacets.density(h) * h.z);
            assert!((surface - 1.0).abs() < 1e-5, "{microfacets:?}: {surface}");
            for w in [toward(1.0, 0.0), toward(0.7, 0.5), toward(0.05, 2.0), toward(1e-6, 4.0)] {
                let projected = over_normals(&microfacets, |h| microfacets.density(h) * w.dot(h).max(0.0));
                let stated = microfacets.projected_area(w);
                // Grazing along a ridge the integrand has a kink; the rule is then good to some ten-thousandths.
                assert!(
                    (projected / stated - 1.0).abs() < 1e-3,
                    "{microfacets:?} {w}: {projected} {stated}"
                );
            }
        }
    }

    #[test]
    fn masking_is_a_share_at_every_angle() {
        for microfacets in all() {
            let mut last = f64::INFINITY;
            for cosine in [
                1.0,
                0.999_999,
                0.9,
                0.5,
                0.1,
                1e-2,
                1e-4,
                1e-8,
                1e-30,
                f64::from(f32::MIN_POSITIVE),
                0.0,
            ] {
                let masking = microfacets.masking(toward(cosine, 1.0));
                assert!(
                    (0.0..=1.0).contains(&masking) && masking <= last,
                    "{microfacets:?} {cosine}: {masking}"
                );
                last = masking;
            }
            assert_eq!(last, 0.0);
            assert!((microfacets.masking(DVec3::Z) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn sampled_normals_are_seen_and_finite_at_every_angle_and_number() {
        let mut stream = StreamKey::new(5, 0, 0).stream(Purpose::SCATTER, 0);
        for microfacets in all() {
            for cosine in [1.0, 0.5, 1e-3, 1e-8, f64::from(f32::MIN_POSITIVE), 0.0] {
                let w = toward(cosine, 0.3);
                let ends = [0.0, 0.5, 1.0 - 0.5 * f32::EPSILON];
                let corners = ends.into_iter().flat_map(|u| ends.map(|v| [u, v]));
                let random: Vec<_> = (0..2000).map(|_| stream.next_pair()).collect();
                for u in corners.chain(random) {
                    let h = microfacets.sample_visible(w, u);
                    let density = microfacets.visible_density(w, h);
                    assert!(
                        h.is_finite() && (h.length() - 1.0).abs() < 1e-12 && h.z >= 0.0,
                        "{microfacets:?} {w} {u:?}: {h}"
                    );
                    assert!(
                        w.dot(h) >= -1e-15 && density.is_finite(),
                        "{microfacets:?} {w} {u:?}: {h} {density}"
                    );
                }
            }
        }
    }
}
