//! The `materials` block: one variant per model.

use super::ColorDescription;
use crate::color::Rgb;
use crate::material::microfacet::Distribution;
use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A material: how a surface scatters light. Ratios are dimensionless, per channel.
///
/// `two_sided`: true shades both sides alike; false makes the back (the side away from the geometric normal) black.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "kind_of_material")]
#[schemars(rename = "Material")]
pub enum MaterialDescription {
    /// Lambertian reflection.
    Diffuse {
        /// Share of the light that is reflected, in [0, 1].
        reflectance: ColorDescription,
        /// Whether the back reflects like the front. Default true.
        #[serde(default = "yes")]
        two_sided: bool,
    },
    /// A smooth metal: mirror reflection by Fresnel's equations for a complex index eta + i k.
    Conductor {
        /// A metal by its symbol, such as `"Au"` ([`METALS`](crate::material::metals::METALS)). This, or `eta` and `k`.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Metal>")]
        metal: Option<String>,
        /// Real part of the index of refraction, in [0, 1000].
        #[serde(default)]
        #[schemars(with = "Option<quantity::ComplexIndex>")]
        eta: Option<Rgb>,
        /// Absorption coefficient, in [0, 1000]; not zero in a channel where `eta` is zero too.
        #[serde(default)]
        #[schemars(with = "Option<quantity::ComplexIndex>")]
        k: Option<Rgb>,
        /// Scale of the reflection, in [0, 1]. Default 1, which is physical.
        #[serde(default = "white")]
        reflectance: ColorDescription,
        /// Whether the back reflects like the front. Default true.
        #[serde(default = "yes")]
        two_sided: bool,
    },
    /// A rough metal: a blurred mirror.
    RoughConductor {
        /// A metal by its symbol, such as `"Au"` ([`METALS`](crate::material::metals::METALS)). This, or `eta` and `k`.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Metal>")]
        metal: Option<String>,
        /// Real part of the index of refraction, in [0, 1000].
        #[serde(default)]
        #[schemars(with = "Option<quantity::ComplexIndex>")]
        eta: Option<Rgb>,
        /// Absorption coefficient, in [0, 1000]; not zero in a channel where `eta` is zero too.
        #[serde(default)]
        #[schemars(with = "Option<quantity::ComplexIndex>")]
        k: Option<Rgb>,
        /// How the slopes of its facets are distributed. Default `Ggx`.
        #[serde(default)]
        distribution: Distribution,
        /// Roughness in all directions, in [1e-4, 1]. This, or both of the next.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Roughness>")]
        alpha: Option<f32>,
        /// Roughness along the direction in which the texture coordinate u grows.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Roughness>")]
        alpha_u: Option<f32>,
        /// Roughness across it.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Roughness>")]
        alpha_v: Option<f32>,
        /// Scale of the reflection, in [0, 1]. Default 1, which is physical.
        #[serde(default = "white")]
        reflectance: ColorDescription,
        /// Whether the back reflects like the front. Default true.
        #[serde(default = "yes")]
        two_sided: bool,
    },
    /// A smooth interface between two clear media: mirror reflection and refraction.
    Dielectric {
        /// Index of refraction of the side that the geometric normal points away from, in [0.1, 10]. Glass: 1.5.
        #[schemars(with = "quantity::RefractiveIndex")]
        interior_ior: f32,
        /// Index of refraction of the side that the geometric normal points into, in [0.1, 10]. Default 1: vacuum.
        #[serde(default = "vacuum")]
        #[schemars(with = "quantity::RefractiveIndex")]
        exterior_ior: f32,
        /// Scale of the reflection, in [0, 1]. Default 1, which is physical.
        #[serde(default = "ones")]
        #[schemars(with = "quantity::Share")]
        reflectance: Rgb,
        /// Scale of the refraction, in [0, 1]. Default 1, which is physical.
        #[serde(default = "ones")]
        #[schemars(with = "quantity::Share")]
        transmittance: Rgb,
    },
    /// A rough interface between two clear media: blurred reflection and refraction.
    RoughDielectric {
        /// Index of refraction of the side that the geometric normal points away from, in [0.1, 10]. Glass: 1.5.
        #[schemars(with = "quantity::RefractiveIndex")]
        interior_ior: f32,
        /// Index of refraction of the side that the geometric normal points into, in [0.1, 10]. Default 1: vacuum.
        #[serde(default = "vacuum")]
        #[schemars(with = "quantity::RefractiveIndex")]
        exterior_ior: f32,
        /// How the slopes of its facets are distributed. Default `Ggx`.
        #[serde(default)]
        distribution: Distribution,
        /// Roughness in all directions, in [1e-4, 1]. This, or both of the next.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Roughness>")]
        alpha: Option<f32>,
        /// Roughness along the direction in which the texture coordinate u grows.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Roughness>")]
        alpha_u: Option<f32>,
        /// Roughness across it.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Roughness>")]
        alpha_v: Option<f32>,
        /// Scale of the reflection, in [0, 1]. Default 1, which is physical.
        #[serde(default = "ones")]
        #[schemars(with = "quantity::Share")]
        reflectance: Rgb,
        /// Scale of the refraction, in [0, 1]. Default 1, which is physical.
        #[serde(default = "ones")]
        #[schemars(with = "quantity::Share")]
        transmittance: Rgb,
    },
    /// A smooth clear coat over a matt base.
    Plastic {
        /// Index of refraction of the coat, in [0.1, 10]. Default 1.49: acrylic glass.
        #[serde(default = "acrylic")]
        #[schemars(with = "quantity::RefractiveIndex")]
        interior_ior: f32,
        /// Index of refraction of what is before it, in [0.1, 10]. Default 1: vacuum.
        #[serde(default = "vacuum")]
        #[schemars(with = "quantity::RefractiveIndex")]
        exterior_ior: f32,
        /// Share of the light that the base reflects, in [0, 1]. Default 0.5.
        #[serde(default = "grey")]
        diffuse_reflectance: ColorDescription,
        /// Scale of the reflection in the coat, in [0, 1]. Default 1, which is physical.
        #[serde(default = "white")]
        specular_reflectance: ColorDescription,
        /// Whether light that the coat throws back onto the base is coloured each time. Default false.
        #[serde(default)]
        nonlinear: bool,
        /// Whether the back reflects like the front. Default true.
        #[serde(default = "yes")]
        two_sided: bool,
    },
    /// A sheet whose sides differ. Light does not pass it.
    TwoSided {
        /// Name of the material on the side of the geometric normal: an opaque one.
        #[schemars(with = "quantity::Name")]
        front: String,
        /// Name of the material on the other side. It is seen there as it would be from its own front.
        #[schemars(with = "quantity::Name")]
        back: String,
    },
}

impl MaterialDescription {
    /// Whether a surface of it does nothing to light: an interface between equal indices that lets all of it pass.
    #[must_use]
    pub fn is_null(&self) -> bool {
        match self {
            Self::Dielectric {
                interior_ior,
                exterior_ior,
                transmittance,
                ..
            }
            | Self::RoughDielectric {
                interior_ior,
                exterior_ior,
                transmittance,
                ..
            } => interior_ior == exterior_ior && *transmittance == Rgb::ONE,
            _ => false,
        }
    }
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

fn acrylic() -> f32 {
    1.49
}

fn white() -> ColorDescription {
    Rgb::ONE.into()
}

fn grey() -> ColorDescription {
    Rgb::splat(0.5).into()
}
