//! A picture in memory: what files of all kinds are read to.

use crate::color::Rgb;

/// Linear colours, row-major, top left first. All are finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: usize,
    height: usize,
    texels: Texels,
}

/// Colours, or the codes of 8-bit files, which need a quarter of the memory.
#[derive(Clone, Debug, PartialEq)]
enum Texels {
    Codes { codes: Vec<[u8; 3]>, values: Vec<f32> },
    Colors(Vec<Rgb>),
}

/// A texel and where it is, counted from the top left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel {
    /// Its column.
    pub x: usize,
    /// Its row.
    pub y: usize,
    /// Its colour.
    pub color: Rgb,
}

impl Picture {
    /// The picture of `width` x `height` texels, each channel a code; `values` has the linear value of each code: 256
    /// numbers in [0, 1].
    pub(super) fn coded(width: usize, height: usize, codes: Vec<[u8; 3]>, values: Vec<f32>) -> Result<Self, String> {
        check_count(width, height, codes.len())?;
        Ok(Self {
            width,
            height,
            texels: Texels::Codes { codes, values },
        })
    }

    /// The picture of `width` x `height` linear colours.
    ///
    /// # Errors
    /// A picture without texels, a list of another length, or the first texel that is infinite or not a number; in words.
    pub fn linear(width: usize, height: usize, rgb: Vec<Rgb>) -> Result<Self, String> {
        check_count(width, height, rgb.len())?;
        if let Some(at) = rgb.iter().position(|color| !color.is_finite()) {
            let [r, g, b] = rgb[at].to_array();
            return Err(format!(
                "texel ({}, {}) from the top left is ({r}, {g}, {b}): expected finite numbers",
                at % width,
                at / width
            ));
        }
        Ok(Self {
            width,
            height,
            texels: Texels::Colors(rgb),
        })
    }

    /// Texels in a row; at least 1.
    #[must_use]
    pub const fn width(&self) -> usize {
        self.width
    }

    /// Rows; at least 1.
    #[must_use]
    pub const fn height(&self) -> usize {
        self.height
    }

    /// The colour of the texel in column `x` and row `y`, which must be inside.
    #[inline]
    #[must_use]
    pub fn at(&self, x: usize, y: usize) -> Rgb {
        let index = y * self.width + x;
        match &self.texels {
            Texels::Codes { codes, values } => Rgb::from(codes[index].map(|code| values[usize::from(code)])),
            Texels::Colors(rgb) => rgb[index],
        }
    }

    /// The first texel that `wanted` says yes to.
    #[must_use]
    pub fn find(&self, wanted: impl Fn(Rgb) -> bool) -> Option<Texel> {
        let texel = |index: usize| {
            let (x, y) = (index % self.width, index / self.width);
            Texel {
                x,
                y,
                color: self.at(x, y),
            }
        };
        (0..self.width * self.height)
            .map(texel)
            .find(|texel| wanted(texel.color))
    }

    /// Memory of the texels, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match &self.texels {
            Texels::Codes { codes, .. } => size_of_val(&codes[..]),
            Texels::Colors(rgb) => size_of_val(&rgb[..]),
        }
    }
}

fn check_count(width: usize, height: usize, count: usize) -> Result<(), String> {
    if count == 0 || count != width * height {
        return Err(format!("it does not hold the {width} x {height} texels it claims"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_that_are_no_colours_are_refused_with_their_place() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut rgb = vec![Rgb::ONE; 6];
            rgb[5].g = bad;
            let error = Picture::linear(3, 2, rgb).expect_err("no colour");
            assert!(error.starts_with("texel (2, 1) from the top left is (1, "), "{error}");
        }
        assert!(Picture::linear(3, 2, vec![Rgb::ONE; 5]).is_err());
        assert!(Picture::linear(0, 0, Vec::new()).is_err());
    }

    #[test]
    fn the_first_texel_of_a_kind_is_named() {
        let mut rgb = vec![Rgb::splat(0.5); 6];
        rgb[4] = Rgb::new(0.0, 0.0, 1.5);
        let picture = Picture::linear(3, 2, rgb).expect("colours");
        let found = picture.find(|color| color.b > 1.0).expect("one texel");
        assert_eq!((found.x, found.y, found.color.b), (1, 1, 1.5));
        assert_eq!(picture.find(|color| color.b > 1.5), None);
        assert_eq!(picture.bytes(), 72);
    }
}
