//! The one colour type. Radiance, reflectance and throughput are all carried in it, never in a bare vector, so that
//! the number of wavelengths can change in one place.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// Linear colour with sRGB (Rec. 709) primaries and a D65 white: radiance in W sr⁻¹ m⁻² per channel, or a
/// dimensionless ratio such as a reflectance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[repr(C)]
#[serde(from = "[f32; 3]", into = "[f32; 3]")]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

impl Rgb {
    /// No light.
    pub const BLACK: Self = Self::splat(0.0);
    /// One in every channel.
    pub const ONE: Self = Self::splat(1.0);

    /// A colour from its three channels.
    #[must_use]
    pub const fn new(r: f32, g: f32, b: f32) -> Self {
        Self { r, g, b }
    }

    /// The same value in every channel.
    #[must_use]
    pub const fn splat(v: f32) -> Self {
        Self::new(v, v, v)
    }

    /// The channels as an array, red first.
    #[must_use]
    pub const fn to_array(self) -> [f32; 3] {
        [self.r, self.g, self.b]
    }

    /// Relative luminance Y of linear sRGB (IEC 61966-2-1: the Y row of the RGB to XYZ matrix).
    #[must_use]
    pub fn luminance(self) -> f32 {
        0.212_671 * self.r + 0.715_16 * self.g + 0.072_169 * self.b
    }

    /// The mean of the channels: unlike luminance, not nearly blind to any of them.
    #[must_use]
    pub fn mean(self) -> f32 {
        (self.r + self.g + self.b) * (1.0 / 3.0)
    }

    /// The largest channel.
    #[must_use]
    pub fn max_channel(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }

    /// The smallest channel.
    #[must_use]
    pub fn min_channel(self) -> f32 {
        self.r.min(self.g).min(self.b)
    }

    /// Whether every channel is exactly zero.
    #[must_use]
    pub fn is_black(self) -> bool {
        self.r == 0.0 && self.g == 0.0 && self.b == 0.0
    }

    /// Whether no channel is infinite or not a number.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// `f` applied to every channel.
    #[must_use]
    pub fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Self::new(f(self.r), f(self.g), f(self.b))
    }
}

impl From<[f32; 3]> for Rgb {
    fn from([r, g, b]: [f32; 3]) -> Self {
        Self { r, g, b }
    }
}

impl From<Rgb> for [f32; 3] {
    fn from(c: Rgb) -> Self {
        c.to_array()
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.r + o.r, self.g + o.g, self.b + o.b)
    }
}

impl Sub for Rgb {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.r - o.r, self.g - o.g, self.b - o.b)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl Mul for Rgb {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::new(self.r * o.r, self.g * o.g, self.b * o.b)
    }
}

impl MulAssign for Rgb {
    fn mul_assign(&mut self, o: Self) {
        *self = *self * o;
    }
}

impl Mul<f32> for Rgb {
    type Output = Self;
    fn mul(self, s: f32) -> Self {
        self.map(|c| c * s)
    }
}

impl Div<f32> for Rgb {
    type Output = Self;
    fn div(self, s: f32) -> Self {
        self.map(|c| c / s)
    }
}
