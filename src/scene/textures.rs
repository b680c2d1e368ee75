//! Textures of a scene file, with their pictures read.

use super::at::At;
use super::description::{ColorDescription, MaterialDescription, SceneDescription, TextureDescription};
use super::error::{SceneError, SceneWarning};
use super::read::{SceneSource, read_bounded};
use crate::color::Rgb;
use crate::texture::{Bitmap, Checkerboard, Texture, decode};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The largest picture file, in bytes.
const MAX_PICTURE_BYTES: u64 = 2 << 30;

/// The textures that materials of shapes name, by name; a warning for the others, whose files are not read.
pub(super) fn load_used(
    source: &SceneSource,
    warnings: &mut Vec<SceneWarning>,
) -> Result<Vec<(String, Arc<Texture>)>, SceneError> {
    let scene = &source.description;
    let named = scene.shapes.iter().filter_map(|shape| shape.material.as_deref());
    let used: BTreeSet<&str> = named.flat_map(|material| named_by(scene, material)).collect();
    let block = At::root(source).key("textures");
    let mut textures = Vec::with_capacity(used.len());
    for (name, texture) in &scene.textures {
        if used.contains(name.as_str()) {
            textures.push((name.clone(), Arc::new(load(&block.key(name), texture)?)));
        } else {
            let help = "remove it, or name it in a material: `reflectance: \"...\"`";
            let message = format!("no material of a shape uses the texture `{name}`");
            warnings.push(block.name(name).warning(message, help));
        }
    }
    Ok(textures)
}

/// The textures that the material named `material` refers to, on any of its sides.
pub(super) fn named_by<'a>(scene: &'a SceneDescription, material: &str) -> Vec<&'a str> {
    let name = |color: &'a ColorDescription| match color {
        ColorDescription::Constant(_) => None,
        ColorDescription::Texture(name) => Some(name.as_str()),
    };
    match scene.materials.get(material) {
        Some(
            MaterialDescription::Diffuse { reflectance, .. }
            | MaterialDescription::Conductor { reflectance, .. }
            | MaterialDescription::RoughConductor { reflectance, .. },
        ) => name(reflectance).into_iter().collect(),
        Some(MaterialDescription::Plastic {
            diffuse_reflectance,
            specular_reflectance,
            ..
        }) => [diffuse_reflectance, specular_reflectance]
            .into_iter()
            .filter_map(name)
            .collect(),
        // Sides are not two-sided themselves.
        Some(MaterialDescription::TwoSided { front, back }) => [front, back]
            .into_iter()
            .flat_map(|side| named_by(scene, side))
            .collect(),
        Some(MaterialDescription::Dielectric { .. } | MaterialDescription::RoughDielectric { .. }) | None => Vec::new(),
    }
}

/// The texture at `at`. It is a share of light: every texel is from 0 to 1.
fn load(at: &At, description: &TextureDescription) -> Result<Texture, SceneError> {
    match description {
        TextureDescription::Checkerboard { even, odd, scale } => {
            Ok(Texture::Checkerboard(Checkerboard::new(*even, *odd, *scale)))
        }
        TextureDescription::Bitmap {
            file,
            encoding,
            filter,
            wrap,
            scale,
        } => {
            let at = at.variant("Bitmap").key("file");
            let path = at.source.base_dir.join(file);
            let shown = file.display();
            let bytes = read_bounded(&path, MAX_PICTURE_BYTES)
                .map_err(|problem| at.error(format!("cannot read the picture {}: {problem}", path.display()), ""))?;
            let picture = decode(&bytes, *encoding).map_err(|problem| at.error(format!("{shown}: {problem}"), ""))?;
            let outside = |color: Rgb| color.min_channel() < 0.0 || color.max_channel() > 1.0;
            if let Some(texel) = picture.find(outside) {
                let [r, g, b] = texel.color.to_array();
                let message = format!(
                    "{shown}: a reflectance is from 0 to 1, and texel ({}, {}) from the top left is ({r}, {g}, {b})",
                    texel.x, texel.y
                );
                let help = "a share of the light that arrives; scale the picture down";
                return Err(at.error(message, help));
            }
            Ok(Texture::Bitmap(Bitmap::new(picture, *filter, *wrap, *scale)))
        }
    }
}
