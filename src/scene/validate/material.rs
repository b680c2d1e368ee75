//! Checks of the `materials` block.

use crate::color::Rgb;
use crate::material::metals::{self, METALS};
use crate::scene::at::At;
use crate::scene::description::{ColorDescription, MaterialDescription};
use crate::scene::error::{SceneError, nearest_name};
use crate::scene::limits::{IOR, MAX_CONDUCTOR_INDEX};
use crate::tolerance::LEAST_ROUGHNESS;
use std::collections::BTreeMap;

const METAL: &str = "a metal by name: `metal: \"Au\"`; or in numbers: eta (0.08, 0.41, 1.56), k (3.39, 2.50, 1.77)";
const IOR_HELP: &str = "an index of refraction: vacuum 1, water 1.33, glass 1.5, diamond 2.4";

/// What a material may name.
pub(super) struct Known<'a> {
    /// Every material of the scene file.
    pub(super) materials: &'a BTreeMap<String, MaterialDescription>,
    /// Names of its textures.
    pub(super) textures: Vec<&'a str>,
}

pub(super) fn check(at: &At, material: &MaterialDescription, known: &Known) -> Result<(), SceneError> {
    match material {
        MaterialDescription::Diffuse {
            reflectance,
            two_sided: _,
        } => known.color(&at.variant("Diffuse").key("reflectance"), reflectance),
        MaterialDescription::Conductor {
            metal,
            eta,
            k,
            reflectance,
            two_sided: _,
        } => {
            let at = at.variant("Conductor");
            complex_index(&at, metal.as_deref(), [*eta, *k])?;
            known.color(&at.key("reflectance"), reflectance)
        }
        MaterialDescription::RoughConductor {
            metal,
            eta,
            k,
            distribution: _,
            alpha,
            alpha_u,
            alpha_v,
            reflectance,
            two_sided: _,
        } => {
            let at = at.variant("RoughConductor");
            complex_index(&at, metal.as_deref(), [*eta, *k])?;
            roughness(&at, [*alpha, *alpha_u, *alpha_v], "Conductor")?;
            known.color(&at.key("reflectance"), reflectance)
        }
        MaterialDescription::Dielectric {
            interior_ior,
            exterior_ior,
            reflectance,
            transmittance,
        } => {
            let at = at.variant("Dielectric");
            indices(&at, [*interior_ior, *exterior_ior])?;
            ratio(&at.key("reflectance"), *reflectance)?;
            ratio(&at.key("transmittance"), *transmittance)
        }
        MaterialDescription::RoughDielectric {
            interior_ior,
            exterior_ior,
            distribution: _,
            alpha,
            alpha_u,
            alpha_v,
            reflectance,
            transmittance,
        } => {
            let at = at.variant("RoughDielectric");
            indices(&at, [*interior_ior, *exterior_ior])?;
            roughness(&at, [*alpha, *alpha_u, *alpha_v], "Dielectric")?;
            ratio(&at.key("reflectance"), *reflectance)?;
            ratio(&at.key("transmittance"), *transmittance)
        }
        MaterialDescription::Plastic {
            interior_ior,
            exterior_ior,
            diffuse_reflectance,
            specular_reflectance,
            nonlinear: _,
            two_sided: _,
        } => {
            let at = at.variant("Plastic");
            indices(&at, [*interior_ior, *exterior_ior])?;
            known.color(&at.key("diffuse_reflectance"), diffuse_reflectance)?;
            known.color(&at.key("specular_reflectance"), specular_reflectance)
        }
        MaterialDescription::TwoSided { front, back } => {
            let at = at.variant("TwoSided");
            known.side(&at.key("front"), front)?;
            known.side(&at.key("back"), back)
        }
    }
}

impl Known<'_> {
    /// A colour that is a share of light, or the name of a texture, whose own values are checked where it stands.
    fn color(&self, at: &At, color: &ColorDescription) -> Result<(), SceneError> {
        match color {
            ColorDescription::Constant(color) => ratio(at, Rgb::from(*color)),
            ColorDescription::Texture(name) if self.textures.contains(&name.as_str()) => Ok(()),
            ColorDescription::Texture(name) => {
                let help = match self.textures.is_empty() {
                    true => {
                        "the scene has no textures; a colour stands in round brackets: `(0.8, 0.2, 0.2)`".to_owned()
                    }
                    false => nearest_name(name, self.textures.iter().copied()),
                };
                Err(at.error(format!("unknown texture `{name}`"), help))
            }
        }
    }

    /// The name of a material that can be one side of a sheet.
    fn side(&self, at: &At, name: &str) -> Result<(), SceneError> {
        match self.materials.get(name) {
            None => {
                let help = nearest_name(name, self.materials.keys().map(String::as_str));
                Err(at.error(format!("unknown material `{name}`"), help))
            }
            Some(MaterialDescription::TwoSided { .. }) => Err(at.error(
                format!("`{name}` has two sides itself"),
                "name the material of the side that you mean",
            )),
            Some(MaterialDescription::Dielectric { .. } | MaterialDescription::RoughDielectric { .. }) => Err(at
                .error(
                    format!("`{name}` is clear: light passes it, so both its sides belong together"),
                    "name an opaque material, or give the clear one to the shape itself",
                )),
            Some(_) => Ok(()),
        }
    }
}

