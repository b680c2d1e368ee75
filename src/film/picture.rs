//! A developed picture, and a borrowed look at the colours of any picture.

use crate::color::Rgb;

/// What a film shows: per pixel a colour, its standard error and the samples behind it. Row-major, top left first.
#[derive(Clone, Debug, PartialEq)]
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
}

impl Picture {
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
