//! `Spot`: a point that shines into a cone.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `position` | where it is | scene units | required |
//! | `target` | a point on the cone's axis, not `position` | scene units | required |
//! | `intensity` | power per solid angle inside the beam | W sr⁻¹, [0, 1e12] per channel | required |
//! | `cutoff` | half angle of the cone, beyond which nothing shines | degrees, [1e-3, 90] | 20 |
//! | `beam` | half angle inside which the intensity is full | degrees, [0, `cutoff`] | three quarters of `cutoff` |
//!
//! Use it for stage lamps and torches; like a `Point` it is met by no path. Do not use it for lamps whose shade or lens is near
//! to what they light, which cast soft shadows: a small `Disk` that emits, in a tube, does. It is a point light with a profile
//! (Pharr, Jakob and Humphreys 2023, §12.2.1). Between beam and cutoff the intensity falls
//! off as 3s² − 2s³, where s goes from 0 at the cutoff to 1 at the beam in proportion to cos θ: smooth at both ends. It
//! integrates to π (m_beam + m_cutoff), where m = 1 − cos θ, so directions are drawn with a density in proportion to
//! the intensity, exactly; m keeps the digits that cos θ loses in narrow cones.

use crate::color::Rgb;
use crate::material::Frame;
use crate::math;
use glam::{DVec3, Vec3};
use std::f32::consts::TAU;
use std::f64::consts::PI;

/// A spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Position, world space.
    pub position: Vec3,
    /// Power per solid angle inside the beam, W sr⁻¹.
    pub intensity: Rgb,
    axis: DVec3,
    /// 1 − cos of the half angle of the beam.
    beam: f64,
    /// 1 − cos of the half angle of the cone.
    cutoff: f64,
}

/// 1 − cos of an angle in degrees, without cancellation.
pub(super) fn one_minus_cos(degrees: f32) -> f64 {
    let sine = libm::sin(0.5 * f64::from(degrees).to_radians());
    2.0 * sine * sine
}

/// 1 − cos of the angle between two unit vectors, without cancellation where they are near.
pub(super) fn one_minus_dot(a: DVec3, b: DVec3) -> f64 {
    0.5 * (a - b).length_squared()
}

impl Spot {
    /// A spot at `position` that shines along `axis` (any length but zero) with half angles in degrees.
    #[must_use]
    pub fn new(position: Vec3, axis: DVec3, intensity: Rgb, cutoff: f32, beam: f32) -> Self {
        Self {
            position,
            intensity,
            axis: axis.normalize(),
            beam: one_minus_cos(beam),
            cutoff: one_minus_cos(cutoff),
        }
    }

    /// Share of the full intensity in a unit direction away from the light.
    #[must_use]
    pub fn profile(&self, direction: Vec3) -> f32 {
        let m = one_minus_dot(direction.as_dvec3().normalize(), self.axis);
        if m <= self.beam {
            1.0
        } else if m >= self.cutoff {
            0.0
        } else {
            let s = (self.cutoff - m) / (self.cutoff - self.beam);
            (s * s * (3.0 - 2.0 * s)) as f32
        }
    }

    /// The integral of the profile over all directions.
    fn solid_angle(&self) -> f64 {
        PI * (self.beam + self.cutoff)
    }

    /// Mean of the channels' powers in W.
    pub(super) fn power(&self) -> f64 {
        f64::from(self.intensity.mean()) * self.solid_angle()
    }

    /// Density per solid angle with which [`direction`](Self::direction) draws.
    pub(super) fn density(&self, direction: Vec3) -> f32 {
        (f64::from(self.profile(direction)) / self.solid_angle()) as f32
    }

    /// A direction with density in proportion to the intensity.
    pub(super) fn direction(&self, [u, v]: [f32; 2]) -> Vec3 {
        let falloff = self.cutoff - self.beam;
        // The beam holds `beam` of the whole, the falloff half its width.
        let x = f64::from(u) * (self.beam + 0.5 * falloff);
        let m = if x < self.beam {
            x
        } else {
            // What is left to the cutoff, in shares of the falloff: ∫₀ˢ (3s² − 2s³) ds = s³ − s⁴/2.
            let left = 1.0 - 2.0 * (x - self.beam) / falloff;
            self.cutoff - falloff * falloff_at(left)
        };
        let r = (m * (2.0 - m)).max(0.0).sqrt() as f32;
        let angle = TAU * v;
        let local = Vec3::new(r * math::cos(angle), r * math::sin(angle), (1.0 - m) as f32);
        Frame::new(self.axis.as_vec3()).to_world(local).normalize()
    }
}

/// The s in [0, 1] with 2s³ − s⁴ = `share`: Newton's steps, kept between bounds that close in on it.
fn falloff_at(share: f64) -> f64 {
    if share <= 0.0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    // Near 0 the curve is 2s³.
    let mut s = libm::cbrt(0.5 * share).min(1.0);
    for _ in 0..24 {
        let excess = s * s * s * (2.0 - s) - share;
        if excess > 0.0 {
            high = s;
        } else {
            low = s;
        }
        let step = excess / (s * s * (6.0 - 4.0 * s));
        if step.abs() <= f64::EPSILON * s {
            break;
        }
        let next = s - step;
        s = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(cutoff: f32, beam: f32) -> Spot {
        Spot::new(Vec3::ZERO, DVec3::Z, Rgb::ONE, cutoff, beam)
    }

    fn aside(degrees: f64) -> Vec3 {
        let angle = degrees.to_radians();
        DVec3::new(libm::sin(angle), 0.0, libm::cos(angle)).as_vec3()
    }

    #[test]
    fn the_intensity_is_full_in_the_beam_and_falls_smoothly_to_the_cutoff() {
        let spot = spot(20.0, 15.0);
        assert_eq!(spot.profile(Vec3::Z), 1.0);
        assert_eq!(spot.profile(aside(14.9)), 1.0);
        assert_eq!(spot.profile(aside(20.1)), 0.0);
        assert_eq!(spot.profile(Vec3::NEG_Z), 0.0);
        let half = libm::acos(0.5 * (libm::cos(15_f64.to_radians()) + libm::cos(20_f64.to_radians())));
        assert!((spot.profile(aside(half.to_degrees())) - 0.5).abs() < 1e-4);
        assert!(spot.profile(aside(15.1)) > 0.995 && spot.profile(aside(19.9)) < 0.005);
    }

    #[test]
    fn edges_may_be_sharp_and_beams_may_be_nothing() {
        let sharp = spot(30.0, 30.0);
        assert_eq!((sharp.profile(aside(29.99)), sharp.profile(aside(30.01))), (1.0, 0.0));
        let soft = spot(90.0, 0.0);
        assert!(soft.profile(aside(0.1)) > 0.999);
        for spot in [sharp, soft] {
            for u in [0.0, 0.3, 1.0 - f32::EPSILON] {
                assert!(spot.direction([u, 0.4]).is_normalized());
            }
        }
    }

    #[test]
    fn narrow_cones_keep_their_shape() {
        let narrow = spot(1e-3, 5e-4);
        assert_eq!(narrow.profile(aside(4e-4)), 1.0);
        assert_eq!(narrow.profile(aside(1.1e-3)), 0.0);
        let ratio = f64::from(narrow.density(Vec3::Z)) * PI * (narrow.beam + narrow.cutoff);
        assert!((ratio - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_falloff_is_inverted_everywhere() {
        for i in 0..=10_000 {
            let share = f64::from(i) / 10_000.0;
            let s = falloff_at(share);
            assert!((s * s * s * (2.0 - s) - share).abs() < 1e-14, "{share}: {s}");
        }
    }
}
