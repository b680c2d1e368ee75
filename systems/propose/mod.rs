//! The propose stage: what each chain tries next.

mod assign_pixels;
mod start_camera_paths;

pub use assign_pixels::assign_pixels;
pub use start_camera_paths::start_camera_paths;
