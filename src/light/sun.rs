//! `Sun`: the disc of the sun, as it shines through the atmosphere.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `direction` | towards the sun, not below the horizon | any length but zero | required |
//! | `turbidity` | haze of the air | none, [1, 10] | 3 |
//! | `scale` | factor of the radiance | none, [0, 1e12] | 1 |
//! | `up` | the zenith, from which the sun's elevation is counted | any length but zero | (0, 1, 0) |
//!
//! Use it with a `Sky` of the same sun and turbidity; the sky is without its disc. Do not use it for suns of other
//! sizes or worlds: scale an `Environment(file)`. The disc has the true angular radius,
//! 0.2665 degrees, and the same radiance everywhere: that of Hosek and Wilkie (2013), its limb darkening averaged. It can
//! be met: it shows in mirrors, and caustics of it are found from either end. Directions are uniform over the disc. A disc
//! of which a part is below the horizon shines in whole.

use super::hosek_wilkie;
use super::infinite::Infinite;
use super::spot::{one_minus_cos, one_minus_dot};
use crate::color::Rgb;
use glam::{DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Angular radius of the sun in degrees.
pub const SUN_RADIUS: f32 = 0.2665;

/// A disc at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    axis: DVec3,
    /// 1 − cos of the angular radius.
    rim: f64,
    radiance: Rgb,
}

impl Sun {
    /// A disc towards `direction` (any length but zero) of an angular radius in degrees, (0, 90].
    #[must_use]
    pub fn disc(direction: DVec3, radius: f32, radiance: Rgb) -> Self {
        Self {
            axis: direction.normalize(),
            rim: one_minus_cos(radius),
            radiance,
        }
    }

    /// The sun towards `direction`, through air of a turbidity in [1, 10]; `up` is the zenith. Directions have any length
    /// but zero.
    #[must_use]
    pub fn through_air(direction: DVec3, up: DVec3, turbidity: f32, scale: f32) -> Self {
        let radiance = hosek_wilkie::sun(elevation(direction, up), turbidity) * scale;
        Self::disc(direction, SUN_RADIUS, radiance)
    }
}

/// Elevation of a direction over the horizon in radians; 0 where it is below.
pub(super) fn elevation(direction: DVec3, up: DVec3) -> f64 {
    // From both cosine and sine: neither end of the range loses digits.
    let across = direction.cross(up).length();
    (FRAC_PI_2 - libm::atan2(across, direction.dot(up))).max(0.0)
}

impl Infinite for Sun {
    fn sample(&self, [u, v]: [f64; 2]) -> Option<Vec3> {
        let m = u * self.rim;
        let across = (m * (2.0 - m)).max(0.0).sqrt();
        let angle = TAU * v;
        let (x, y) = self.axis.any_orthonormal_pair();
        let around = x * libm::cos(angle) + y * libm::sin(angle);
        let direction = (around * across + self.axis * (1.0 - m)).normalize();
        let rounded = direction.as_vec3();
        if self.density(rounded) > 0.0 {
            return Some(rounded);
        }
        // At the rim a direction in f32 may round to outside: it goes back by a few of its roundings.
        let inward = self.axis - direction;
        let inside = direction + inward * (4.0 * f64::from(f32::EPSILON) / inward.length()).min(1.0);
        Some(inside.normalize().as_vec3()).filter(|&inside| self.density(inside) > 0.0)
    }

    fn density(&self, direction: Vec3) -> f32 {
        if one_minus_dot(direction.as_dvec3().normalize(), self.axis) <= self.rim {
            (1.0 / (TAU * self.rim)) as f32
        } else {
            0.0
        }
    }

    fn radiance(&self, direction: Vec3) -> Rgb {
        if self.density(direction) > 0.0 {
            self.radiance
        } else {
            Rgb::BLACK
        }
    }

    fn total(&self) -> f64 {
        TAU * self.rim * f64::from(self.radiance.mean())
    }

    fn max_radiance(&self) -> f32 {
        self.radiance.max_channel()
    }
}
