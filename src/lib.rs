//! chainlight: an offline renderer for difficult light.

pub mod camera;
pub mod cli;
pub mod color;
pub mod film;
pub mod geometry;
pub mod light;
pub mod material;
pub mod math;
pub mod path;
pub mod plan;
pub mod render;
pub mod sampling;
pub mod scene;
pub mod stats;
#[path = "../systems/mod.rs"]
pub mod systems;
pub mod table;
pub mod tolerance;
