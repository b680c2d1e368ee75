//! Columns of states that reach the film: a state's contribution is a list of splats, since one state of a technique that
//! connects light paths to the lens reaches many pixels. Splat k of chain c has number k · capacity + c, in one table for
//! current states and one for proposals.

use crate::color::Rgb;
use crate::columns;
use crate::table::Table;
use bevy_ecs::component::Component;
use bevy_ecs::query::Without;

/// Marks the rows of the table of current states' splats.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct SplatTable;

impl Table for SplatTable {
    type Apart = Without<ProposedSplatTable>;
}

/// Marks the rows of the table of proposals' splats.
#[derive(Component, Clone, Copy, Debug, Default)]
pub struct ProposedSplatTable;

impl Table for ProposedSplatTable {
    type Apart = Without<SplatTable>;
}

columns! {
    /// Splats of the current state.
    pub SplatCount: u32;
    /// Splats of the proposal.
    pub ProposedSplatCount: u32;
    /// Row-major number of the pixel that a splat reaches.
    pub SplatPixel: u32;
    /// The splat's contribution divided by the target of its whole state: what a weight of one adds to the film.
    pub SplatColor: Rgb;
}

/// The target function of a state that contributes `light`: the sum of its channels' magnitudes. It is zero only where the
/// light is black in every channel, so that no light goes unsampled for its colour.
#[inline]
#[must_use]
pub fn target_of(light: Rgb) -> f32 {
    let [r, g, b] = light.to_array();
    r.abs() + g.abs() + b.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_of_any_colour_has_a_target() {
        let tiny = f32::from_bits(1);
        for light in [
            Rgb::new(0.0, 0.0, tiny),
            Rgb::new(-0.3, 0.1, 0.2),
            Rgb::new(0.0, -1.0, 0.0),
        ] {
            assert!(target_of(light) > 0.0, "{light:?}");
        }
        assert_eq!(target_of(Rgb::BLACK), 0.0);
        assert!(!target_of(Rgb::splat(f32::MAX)).is_finite());
        assert!(target_of(Rgb::new(f32::NAN, 1.0, 1.0)).is_nan());
    }
}
