//! Where on the film a path's light falls.

use crate::sampling::{Purpose, StreamKey};
use crate::scene::Scene;
use glam::Vec2;

/// A film position for a sample of `pixel`, drawn from the filter's density about the pixel's centre: the sample then
/// counts fully for that pixel and for no other (Ernst, Stamminger and Greiner 2006, "Filter importance sampling").
#[inline]
#[must_use]
pub fn film_position(scene: &Scene, key: StreamKey, pixel: u32) -> Vec2 {
    let center = Vec2::new((pixel % scene.width) as f32 + 0.5, (pixel / scene.width) as f32 + 0.5);
    center + Vec2::from_array(scene.filter.sample(key.stream(Purpose::FILM, 0).next_pair()))
}
