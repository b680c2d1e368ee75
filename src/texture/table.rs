//! All textures of a scene.

use super::Texture;
use crate::color::Rgb;
use glam::Vec2;
use std::sync::Arc;

/// Textures by number. A copy of the table shares them.
#[derive(Clone, Debug, Default)]
pub struct TextureTable {
    names: Vec<String>,
    textures: Vec<Arc<Texture>>,
}

impl TextureTable {
    /// A table without textures, for surfaces whose colours are constant.
    pub const NONE: Self = Self {
        names: Vec::new(),
        textures: Vec::new(),
    };

    /// Appends a texture and returns its number.
    pub fn push(&mut self, name: String, texture: Arc<Texture>) -> u32 {
        self.names.push(name);
        self.textures.push(texture);
        (self.names.len() - 1) as u32
    }

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

    /// The number of the texture named `name`.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<u32> {
        self.names.iter().position(|known| known == name).map(|i| i as u32)
    }

    /// The names of all textures, by number.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The colour of texture `number` at `uv`; black for a number that there is not.
    #[inline]
    #[must_use]
    pub fn color(&self, number: u32, uv: Vec2) -> Rgb {
        self.textures
            .get(number as usize)
            .map_or(Rgb::BLACK, |texture| texture.color(uv))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Checkerboard;
    use super::*;

    #[test]
    fn textures_are_found_by_name_and_by_number() {
        let grey = |v: f32| {
            let both = Rgb::splat(v);
            Arc::new(Texture::Checkerboard(Checkerboard::new(both, both, [1.0; 2])))
        };
        let mut table = TextureTable::NONE;
        assert!(table.is_empty() && table.number("a").is_none());
        assert_eq!(
            (
                table.push("a".to_owned(), grey(0.25)),
                table.push("b".to_owned(), grey(0.5))
            ),
            (0, 1)
        );
        assert_eq!((table.number("b"), table.len()), (Some(1), 2));
        assert_eq!(table.color(1, Vec2::ZERO), Rgb::splat(0.5));
        assert_eq!(table.color(2, Vec2::ZERO), Rgb::BLACK);
    }
}
