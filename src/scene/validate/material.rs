//! Checks of the `materials` block.

use crate::color::Rgb;
use crate::scene::at::At;
use crate::scene::description::MaterialDescription;
use crate::scene::error::SceneError;

/// The largest index of refraction or absorption coefficient of a conductor.
const MAX_CONDUCTOR_INDEX: f32 = 1000.0;
const METALS: &str = "gold: eta (0.14, 0.38, 1.44), k (3.98, 2.39, 1.60)";

pub(super) fn check(at: &At, material: &MaterialDescription) -> Result<(), SceneError> {
    match material {
        MaterialDescription::Diffuse {
            reflectance,
            two_sided: _,
        } => ratio(&at.variant("Diffuse").key("reflectance"), *reflectance),
        MaterialDescription::Conductor {
            eta,
            k,
            reflectance,
            two_sided: _,
        } => {
            let at = at.variant("Conductor");
            at.key("eta")
                .each_within(eta.to_array(), 0.0, MAX_CONDUCTOR_INDEX, METALS)?;
            at.key("k")
                .each_within(k.to_array(), 0.0, MAX_CONDUCTOR_INDEX, METALS)?;
            ratio(&at.key("reflectance"), *reflectance)?;
            let both = eta.to_array().into_iter().zip(k.to_array());
            for (channel, (eta, k)) in both.enumerate() {
                if eta == 0.0 && k == 0.0 {
                    let message = "`eta` and `k` are both zero in a channel, which no medium is";
                    return Err(at
                        .key("k")
                        .index(channel)
                        .error(message, format!("a perfect mirror: k (1, 1, 1); {METALS}")));
                }
            }
            Ok(())
        }
        MaterialDescription::Dielectric {
            interior_ior,
            exterior_ior,
            reflectance,
            transmittance,
        } => {
            let at = at.variant("Dielectric");
            let help = "an index of refraction: vacuum 1, water 1.33, glass 1.5, diamond 2.4";
            at.key("interior_ior").within(*interior_ior, 0.1, 10.0, help)?;
            at.key("exterior_ior").within(*exterior_ior, 0.1, 10.0, help)?;
            ratio(&at.key("reflectance"), *reflectance)?;
            ratio(&at.key("transmittance"), *transmittance)
        }
    }
}

/// A share of light: more than 1 would make light out of nothing, and paths would never end.
fn ratio(at: &At, ratio: Rgb) -> Result<(), SceneError> {
    at.each_within(
        ratio.to_array(),
        0.0,
        1.0,
        "a share of the light that arrives; brightness belongs into `emission`",
    )
}
