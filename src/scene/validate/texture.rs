//! Checks of the `textures` block, before any file is read.

use crate::scene::at::At;
use crate::scene::description::TextureDescription;
use crate::scene::error::SceneError;
use crate::scene::limits::MAX_TEXTURE_SCALE;

pub(super) fn check(at: &At, texture: &TextureDescription) -> Result<(), SceneError> {
    match texture {
        TextureDescription::Checkerboard { even, odd, scale } => {
            let at = at.variant("Checkerboard");
            let help = "a share of the light that arrives";
            at.key("even").each_within(even.to_array(), 0.0, 1.0, help)?;
            at.key("odd").each_within(odd.to_array(), 0.0, 1.0, help)?;
            scales(&at.key("scale"), *scale)
        }
        TextureDescription::Bitmap {
            file,
            encoding: _,
            filter: _,
            wrap: _,
            scale,
        } => {
            let at = at.variant("Bitmap");
            if file.as_os_str().is_empty() {
                let help = "a PNG, JPEG, OpenEXR or Radiance HDR file";
                return Err(at.key("file").error("expected the name of a picture", help));
            }
            scales(&at.key("scale"), *scale)
        }
    }
}

fn scales(at: &At, scale: [f32; 2]) -> Result<(), SceneError> {
    let help = "how often it repeats per unit of texture coordinates";
    let mut each = scale.iter().enumerate();
    each.try_for_each(|(axis, value)| {
        at.index(axis)
            .within(*value, -MAX_TEXTURE_SCALE, MAX_TEXTURE_SCALE, help)
    })
}
