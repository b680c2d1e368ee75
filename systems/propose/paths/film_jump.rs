//! What perturbations share that begin on the film: another place there, near the current one, and the ray through it.

use super::moves_paths::{PathProposal, Way};
use super::view::PathView;
use crate::path::pixel_of;
use crate::path::whole::{Sizes, jump};
use crate::sampling::{Purpose, StreamKey};
use crate::scene::Scene;

/// The smallest step on the film by default, in pixels.
pub const SMALLEST: f32 = 0.1;
/// The share of the film that a disc of the largest step covers by default.
pub const COVERED: f32 = 0.05;

/// The distances on the film, in pixels, from `smallest` to the radius of a disc that covers this share of the film.
#[must_use]
pub fn film_sizes(scene: &Scene, smallest: f32, covered: f32) -> Sizes {
    let area = f64::from(covered) * f64::from(scene.width) * f64::from(scene.height);
    Sizes {
        smallest: f64::from(smallest),
        // On films of a few pixels too there is a range.
        largest: libm::sqrt(area / std::f64::consts::PI).max(2.0 * f64::from(smallest)),
    }
}

/// Says what is wrong with the settings of [`film_sizes`].
///
/// # Errors
/// The setting, what was expected, and what it is.
pub fn check_film_sizes(smallest: f32, covered: f32) -> Result<(), String> {
    if !(smallest > 0.0 && smallest <= 1e3) {
        return Err(format!(
            "`smallest` is a number of pixels above 0, up to 1000, not {smallest}"
        ));
    }
    if !(covered > 0.0 && covered <= 1.0) {
        return Err(format!(
            "`covered` is a share of the film, above 0, up to 1, not {covered}"
        ));
    }
    Ok(())
}

/// The path that begins through a place on the film as far from the current one as a size says, and is joined to what the current
/// path's first two neighbours that can be joined are. `None` where that place is not on the film.
#[must_use]
pub fn film_jump(path: &PathView<'_>, sizes: Sizes, key: StreamKey) -> Option<PathProposal> {
    let mut stream = key.stream(Purpose::PERTURB_LENS, 0);
    let moved = jump(path.film, sizes.sample(stream.next_f64()), stream.next_f64());
    pixel_of(path.scene, moved, 0.5)?;
    let t = path.camera_vertices();
    let s = path.edges + 1 - t;
    Some(PathProposal {
        film: Some(moved),
        ..PathProposal::new([1, s], [t, s])
    })
}

/// T / r of these proposals. The place on the film, and every direction that is drawn about another, has a density that is the same
/// both ways. They stand in for the densities of bidirectional path tracing, as does the certainty of discrete lobes.
#[must_use]
pub fn film_jump_density(way: &Way<'_>) -> f64 {
    let t = way.made;
    let steered: f64 = (1..t - 1).map(|i| way.to.onward(i)).product();
    let kept_light = if way.kept[1] == 1 { way.to.kept_light } else { 1.0 };
    way.to.share(t) * kept_light / (steered * f64::from(way.to.filter))
}