/// A metal by name, or both parts of its index.
fn complex_index(at: &At, metal: Option<&str>, [eta, k]: [Option<Rgb>; 2]) -> Result<(), SceneError> {
    match (metal, eta, k) {
        (Some(metal), None, None) => named(&at.key("metal"), metal),
        (Some(_), _, _) => {
            let (key, message) = match eta {
                Some(_) => ("eta", "`metal` and `eta` are both given"),
                None => ("k", "`metal` and `k` are both given"),
            };
            Err(at
                .key(key)
                .error(message, "a metal by name has its numbers already: keep one of them"))
        }
        (None, Some(eta), Some(k)) => numbers(at, [eta, k]),
        (None, None, None) => Err(at.error("expected a `metal`, or `eta` and `k`", METAL)),
        (None, Some(_), None) => Err(at.error("missing field `k`: `eta` stands alone", METAL)),
        (None, None, Some(_)) => Err(at.error("missing field `eta`: `k` stands alone", METAL)),
    }
}

fn named(at: &At, symbol: &str) -> Result<(), SceneError> {
    if metals::find(symbol).is_some() {
        return Ok(());
    }
    let all = METALS.iter().map(|metal| metal.symbol);
    let help = match METALS.iter().find(|metal| metal.name.eq_ignore_ascii_case(symbol)) {
        Some(metal) => format!("{} is `{}`", metal.name, metal.symbol),
        None => {
            let nearest = nearest_name(symbol, all.clone());
            let list = all.collect::<Vec<_>>().join(", ");
            format!("{nearest}{}known: {list}", if nearest.is_empty() { "" } else { " " })
        }
    };
    Err(at.error(format!("unknown metal `{symbol}`"), help))
}

fn numbers(at: &At, [eta, k]: [Rgb; 2]) -> Result<(), SceneError> {
    at.key("eta")
        .each_within(eta.to_array(), 0.0, MAX_CONDUCTOR_INDEX, METAL)?;
    at.key("k").each_within(k.to_array(), 0.0, MAX_CONDUCTOR_INDEX, METAL)?;
    let both = eta.to_array().into_iter().zip(k.to_array());
    for (channel, (eta, k)) in both.enumerate() {
        if eta == 0.0 && k == 0.0 {
            let message = "`eta` and `k` are both zero in a channel, which no medium is";
            return Err(at
                .key("k")
                .index(channel)
                .error(message, "a perfect mirror: eta (0, 0, 0), k (1, 1, 1)"));
        }
    }
    Ok(())
}

/// One roughness, or one for each direction; `smooth` is the model for less than the least.
fn roughness(at: &At, [alpha, u, v]: [Option<f32>; 3], smooth: &str) -> Result<(), SceneError> {
    let both = "`alpha` holds in all directions, `alpha_u` and `alpha_v` each in one: keep `alpha` or the other two";
    match (alpha, u, v) {
        (None, None, None) => Err(at.error(
            "expected a roughness: `alpha`, or `alpha_u` and `alpha_v`",
            "0.05 is satin, 0.3 sandblasted",
        )),
        (Some(_), Some(_), _) => Err(at.key("alpha_u").error("`alpha` and `alpha_u` are both given", both)),
        (Some(_), None, Some(_)) => Err(at.key("alpha_v").error("`alpha` and `alpha_v` are both given", both)),
        (None, Some(_), None) => Err(at.error("missing field `alpha_v`: `alpha_u` stands alone", both)),
        (None, None, Some(_)) => Err(at.error("missing field `alpha_u`: `alpha_v` stands alone", both)),
        _ => {
            let help = format!("smoother than {LEAST_ROUGHNESS} is `{smooth}`; rougher than 1 is no surface of facets");
            let given = [("alpha", alpha), ("alpha_u", u), ("alpha_v", v)];
            given.into_iter().try_for_each(|(key, alpha)| {
                alpha.map_or(Ok(()), |alpha| at.key(key).within(alpha, LEAST_ROUGHNESS, 1.0, &help))
            })
        }
    }
}

fn indices(at: &At, [interior, exterior]: [f32; 2]) -> Result<(), SceneError> {
    at.key("interior_ior").within(interior, IOR[0], IOR[1], IOR_HELP)?;
    at.key("exterior_ior").within(exterior, IOR[0], IOR[1], IOR_HELP)
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
