//! Random numbers and how they are turned into directions, points and choices.

pub mod discrete;
mod stream;
pub mod warp;

pub use stream::{Purpose, Stream, StreamKey};
