//! `Directional`: light that comes from one direction everywhere.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `direction` | the direction in which the light travels | any length but zero | required |
//! | `irradiance` | on a plane that faces the light | W m⁻², [0, 1e12] per channel | required |
//!
//! Use it for a sun without a size; shadows are hard, and no path meets it. Do not use it where its shadows' edges, its image in
//! mirrors or its light by way of glass matter: a `Sun` has a disc, soft shadows, and shows in mirrors. It is the limit of a
//! distant light of a given irradiance (Pharr, Jakob and Humphreys 2023, §12.3).

use crate::color::Rgb;
use glam::Vec3;

/// A light at infinity in a single direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directional {
    /// Unit direction in which the light travels.
    pub direction: Vec3,
    /// Irradiance on a plane that faces the light, W m⁻².
    pub irradiance: Rgb,
}
