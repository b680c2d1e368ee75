//! Russian roulette (Arvo and Kirk 1990): long paths end at random, the survivors carry the light of the others.

use crate::color::Rgb;

/// The depth of the first vertex after which a path may end at random: shorter paths are worth their rays.
pub const FIRST_DEPTH: u32 = 5;

/// No path is sure to go on: with it, every path ends.
pub const MAX_SURVIVAL: f32 = 0.95;

/// The probability that a path whose throughput is `throughput` goes on after the vertex at `depth`; 1 before
/// [`FIRST_DEPTH`].
///
/// `radiance_scale` undoes the scale that refraction puts on radiance (squared ratio of indices), which is no loss of
/// light: a path inside glass carries less radiance per throughput and gets it back on the way out.
#[inline]
#[must_use]
pub fn survival(depth: u32, throughput: Rgb, radiance_scale: f32) -> f32 {
    if depth < FIRST_DEPTH {
        1.0
    } else {
        (throughput.max_channel() * radiance_scale).min(MAX_SURVIVAL)
    }
}
