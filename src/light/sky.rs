//! `Sky`: the sky of a clear or hazy day, without the sun itself.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `sun_direction` | towards the sun, not below the horizon | any length but zero | required |
//! | `turbidity` | haze of the air: 1 none, 2 very clear, 3 clear, 6 hazy, 10 thick haze | none, [1, 10] | 3 |
//! | `albedo` | share of light that the ground reflects back to the sky | none, [0, 1] per channel | 0.3 |
//! | `scale` | factor of the radiance | none, [0, 1e12] | 1 |
//! | `up` | the zenith | any length but zero | (0, 1, 0) |
//!
//! Use it for daylight, with a `Sun`. Do not use it for clouds, twilight or night: the model is of clear air, and of a sun that
//! is above the horizon. Radiance is that of Hosek and Wilkie (2012), evaluated where it is needed; below the
//! horizon it is black. Directions are drawn from the same model on a grid, bilinear between; what the grid misses of the
//! brightness near the sun and the horizon costs variance, not correctness.

use super::hosek_wilkie::SkyState;
use super::infinite::{Axes, Infinite, Polar};
use super::sphere_map::SphereMap;
use super::spot::one_minus_dot;
use super::sun::elevation;
use crate::color::Rgb;
use glam::{DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Meridians of the grid that directions are drawn from.
const MERIDIANS: usize = 256;
/// Circles of it, from the zenith to the horizon.
const CIRCLES: usize = 97;
/// Share of the mean radiance that every direction above the horizon is drawn as if it had.
const LEAST_SHARE: f32 = 1e-2;

/// A sky.
#[derive(Clone, Debug)]
pub struct Sky {
    state: SkyState,
    scale: f32,
    sun: DVec3,
    axes: Axes,
    map: SphereMap,
    total: f64,
    max_radiance: f32,
}

impl Sky {
    /// The sky of a sun towards `sun` in air of a turbidity in [1, 10], over ground that reflects `albedo`; `up` is the
    /// zenith. Directions have any length but zero.
    #[must_use]
    pub fn new(sun: DVec3, up: DVec3, turbidity: f32, albedo: Rgb, scale: f32) -> Self {
        let (sun, pole) = (sun.normalize(), up.normalize());
        let state = SkyState::new(elevation(sun, pole), turbidity, albedo);
        let level = sun - pole * sun.dot(pole);
        let first = level.try_normalize().unwrap_or_else(|| pole.any_orthonormal_vector());
        let axes = Axes {
            first,
            second: pole.cross(first),
            pole,
        };
        let depth = |circle: usize| {
            let sine = libm::sin(0.5 * FRAC_PI_2 * circle as f64 / (CIRCLES - 1) as f64);
            2.0 * sine * sine
        };
        let mut radiances = Vec::with_capacity(CIRCLES * MERIDIANS);
        for circle in 0..CIRCLES {
            for meridian in 0..MERIDIANS {
                let turn = (meridian as f64 + 0.5) / MERIDIANS as f64;
                // The horizon itself, which rounding may put below.
                let depth = depth(circle).min(1.0);
                let direction = axes.direction(Polar { depth, turn });
                let cos_gamma = 1.0 - one_minus_dot(direction.as_dvec3().normalize(), sun);
                radiances.push(state.radiance(1.0 - depth, cos_gamma) * scale);
            }
        }
        let max_radiance = radiances
            .iter()
            .map(|radiance| radiance.max_channel())
            .fold(0.0, f32::max);
        let map_of = |least: f32| {
            let depths = (0..CIRCLES).map(|circle| depth(circle).min(1.0)).collect();
            SphereMap::new(MERIDIANS, depths, |circle, meridian| {
                radiances[circle * MERIDIANS + meridian].mean().max(least)
            })
        };
        let total = map_of(0.0).total();
        let least = LEAST_SHARE * (total / TAU) as f32;
        Self {
            state,
            scale,
            sun,
            axes,
            map: map_of(least),
            total,
            max_radiance,
        }
    }
}

impl Infinite for Sky {
    fn sample(&self, u: [f64; 2]) -> Option<Vec3> {
        let direction = self.axes.direction(self.map.sample(u)?);
        // At the horizon a direction in f32 may round to below it.
        (self.density(direction) > 0.0).then_some(direction)
    }

    fn density(&self, direction: Vec3) -> f32 {
        self.map.density(self.axes.polar(direction)) as f32
    }

    fn radiance(&self, direction: Vec3) -> Rgb {
        let height = 1.0 - self.axes.polar(direction).depth;
        let cos_gamma = 1.0 - one_minus_dot(direction.as_dvec3().normalize(), self.sun);
        self.state.radiance(height, cos_gamma) * self.scale
    }

    fn total(&self) -> f64 {
        self.total
    }

    fn max_radiance(&self) -> f32 {
        self.max_radiance
    }
}
