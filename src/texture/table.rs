//! All textures of a scene.

use crate::color::Rgb;
use glam::Vec2;

/// Textures by number.
#[derive(Clone, Debug, Default)]
pub struct TextureTable {
    names: Vec<String>,
}

impl TextureTable {
    /// A table without textures, for surfaces whose colours are constant.
    pub const NONE: Self = Self { names: Vec::new() };

    /// Number of textures.
    #[must_use]
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// The colour of texture `number` at `uv`; black for a number that there is not.
    #[inline]
    #[must_use]
    pub fn color(&self, number: u32, uv: Vec2) -> Rgb {
        let _ = (number, uv);
        Rgb::BLACK
    }
}
