//! The `materials` block: one variant per model.

use crate::color::Rgb;
use serde::{Deserialize, Serialize};

/// A material: how a surface scatters light. Ratios are dimensionless, per channel.
///
/// `two_sided`: true shades both sides alike; false makes the back (the side away from the geometric normal) black.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "kind_of_material")]
pub enum MaterialDescription {
    /// Lambertian reflection.
    Diffuse {
        /// Share of the light that is reflected, in [0, 1].
        reflectance: Rgb,
        /// Whether the back reflects like the front. Default true.
        #[serde(default = "yes")]
        two_sided: bool,
    },
    /// A smooth metal: mirror reflection by Fresnel's equations for a complex index eta + i k.
    Conductor {
        /// Real part of the index of refraction, >= 0.
        eta: Rgb,
        /// Absorption coefficient, >= 0; not zero in a channel where `eta` is zero too.
        k: Rgb,
        /// Scale of the reflection, in [0, 1]. Default 1, which is physical.
        #[serde(default = "ones")]
        reflectance: Rgb,
        /// Whether the back reflects like the front. Default true.
        #[serde(default = "yes")]
        two_sided: bool,
    },
    /// A smooth interface between two clear media: mirror reflection and refraction.
    Dielectric {
        /// Index of refraction of the side that the geometric normal points away from, in [0.1, 10]. Glass: 1.5.
        interior_ior: f32,
        /// Index of refraction of the side that the geometric normal points into, in [0.1, 10]. Default 1: vacuum.
        #[serde(default = "vacuum")]
        exterior_ior: f32,
        /// Scale of the reflection, in [0, 1]. Default 1, which is physical.
        #[serde(default = "ones")]
        reflectance: Rgb,
        /// Scale of the refraction, in [0, 1]. Default 1, which is physical.
        #[serde(default = "ones")]
        transmittance: Rgb,
    },
}

fn yes() -> bool {
    true
}

fn ones() -> Rgb {
    Rgb::ONE
}

fn vacuum() -> f32 {
    1.0
}
