//! chainlight: an offline renderer for difficult light.

pub mod color;
pub mod geometry;
pub mod math;
pub mod sampling;
pub mod table;
pub mod tolerance;
