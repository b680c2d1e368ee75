//! One integration-test binary; each concern is a module beside this file.

mod both_ends;
mod broken_scenes;
mod chains;
mod check;
mod command_line;
mod geometry;
mod histogram;
mod layers;
mod path_space;
mod physics;
mod rendering;
mod replay;
mod samplers;
mod scene_fuzz;
mod schema;
mod support;
