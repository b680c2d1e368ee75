//! `Environment(file)`: light from outside the scene as a picture of all directions.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `file` | an EXR or Radiance HDR picture in latitude and longitude, relative to the scene file | texels are radiance, W sr⁻¹ m⁻² per channel, finite, >= 0 | this, or `radiance` |
//! | `scale` | factor of all texels | none, [0, 1e12] | 1 |
//! | `up` | direction of the picture's top row | any length but zero | (0, 1, 0) |
//! | `rotate` | angle by which the light is turned about `up`, counter-clockwise seen from its tip | degrees, [-36000, 36000] | 0 |
//!
//! Use it for measured surroundings (Debevec 1998). Do not use it for things near the scene: all of its light is infinitely
//! far away, so that nothing casts a shadow on it and it looks alike from everywhere; nor for a sun alone, which a `Sun` is at
//! less cost. With the defaults the left edge of the picture lies at −Z, a quarter from there at
//! +X, the middle at +Z: seen from inside it is not mirrored. Texels are centres of equal steps in longitude and latitude;
//! between them the light is bilinear in longitude and in 1 − cos θ, above the first row and below the last it is that row's.
//! Directions are drawn with a density in exact proportion to the mean of the channels of that same interpolation, so a
//! picture of one colour is light without variance, and a single bright texel costs no more than a lamp does.

use super::infinite::{Axes, Infinite};
use super::sphere_map::SphereMap;
use crate::color::Rgb;
use glam::{DQuat, DVec3, Vec3};
use std::f64::consts::PI;

/// An environment from a picture.
#[derive(Clone, Debug)]
pub struct Image {
    axes: Axes,
    width: usize,
    height: usize,
    texels: Vec<Rgb>,
    map: SphereMap,
    max_radiance: f32,
}

/// Why texels make no environment.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ImageError {
    /// Nothing, or not as many texels as the sides say.
    #[error("expected {width} x {height} texels, found {found}")]
    Size {
        /// Texels from left to right.
        width: usize,
        /// Texels from top to bottom.
        height: usize,
        /// How many there are.
        found: usize,
    },
    /// A texel that is no radiance.
    #[error("the texel in column {column} of row {row} is ({}, {}, {}), which is no radiance", texel.r, texel.g, texel.b)]
    Texel {
        /// Texels to its left.
        column: usize,
        /// Texels above it.
        row: usize,
        /// Its value.
        texel: Rgb,
    },
}

impl Image {
    /// An environment of `width` by `height` texels, row by row from the top, placed as `up` (any length but zero) and
    /// `rotate` say.
    ///
    /// # Errors
    /// Where there are no texels, or one is negative, infinite or not a number.
    pub fn new((width, height): (usize, usize), texels: Vec<Rgb>, up: DVec3, rotate: f32) -> Result<Self, ImageError> {
        let found = texels.len();
        if found == 0 || width.checked_mul(height) != Some(found) {
            return Err(ImageError::Size { width, height, found });
        }
        if let Some(bad) = texels.iter().position(|t| !t.is_finite() || t.min_channel() < 0.0) {
            let (column, row, texel) = (bad % width, bad / width, texels[bad]);
            return Err(ImageError::Texel { column, row, texel });
        }
        let tilt = DQuat::from_rotation_arc(DVec3::Y, up.normalize());
        let turn = tilt * DQuat::from_axis_angle(DVec3::Y, f64::from(rotate).to_radians());
        let axes = Axes {
            first: turn * DVec3::NEG_Z,
            second: turn * DVec3::X,
            pole: turn * DVec3::Y,
        };
        // The rows' middles, and the poles.
        let middle = |row: usize| {
            let sine = libm::sin(0.5 * PI * (row as f64 + 0.5) / height as f64);
            2.0 * sine * sine
        };
        let depths = std::iter::once(0.0).chain((0..height).map(middle));
        let depths = depths.chain(std::iter::once(2.0)).collect();
        let map = SphereMap::new(width, depths, |circle, meridian| {
            texels[row(circle, height) * width + meridian].mean()
        });
        let max_radiance = texels.iter().map(|texel| texel.max_channel()).fold(0.0, f32::max);
        Ok(Self {
            axes,
            width,
            height,
            texels,
            map,
            max_radiance,
        })
    }
}

/// The row of texels on a circle: at the poles those next to them.
fn row(circle: usize, height: usize) -> usize {
    circle.saturating_sub(1).min(height - 1)
}

impl Infinite for Image {
    fn sample(&self, u: [f64; 2]) -> Option<Vec3> {
        self.map.sample(u).map(|polar| self.axes.direction(polar))
    }

    fn density(&self, direction: Vec3) -> f32 {
        self.map.density(self.axes.polar(direction)) as f32
    }

    fn radiance(&self, direction: Vec3) -> Rgb {
        let Some(place) = self.map.place(self.axes.polar(direction)) else {
            return Rgb::BLACK;
        };
        let corners = place.corners().into_iter();
        corners.fold(Rgb::BLACK, |sum, (circle, meridian, share)| {
            sum + self.texels[row(circle, self.height) * self.width + meridian] * share as f32
        })
    }

    fn total(&self) -> f64 {
        self.map.total()
    }

    fn max_radiance(&self) -> f32 {
        self.max_radiance
    }
}
