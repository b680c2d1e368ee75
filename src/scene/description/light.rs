//! The `lights` block: one variant per kind of light that is no shape.

use crate::color::Rgb;
use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A light that is no shape. World space; directions have any length but zero. See [`crate::light`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "kind_of_light")]
#[schemars(rename = "Light")]
pub enum LightDescription {
    /// A point that shines alike in all directions. See [`Point`](crate::light::Point).
    Point {
        /// Where it is, in scene units.
        #[schemars(with = "quantity::Position")]
        position: [f32; 3],
        /// Power per solid angle, W sr⁻¹ per channel.
        #[schemars(with = "quantity::Intensity")]
        intensity: Rgb,
    },
    /// A point that shines into a cone. See [`Spot`](crate::light::Spot).
    Spot {
        /// Where it is, in scene units.
        #[schemars(with = "quantity::Position")]
        position: [f32; 3],
        /// A point on the cone's axis, in scene units; must differ from `position`.
        #[schemars(with = "quantity::Position")]
        target: [f32; 3],
        /// Power per solid angle inside the beam, W sr⁻¹ per channel.
        #[schemars(with = "quantity::Intensity")]
        intensity: Rgb,
        /// Half angle in degrees beyond which nothing shines, in [1e-3, 90]. Default 20.
        #[serde(default = "twenty")]
        #[schemars(with = "quantity::Cutoff")]
        cutoff: f32,
        /// Half angle in degrees inside which the intensity is full, in [0, `cutoff`]. Default: three quarters of
        /// `cutoff`.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Beam>")]
        beam: Option<f32>,
    },
    /// Parallel light from infinity. See [`Directional`](crate::light::Directional).
    Directional {
        /// The direction in which the light travels.
        #[schemars(with = "quantity::Direction")]
        direction: [f32; 3],
        /// Irradiance on a plane that faces the light, W m⁻² per channel.
        #[schemars(with = "quantity::Irradiance")]
        irradiance: Rgb,
    },
    /// Light from all around: of one radiance, or of a picture. See [`Constant`](crate::light::Constant) and
    /// [`Image`](crate::light::Image).
    Environment {
        /// Radiance from every direction, W sr⁻¹ m⁻² per channel. Required where there is no `file`.
        #[serde(default)]
        #[schemars(with = "Option<quantity::Radiance>")]
        radiance: Option<Rgb>,
        /// An EXR or HDR picture in latitude and longitude, relative to the folder of the scene file. Instead of
        /// `radiance`.
        #[serde(default)]
        #[schemars(with = "Option<quantity::FileName>")]
        file: Option<PathBuf>,
        /// Factor of the radiance. Default 1.
        #[serde(default = "one")]
        #[schemars(with = "quantity::Factor")]
        scale: f32,
        /// Direction of the picture's top row. Default (0, 1, 0).
        #[serde(default = "plus_y")]
        #[schemars(with = "quantity::Direction")]
        up: [f32; 3],
        /// Degrees by which the light is turned about `up`, counter-clockwise seen from its tip. Default 0.
        #[serde(default)]
        #[schemars(with = "quantity::Turn")]
        rotate: f32,
    },
    /// The sun's disc. See [`Sun`](crate::light::Sun).
    Sun {
        /// Towards the sun, not below the horizon.
        #[schemars(with = "quantity::Direction")]
        direction: [f32; 3],
        /// Haze of the air, in [1, 10]. Default 3.
        #[serde(default = "three")]
        #[schemars(with = "quantity::Turbidity")]
        turbidity: f32,
        /// Factor of the radiance. Default 1.
        #[serde(default = "one")]
        #[schemars(with = "quantity::Factor")]
        scale: f32,
        /// The zenith. Default (0, 1, 0).
        #[serde(default = "plus_y")]
        #[schemars(with = "quantity::Direction")]
        up: [f32; 3],
    },
    /// The sky without its sun. See [`Sky`](crate::light::Sky).
    Sky {
        /// Towards the sun, not below the horizon.
        #[schemars(with = "quantity::Direction")]
        sun_direction: [f32; 3],
        /// Haze of the air, in [1, 10]. Default 3.
        #[serde(default = "three")]
        #[schemars(with = "quantity::Turbidity")]
        turbidity: f32,
        /// Share of the light that the ground reflects, in [0, 1] per channel. Default 0.3.
        #[serde(default = "soil")]
        #[schemars(with = "quantity::Share")]
        albedo: Rgb,
        /// Factor of the radiance. Default 1.
        #[serde(default = "one")]
        #[schemars(with = "quantity::Factor")]
        scale: f32,
        /// The zenith. Default (0, 1, 0).
        #[serde(default = "plus_y")]
        #[schemars(with = "quantity::Direction")]
        up: [f32; 3],
    },
}

impl LightDescription {
    /// The variant's name.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Point { .. } => "Point",
            Self::Spot { .. } => "Spot",
            Self::Directional { .. } => "Directional",
            Self::Environment { .. } => "Environment",
            Self::Sun { .. } => "Sun",
            Self::Sky { .. } => "Sky",
        }
    }
}

fn one() -> f32 {
    1.0
}

fn three() -> f32 {
    3.0
}

fn twenty() -> f32 {
    20.0
}

fn soil() -> Rgb {
    Rgb::splat(0.3)
}

fn plus_y() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}
