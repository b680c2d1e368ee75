//! The `textures` block: one variant per kind.

use crate::color::Rgb;
use crate::scene::schema::quantity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A texture: a colour that varies with texture coordinates u (to the right) and v (up).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename = "kind_of_texture")]
#[schemars(rename = "Texture")]
pub enum TextureDescription {
    /// Two colours in turn.
    Checkerboard {
        /// The colour of the cell at u = v = 0, in [0, 1]. Default 0.4.
        #[serde(default = "light")]
        #[schemars(with = "quantity::Share")]
        even: Rgb,
        /// The colour of its neighbours, in [0, 1]. Default 0.2.
        #[serde(default = "dark")]
        #[schemars(with = "quantity::Share")]
        odd: Rgb,
        /// Cells per unit of u and v. Default (1, 1).
        #[serde(default = "ones")]
        #[schemars(with = "quantity::Repeats")]
        scale: [f32; 2],
    },
    /// A picture from a file.
    Bitmap {
        /// A PNG, JPEG, OpenEXR or Radiance HDR file, relative to the folder of the scene file.
        #[schemars(with = "quantity::FileName")]
        file: PathBuf,
        /// What its numbers mean. Default `Auto`.
        #[serde(default)]
        encoding: TextureEncoding,
        /// How it is looked up between the centres of texels. Default `Bilinear`.
        #[serde(default)]
        filter: TextureFilter,
        /// How it goes on beyond its edges. Default `Repeat`.
        #[serde(default)]
        wrap: TextureWrap,
        /// Pictures per unit of u and v. Default (1, 1).
        #[serde(default = "ones")]
        #[schemars(with = "quantity::Repeats")]
        scale: [f32; 2],
    },
}

/// What the numbers of a picture mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "texture_encoding")]
#[schemars(rename = "TextureEncoding")]
pub enum TextureEncoding {
    /// sRGB in PNG and JPEG files, linear in OpenEXR and Radiance HDR files. The default.
    #[default]
    Auto,
    /// Encoded by the transfer function of sRGB.
    Srgb,
    /// Proportional to light.
    Linear,
}

/// How a picture is looked up between the centres of its texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "texture_filter")]
#[schemars(rename = "TextureFilter")]
pub enum TextureFilter {
    /// The four texels around are mixed in proportion. The default.
    #[default]
    Bilinear,
    /// The texel that holds the point.
    Nearest,
}

/// How a picture goes on beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "texture_wrap")]
#[schemars(rename = "TextureWrap")]
pub enum TextureWrap {
    /// From its other edge. The default.
    #[default]
    Repeat,
    /// Backwards, every second time.
    Mirror,
    /// With its outermost texels.
    Clamp,
}

fn light() -> Rgb {
    Rgb::splat(0.4)
}

fn dark() -> Rgb {
    Rgb::splat(0.2)
}

fn ones() -> [f32; 2] {
    [1.0; 2]
}
