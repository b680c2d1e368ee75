//! One integration-test binary; each concern is a module beside this file.
#![expect(
    clippy::print_stdout,
    reason = "tests print the smallest bias that they could have seen"
)]

mod broken_scenes;
mod command_line;
mod geometry;
mod histogram;
mod physics;
mod rendering;
mod replay;
mod samplers;
mod scene_fuzz;
mod support;
