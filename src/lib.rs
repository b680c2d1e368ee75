//! chainlight: an offline renderer for difficult light.

pub mod color;
pub mod math;
pub mod scene;
