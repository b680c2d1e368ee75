//! Textures of a scene file, with their pictures read.

use super::at::At;
use super::description::TextureDescription;
use super::error::SceneError;
use super::read::read_bounded;
use crate::texture::{Bitmap, Checkerboard, Texture, decode};

/// The largest picture file, in bytes.
const MAX_PICTURE_BYTES: u64 = 2 << 30;

/// The texture at `at`. It is a share of light: no texel may be above one.
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
            if let Some(texel) = picture.above(1.0) {
                let [r, g, b] = texel.color.to_array();
                let (x, y) = (texel.x, texel.y);
                let message = format!(
                    "{shown}: as a reflectance no texel may be above 1, and texel ({x}, {y}) from the top left is ({r}, {g}, {b})"
                );
                let help = "more light would leave than arrives; scale the picture down";
                return Err(at.error(message, help));
            }
            Ok(Texture::Bitmap(Bitmap::new(picture, *filter, *wrap, *scale)))
        }
    }
}
