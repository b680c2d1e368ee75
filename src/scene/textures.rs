//! Textures of a scene file, with their pictures read.

use super::at::At;
use super::description::TextureDescription;
use super::error::SceneError;
use super::read::read_bounded;
use crate::color::Rgb;
use crate::texture::{Bitmap, Checkerboard, Texture, decode};

/// The largest picture file, in bytes.
const MAX_PICTURE_BYTES: u64 = 2 << 30;

/// The texture at `at`. It is a share of light: every texel is from 0 to 1.
pub(super) fn load(at: &At, description: &TextureDescription) -> Result<Texture, SceneError> {
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
