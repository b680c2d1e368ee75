//! The `film` block.

use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The longest side of a film, in pixels.
pub const MAX_FILM_SIDE: u32 = 65_536;
/// The most pixels of a film.
pub const MAX_FILM_PIXELS: u64 = 1 << 28;
/// The darkest and the brightest exposure of a PNG beside its automatic one, in stops.
pub const EXPOSURE: [f32; 2] = [-32.0, 32.0];

/// The film: its size in pixels and its reconstruction filter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "film")]
#[schemars(rename = "Film")]
pub struct FilmDescription {
    /// Pixels from left to right, in 1..=[`MAX_FILM_SIDE`].
    #[schemars(with = "quantity::FilmSide")]
    pub width: u32,
    /// Pixels from top to bottom, in 1..=[`MAX_FILM_SIDE`]; `width * height` is at most [`MAX_FILM_PIXELS`].
    #[schemars(with = "quantity::FilmSide")]
    pub height: u32,
    /// The reconstruction filter. Default `Box(radius: 0.5)`: every sample counts in its own pixel alone.
    #[serde(default)]
    pub filter: FilterDescription,
    /// By how many stops the PNG is shown brighter than its automatic exposure, which takes the geometric mean of what is lit
    /// to middle grey; in [-32, 32], darker below 0. The EXR file has the light itself. Default 0.
    #[serde(default)]
    #[schemars(with = "quantity::Exposure")]
    pub exposure: f32,
}

/// A separable reconstruction filter, zero outside a square. Radii are in pixels, in [0.5, 16]: half the side of the
/// square; a smaller one would lose light between pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "kind_of_filter")]
#[schemars(rename = "Filter")]
pub enum FilterDescription {
    /// Constant.
    Box {
        /// Radius in pixels. Default 0.5.
        #[serde(default = "half")]
        #[schemars(with = "quantity::FilterRadius")]
        radius: f32,
    },
    /// Falls linearly to zero at the radius.
    Tent {
        /// Radius in pixels. Default 1.
        #[serde(default = "one")]
        #[schemars(with = "quantity::FilterRadius")]
        radius: f32,
    },
    /// A Gaussian, lowered so that it is zero at the radius.
    Gaussian {
        /// Radius in pixels. Default 1.5.
        #[serde(default = "one_and_a_half")]
        #[schemars(with = "quantity::FilterRadius")]
        radius: f32,
        /// Standard deviation in pixels, in [0.05, 16], and at least 0.03 times the radius. Default 0.5.
        #[serde(default = "half")]
        #[schemars(with = "quantity::FilterSigma")]
        sigma: f32,
    },
}

impl Default for FilterDescription {
    fn default() -> Self {
        Self::Box { radius: half() }
    }
}

fn half() -> f32 {
    0.5
}

fn one() -> f32 {
    1.0
}

fn one_and_a_half() -> f32 {
    1.5
}
