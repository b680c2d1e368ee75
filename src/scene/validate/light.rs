//! Checks of the `lights` block. Pictures are checked where they are read.

use crate::light::TURBIDITY;
use crate::scene::at::At;
use crate::scene::description::LightDescription;
use crate::scene::error::SceneError;
use crate::scene::limits::{MAX_CUTOFF, MAX_RADIANCE, MAX_TURN, MIN_CUTOFF};

/// The smallest distance from a spot to its target, relative to their coordinates: nearer, the direction would be
/// rounding noise of `f32`.
const MIN_AIM_DISTANCE: f64 = 1.0e-6;

pub(super) fn check(at: &At, light: &LightDescription) -> Result<(), SceneError> {
    let at = at.variant(light.name());
    match light {
        LightDescription::Point { position, intensity } => {
            at.key("position").lengths(*position)?;
            power(&at.key("intensity"), intensity.to_array(), INTENSITY)
        }
        LightDescription::Spot {
            position,
            target,
            intensity,
            cutoff,
            beam,
        } => {
            let from = at.key("position").lengths(*position)?;
            let to = at.key("target").lengths(*target)?;
            if (to - from).length() <= (MIN_AIM_DISTANCE * from.length().max(to.length())).max(1.0e-9) {
                let message = "the spot's target is its position, so that it shines nowhere";
                return Err(at
                    .key("target")
                    .error(message, "put the target where the spot should shine"));
            }
            power(&at.key("intensity"), intensity.to_array(), INTENSITY)?;
            let help = "the angle between the axis and the edge of the light, in degrees; 20 is the default";
            at.key("cutoff").within(*cutoff, MIN_CUTOFF, MAX_CUTOFF, help)?;
            match beam {
                Some(beam) => {
                    let help = "the full intensity ends there: not beyond `cutoff`";
                    at.key("beam").within(*beam, 0.0, *cutoff, help)
                }
                None => Ok(()),
            }
        }
        LightDescription::Directional { direction, irradiance } => {
            at.key("direction").direction(*direction)?;
            let help = "irradiance in W m^-2; the sun's is near 1000 over all wavelengths";
            power(&at.key("irradiance"), irradiance.to_array(), help)
        }
        LightDescription::Environment {
            radiance,
            file,
            scale,
            up,
            rotate,
        } => {
            match (radiance, file) {
                (Some(radiance), None) => {
                    let help = "radiance in W sr^-1 m^-2; an overcast sky is near 10 over all wavelengths";
                    power(&at.key("radiance"), radiance.to_array(), help)?;
                    let brightest = radiance.max_channel() * scale;
                    if brightest > MAX_RADIANCE {
                        let message = format!("`radiance` times `scale` is {brightest:e}, more than {MAX_RADIANCE:e}");
                        return Err(at.key("scale").error(message, "choose a smaller `scale`"));
                    }
                }
                (None, Some(file)) if file.as_os_str().is_empty() => {
                    let message = "expected the name of an EXR or HDR picture";
                    return Err(at.key("file").error(message, "such as `file: \"sky.exr\"`"));
                }
                (None, Some(_)) => {}
                (None, None) => {
                    let message = "this environment has no light: expected `radiance` or `file`";
                    return Err(at.error(message, "such as `radiance: (1, 1, 1)` or `file: \"sky.exr\"`"));
                }
                (Some(_), Some(_)) => {
                    let message = "this environment has both `radiance` and `file`";
                    return Err(at
                        .key("file")
                        .error(message, "leave one of them out; `scale` makes a picture brighter"));
                }
            }
            factor(&at, *scale)?;
            at.key("up").direction(*up)?;
            at.key("rotate")
                .within(*rotate, -MAX_TURN, MAX_TURN, "an angle in degrees")
        }
        LightDescription::Sun {
            direction,
            turbidity,
            scale,
            up,
        } => {
            above_horizon(&at, "direction", *direction, *up)?;
            air(&at, *turbidity)?;
            factor(&at, *scale)
        }
        LightDescription::Sky {
            sun_direction,
            turbidity,
            albedo,
            scale,
            up,
        } => {
            above_horizon(&at, "sun_direction", *sun_direction, *up)?;
            air(&at, *turbidity)?;
            let help = "the share of light that the ground reflects; grass 0.2, snow 0.8";
            at.key("albedo").each_within(albedo.to_array(), 0.0, 1.0, help)?;
            factor(&at, *scale)
        }
    }
}

const INTENSITY: &str = "intensity in W sr^-1; a point of 1 W has 0.08";

fn power(at: &At, values: [f32; 3], help: &str) -> Result<(), SceneError> {
    at.each_within(values, 0.0, MAX_RADIANCE, help)
}

fn factor(at: &At, scale: f32) -> Result<(), SceneError> {
    at.key("scale")
        .within(scale, 0.0, MAX_RADIANCE, "1 leaves the radiance as it is")
}

fn air(at: &At, turbidity: f32) -> Result<(), SceneError> {
    let help = "the haze of the air: 2 very clear, 3 clear, 6 hazy, 10 thick haze";
    at.key("turbidity").within(turbidity, TURBIDITY[0], TURBIDITY[1], help)
}

fn above_horizon<'a>(at: &At<'a>, name: &'a str, sun: [f32; 3], up: [f32; 3]) -> Result<(), SceneError> {
    let zenith = at.key("up").direction(up)?;
    let at = at.key(name);
    let sun = at.direction(sun)?;
    if sun.dot(zenith) < 0.0 {
        let message = "the sun is below the horizon, where the model of the sky ends";
        let help = "this direction leads towards the sun; `up` is the zenith";
        return Err(at.error(message, help));
    }
    Ok(())
}
