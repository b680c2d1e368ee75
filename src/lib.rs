//! chainlight: an offline renderer for difficult light.

pub mod cli;
pub mod color;
pub mod film;
pub mod math;
pub mod stats;
