//! One integration-test binary; each concern is a module beside this file.

mod broken_scenes;
mod command_line;
mod geometry;
mod rendering;
mod scene_fuzz;
