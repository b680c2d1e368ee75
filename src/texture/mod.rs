//! Textures: colours that vary over a surface. One file per kind.
//!
//! A parameter of a material is a [`Color`]: one for the whole surface, or the number of a texture that is looked up at the
//! texture coordinates of the surface point ([`Shading`]).
//!
//! **Coordinates.** (0, 0) is the lower left corner of a picture, u grows to the right and v **up**: v = 0 is the lower edge
//! of the bottom row, v = 1 the upper edge of the top row.

mod bitmap;
mod checkerboard;
mod decode;
mod picture;
mod srgb;
mod table;

pub use bitmap::Bitmap;
pub use checkerboard::Checkerboard;
pub use decode::{MAX_TEXELS, decode, in_words};
pub use picture::{Picture, Texel};
pub use table::TextureTable;

use crate::color::Rgb;
use glam::Vec2;

/// A colour parameter of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Color {
    /// The same everywhere.
    Constant(Rgb),
    /// The texture of this number in the scene's [`TextureTable`].
    Texture(u32),
}

/// What a material may ask of the surface point that it shades.
#[derive(Clone, Copy, Debug)]
pub struct Shading<'a> {
    /// Texture coordinates; zero where the plan keeps none.
    pub uv: Vec2,
    /// The scene's textures.
    pub textures: &'a TextureTable,
}

/// A texture of any kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// Two colours in turn.
    Checkerboard(Checkerboard),
    /// A picture.
    Bitmap(Bitmap),
}

impl Color {
    /// The colour at a surface point.
    #[inline(always)]
    #[must_use]
    pub fn at(self, shading: &Shading<'_>) -> Rgb {
        match self {
            Self::Constant(color) => color,
            Self::Texture(number) => shading.textures.color(number, shading.uv),
        }
    }

    /// Whether it is looked up.
    #[must_use]
    pub const fn is_texture(self) -> bool {
        matches!(self, Self::Texture(_))
    }
}

impl From<Rgb> for Color {
    fn from(color: Rgb) -> Self {
        Self::Constant(color)
    }
}

impl Texture {
    /// The colour at texture coordinates `uv`, which must be finite.
    #[inline]
    #[must_use]
    pub fn color(&self, uv: Vec2) -> Rgb {
        match self {
            Self::Checkerboard(texture) => texture.color(uv),
            Self::Bitmap(texture) => texture.color(uv),
        }
    }
}
