//! chainlight: an offline renderer for difficult light.

pub mod camera;
pub mod color;
pub mod geometry;
pub mod light;
pub mod material;
pub mod math;
pub mod path;
pub mod sampling;
pub mod scene;
pub mod table;
pub mod tolerance;
