//! A developed picture, and a borrowed look at the colours of any picture.

use super::layer::{LayerChannels, PictureLayer};
use crate::color::Rgb;

/// What a film shows: per pixel a colour, its standard error and the samples behind it. Row-major, top left first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear radiance.
    pub rgb: Vec<Rgb>,
    /// Standard error of `rgb`, per channel. Infinite where nothing is known of it (fewer than two samples); never
    /// not-a-number.
    pub error: Vec<Rgb>,
    /// Samples of the pixel.
    pub weight: Vec<f32>,
    /// Further values that a technique gives; none for most.
    pub layers: Vec<PictureLayer>,
}

impl Picture {
    /// A picture without further layers.
    #[must_use]
    pub const fn new(width: u32, height: u32, rgb: Vec<Rgb>, error: Vec<Rgb>, weight: Vec<f32>) -> Self {
        Self {
            width,
            height,
            rgb,
            error,
            weight,
            layers: Vec::new(),
        }
    }

    /// The picture with one layer more.
    #[must_use]
    pub fn with_layer(mut self, name: impl Into<String>, channels: LayerChannels) -> Self {
        self.layers.push(PictureLayer {
            name: name.into(),
            channels,
        });
        self
    }

    /// A look at the colours.
    #[must_use]
    pub fn view(&self) -> ImageView<'_> {
        ImageView {
            width: self.width,
            height: self.height,
            rgb: &self.rgb,
        }
    }
}

/// The colours of a picture, borrowed. Row-major, top left first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageView<'a> {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear colours, `width * height` of them.
    pub rgb: &'a [Rgb],
}
