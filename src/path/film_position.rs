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

/// The pixel that light counts for which arrives at the film position `film`, chosen with `u` in proportion to the filters of
/// the pixels around, and the sum of those: the light has to be multiplied with it. `None` where no pixel's filter reaches;
/// beyond the film's edges some do, so that pixels there are no darker.
///
/// It is [`film_position`] from the other side: what one pixel takes from a place by chance is what the other gives to it.
#[inline]
#[must_use]
pub fn pixel_of(scene: &Scene, film: Vec2, u: f32) -> Option<(u32, f32)> {
    let radius = scene.filter.radius();
    let range = |x: f32, pixels: u32| {
        // Pixel i has its centre at i + 1/2. Half open, so that a place between two pixels belongs to one of them. Casts
        // saturate, so that nothing far away wraps around.
        let first = ((x - radius - 0.5).floor() + 1.0).max(0.0);
        let last = (x + radius - 0.5).floor().min(pixels as f32 - 1.0);
        (first <= last).then_some((first as u32, last as u32))
    };
    let ((x0, x1), (y0, y1)) = (range(film.x, scene.width)?, range(film.y, scene.height)?);
    let filter = |x: u32, y: u32| {
        scene
            .filter
            .density([film.x - (x as f32 + 0.5), film.y - (y as f32 + 0.5)])
    };
    let pixels = || (y0..=y1).flat_map(move |y| (x0..=x1).map(move |x| (x, y)));
    let sum: f32 = pixels().map(|(x, y)| filter(x, y)).sum();
    let mut left = u * sum;
    let mut chosen = None;
    for (x, y) in pixels() {
        let share = filter(x, y);
        if share > 0.0 {
            chosen = Some(y * scene.width + x);
            if left < share {
                break;
            }
        }
        left -= share;
    }
    chosen.map(|pixel| (pixel, sum))
}
