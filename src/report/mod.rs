//! What a study says, for people to look at. Everything here is made from the study's data alone.

mod curves;
mod log_axis;
mod markup;
mod page;
mod pictures;
mod series;
mod spectra;
mod tables;
pub mod words;

pub use curves::{Against, error_curves};
pub use page::page;
pub use pictures::Shown;
pub use spectra::error_spectra;

use plotters::drawing::DrawingAreaErrorKind;
use plotters::style::RGBColor;

/// Pixels of a plot.
const SIZE: (u32, u32) = (640, 440);
/// A plot's font.
const FONT: &str = "sans-serif";

/// Colours that are told apart by all eyes (Okabe and Ito 2008), one for every way, again from the first if there are more.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(70, 70, 70),
];

/// A plot could not be drawn.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("cannot draw a plot: {0}")]
pub struct PlotError(String);

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for PlotError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self(error.to_string())
    }
}

/// The colour of a way, by its number.
const fn color(way: usize) -> RGBColor {
    PALETTE[way % PALETTE.len()]
}
