//! The sky and the sun of Hosek and Wilkie: "An Analytic Model for Full Spectral Sky-Dome Radiance" (2012) and "Adding a
//! Solar-Radiance Function to the Hošek-Wilkie Skylight Model" (2013), for turbidities from 1 to 10.
//!
//! The tables are the authors' (licence beside this file), as little-endian `f32`:
//! - `sky.f32`: by turbidity (10), albedo 0 and 1, control point over the sun's elevation (6), channel (3): the nine
//!   coefficients of the radiance distribution, and the mean radiance;
//! - `sun.f32`: by turbidity (10), segment of elevation (45), channel (3): a cubic of the elevation above the segment's
//!   start. It is the model's spectral radiance with its limb darkening averaged over the disc's area, linear between the
//!   model's wavelengths (320, 360, … 720 nm, nothing beyond), seen by the CIE 1931 observer and turned into linear sRGB.
//!
//! Both are divided by the integral of ȳ (106.857 nm): radiance is a mean per nanometre, W sr⁻¹ m⁻² nm⁻¹, so that the sky
//! of a clear day is near 0.1 and the sun near 2e4. What lies outside the colours of sRGB, such as the blue of a sun that
//! sets, would be negative and is 0.

use crate::color::Rgb;
use std::f64::consts::FRAC_PI_2;

static SKY: &[u8] = include_bytes!("sky.f32");
static SUN: &[u8] = include_bytes!("sun.f32");

/// Turbidities, albedos, control points, channels and numbers of the sky's table.
const CONTROLS: usize = 6;
const NUMBERS: usize = 10;
/// Segments of the sun's table, and coefficients of each.
const SEGMENTS: usize = 45;
const CUBIC: usize = 4;
const CHANNELS: usize = 3;

/// The model's range of turbidities: 1 is air without dust, 2 a very clear day, 10 haze.
pub const TURBIDITY: [f32; 2] = [1.0, 10.0];

/// The sky for one sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SkyState {
    /// Per channel: the nine coefficients, and the mean radiance.
    channels: [[f64; NUMBERS]; CHANNELS],
}

impl SkyState {
    /// The sky at a solar elevation in radians, [0, π/2], over ground that reflects `albedo`.
    pub fn new(elevation: f64, turbidity: f32, albedo: Rgb) -> Self {
        let x = libm::cbrt((elevation / FRAC_PI_2).clamp(0.0, 1.0));
        let weights = bernstein(x);
        let [low, high] = turbidities(turbidity);
        let mut channels = [[0.0; NUMBERS]; CHANNELS];
        for (channel, albedo) in albedo.to_array().into_iter().enumerate() {
            let albedo = f64::from(albedo);
            for (turbidity, by_turbidity) in [low, high] {
                for (ground, by_ground) in [(0, 1.0 - albedo), (1, albedo)] {
                    for (control, weight) in weights.into_iter().enumerate() {
                        let row = ((turbidity * 2 + ground) * CONTROLS + control) * CHANNELS + channel;
                        for (number, value) in channels[channel].iter_mut().enumerate() {
                            *value += by_turbidity * by_ground * weight * read(SKY, row * NUMBERS + number);
                        }
                    }
                }
            }
        }
        Self { channels }
    }

    /// Radiance from a direction at `height` = cos θ over the horizon, at an angle to the sun whose cosine is
    /// `cos_gamma`; black below the horizon. (2012, equation 8.)
    pub fn radiance(&self, height: f64, cos_gamma: f64) -> Rgb {
        if height < 0.0 {
            return Rgb::BLACK;
        }
        let cos_gamma = cos_gamma.clamp(-1.0, 1.0);
        let gamma = libm::acos(cos_gamma);
        let cos2 = cos_gamma * cos_gamma;
        let of = |[a, b, c, d, e, f, g, i, h, mean]: [f64; NUMBERS]| {
            let around = 1.0 + h * h - 2.0 * h * cos_gamma;
            let mie = (1.0 + cos2) / (around * around.sqrt());
            let gradient = 1.0 + a * libm::exp(b / (height + 0.01));
            let halo = c + d * libm::exp(e * gamma) + f * cos2 + g * mie + i * height.sqrt();
            (mean * gradient * halo).max(0.0) as f32
        };
        Rgb::from(self.channels.map(of))
    }
}

/// Mean radiance of the sun's disc at an elevation in radians, [0, π/2], through the atmosphere.
pub(super) fn sun(elevation: f64, turbidity: f32) -> Rgb {
    let segments = SEGMENTS as f64;
    let share = (elevation / FRAC_PI_2).clamp(0.0, 1.0);
    let segment = ((libm::cbrt(share) * segments) as usize).min(SEGMENTS - 1);
    let start = segment as f64 / segments;
    let x = share * FRAC_PI_2 - start * start * start * FRAC_PI_2;
    let mut channels = [0.0; CHANNELS];
    for (turbidity, weight) in turbidities(turbidity) {
        for (channel, value) in channels.iter_mut().enumerate() {
            let row = ((turbidity * SEGMENTS + segment) * CHANNELS + channel) * CUBIC;
            let cubic = (0..CUBIC).rev().fold(0.0, |sum, k| sum * x + read(SUN, row + k));
            *value += weight * cubic;
        }
    }
    Rgb::from(channels.map(|value| value.max(0.0) as f32))
}

/// The tables' turbidities on both sides of one, and their shares.
fn turbidities(turbidity: f32) -> [(usize, f64); 2] {
    let turbidity = f64::from(turbidity.clamp(TURBIDITY[0], TURBIDITY[1]));
    let low = turbidity.floor();
    let high = turbidity - low;
    let row = low as usize - 1;
    [(row, 1.0 - high), ((row + 1).min(9), high)]
}

/// Weights of the control points of a Bézier curve of degree 5.
fn bernstein(x: f64) -> [f64; CONTROLS] {
    let y = 1.0 - x;
    let (x2, y2) = (x * x, y * y);
    [
        y2 * y2 * y,
        5.0 * y2 * y2 * x,
        10.0 * y2 * y * x2,
        10.0 * y2 * x2 * x,
        5.0 * y * x2 * x2,
        x2 * x2 * x,
    ]
}

fn read(table: &[u8], index: usize) -> f64 {
    let mut bytes = [0; 4];
    bytes.copy_from_slice(&table[4 * index..4 * index + 4]);
    f64::from(f32::from_le_bytes(bytes))
}

#[cfg(test)]
mod tests;
