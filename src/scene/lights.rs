//! From the `lights` block to lights in the world.

use super::at::{At, wide};
use super::description::LightDescription;
use super::environment_picture;
use super::error::SceneError;
use crate::light::{Constant, Directional, Light, Point, Sky, Spot, Sun};
use glam::Vec3;
use std::sync::Arc;

/// The share of a spot's cutoff that its beam takes where nothing is said.
const BEAM_SHARE: f32 = 0.75;

/// Makes a light of a description that validation has passed; reads the picture that it names.
///
/// # Errors
/// A picture that cannot be used.
pub(super) fn place(at: &At, light: &LightDescription) -> Result<Light, SceneError> {
    Ok(match light {
        LightDescription::Point { position, intensity } => Light::Point(Point {
            position: Vec3::from_array(*position),
            intensity: *intensity,
        }),
        LightDescription::Spot {
            position,
            target,
            intensity,
            cutoff,
            beam,
        } => {
            let axis = wide(*target) - wide(*position);
            let beam = beam.unwrap_or(BEAM_SHARE * cutoff);
            Light::Spot(Spot::new(Vec3::from_array(*position), axis, *intensity, *cutoff, beam))
        }
        LightDescription::Directional { direction, irradiance } => Light::Directional(Directional {
            direction: wide(*direction).normalize().as_vec3(),
            irradiance: *irradiance,
        }),
        LightDescription::Environment {
            radiance,
            file,
            scale,
            up,
            rotate,
        } => match (radiance, file) {
            (_, Some(file)) => {
                let at = at.variant("Environment").key("file");
                Light::Image(Arc::new(environment_picture::read(
                    &at,
                    file,
                    *scale,
                    wide(*up),
                    *rotate,
                )?))
            }
            (radiance, None) => Light::Constant(Constant {
                radiance: radiance.unwrap_or_default() * *scale,
            }),
        },
        LightDescription::Sun {
            direction,
            turbidity,
            scale,
            up,
        } => Light::Sun(Sun::through_air(wide(*direction), wide(*up), *turbidity, *scale)),
        LightDescription::Sky {
            sun_direction,
            turbidity,
            albedo,
            scale,
            up,
        } => {
            let sky = Sky::new(wide(*sun_direction), wide(*up), *turbidity, *albedo, *scale);
            Light::Sky(Arc::new(sky))
        }
    })
}
