//! `Bitmap`: a picture from a file.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `file` | PNG, JPEG, OpenEXR or Radiance HDR; relative to the folder of the scene file | | required |
//! | `encoding` | what its numbers mean: `Srgb`, `Linear`, or `Auto`: sRGB in PNG and JPEG, linear in EXR and HDR | | `Auto` |
//! | `filter` | `Bilinear` between the centres of texels, or the `Nearest` one | | `Bilinear` |
//! | `wrap` | beyond the picture: `Repeat` it, `Mirror` every second one, or `Clamp` to its edge | | `Repeat` |
//! | `scale` | pictures per unit of u and of v | [-1e6, 1e6] | (1, 1) |
//!
//! Use it for anything that was photographed or painted, mapped by a shape's texture coordinates (Catmull 1974). Do not use it
//! for light: its numbers are shares of light from 0 to 1, and radiance is an `Environment(file)`.
//!
//! The lower left corner of the picture is at u = v = 0, its upper right corner at u = v = 1 (over the scale); v points
//! up. Texel centres are half a texel inside. Use `Linear` for pictures that hold numbers rather than colours. There are no
//! smaller versions of the picture (mipmaps): what is finer than a pixel is averaged by the samples of the pixel, which
//! costs noise and no bias. Alpha is left out.

use super::Picture;
use crate::color::Rgb;
use crate::scene::{TextureFilter, TextureWrap};
use glam::Vec2;

/// A picture, and how it is looked up.
#[derive(Clone, Debug, PartialEq)]
pub struct Bitmap {
    picture: Picture,
    filter: TextureFilter,
    wrap: TextureWrap,
    scale: [f64; 2],
}

impl Bitmap {
    /// Looks `picture` up in the given way, with `scale` pictures per unit of texture coordinates.
    #[must_use]
    pub fn new(picture: Picture, filter: TextureFilter, wrap: TextureWrap, scale: [f32; 2]) -> Self {
        Self {
            picture,
            filter,
            wrap,
            scale: scale.map(f64::from),
        }
    }

    /// The picture.
    #[must_use]
    pub fn picture(&self) -> &Picture {
        &self.picture
    }

    /// The colour at finite texture coordinates.
    #[inline]
    #[must_use]
    pub fn color(&self, uv: Vec2) -> Rgb {
        let (width, height) = (self.picture.width(), self.picture.height());
        // In texels from the top left corner. In f64: exact where a picture is repeated many times.
        let x = f64::from(uv.x) * self.scale[0] * width as f64;
        let y = (1.0 - f64::from(uv.y) * self.scale[1]) * height as f64;
        match self.filter {
            TextureFilter::Nearest => {
                let [(column, _), (row, _)] = [self.texel(x, width), self.texel(y, height)];
                self.picture.at(column.0, row.0)
            }
            TextureFilter::Bilinear => {
                let ((left, right), across) = self.texel(x - 0.5, width);
                let ((above, below), down) = self.texel(y - 0.5, height);
                let row = |row: usize| mix(self.picture.at(left, row), self.picture.at(right, row), across);
                mix(row(above), row(below), down)
            }
        }
    }

    /// The texels at the whole coordinate below `x` and at the next one, and how far `x` is on the way between.
    #[inline]
    fn texel(&self, x: f64, count: usize) -> ((usize, usize), f32) {
        let period = match self.wrap {
            TextureWrap::Repeat => count,
            TextureWrap::Mirror => 2 * count,
            TextureWrap::Clamp => {
                let x = x.clamp(-1.0, count as f64);
                let below = x.floor();
                let inside = |i: f64| (i.max(0.0) as usize).min(count - 1);
                return ((inside(below), inside(below + 1.0)), (x - below) as f32);
            }
        };
        let x = x.rem_euclid(period as f64);
        let below = x.floor();
        // The remainder can round up to the period itself.
        let first = below as usize % period;
        let second = (first + 1) % period;
        let inside = |i: usize| if i < count { i } else { period - 1 - i };
        ((inside(first), inside(second)), (x - below) as f32)
    }
}

/// From `a` to `b`: exact where they are equal.
#[inline]
fn mix(a: Rgb, b: Rgb, t: f32) -> Rgb {
    a + (b - a) * t
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows of three texels; the top row first.
    const TEXELS: [f32; 6] = [0.0, 0.1, 0.2, 0.4, 0.6, 1.0];

    fn bitmap(filter: TextureFilter, wrap: TextureWrap, scale: [f32; 2]) -> Bitmap {
        let rgb = TEXELS.map(|v| Rgb::new(v, 1.0 - v, 0.5));
        Bitmap::new(
            Picture::linear(3, 2, rgb.to_vec()).expect("colours"),
            filter,
            wrap,
            scale,
        )
    }

    fn red(bitmap: &Bitmap, u: f32, v: f32) -> f32 {
        let color = bitmap.color(Vec2::new(u, v));
        assert!((color.r + color.g - 1.0).abs() < 1e-6 && color.b == 0.5, "{color:?}");
        color.r
    }

    #[test]
    fn texels_are_exact_at_their_centres_and_v_points_up() {
        for filter in [TextureFilter::Bilinear, TextureFilter::Nearest] {
            for wrap in [TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp] {
                let bitmap = bitmap(filter, wrap, [1.0; 2]);
                for (i, texel) in TEXELS.into_iter().enumerate() {
                    let (u, v) = ((i % 3) as f32 / 3.0 + 1.0 / 6.0, 0.75 - 0.5 * (i / 3) as f32);
                    let found = red(&bitmap, u, v);
                    assert!((found - texel).abs() < 1e-6, "{filter:?} {wrap:?} {i}: {found}");
                }
            }
        }
    }

    #[test]
    fn between_centres_colours_are_mixed_in_proportion() {
        let bitmap = bitmap(TextureFilter::Bilinear, TextureWrap::Clamp, [1.0; 2]);
        for (u, v, expected) in [
            // Half way between the first two texels of the top row, then of all four of the left block.
            (1.0 / 3.0, 0.75, 0.05),
            (1.0 / 3.0, 0.5, 0.275),
            // A quarter of the way from the second to the third texel below.
            (0.5 + 0.25 / 3.0, 0.25, 0.7),
            // Beyond the outermost centres the edge goes on.
            (0.0, 0.75, 0.0),
            (1.0, 0.0, 1.0),
            (1.0, 1.0, 0.2),
        ] {
            let found = red(&bitmap, u, v);
            assert!((found - expected).abs() < 1e-6, "({u}, {v}): {found} for {expected}");
        }
    }

    #[test]
    fn the_picture_goes_on_as_the_wrap_says() {
        // The row of 0.4, 0.6, 1 below, texel by texel from u = -1 to 2.
        let cases = [
            (TextureWrap::Repeat, [0.4, 0.6, 1.0, 0.4, 0.6, 1.0, 0.4, 0.6, 1.0]),
            (TextureWrap::Mirror, [1.0, 0.6, 0.4, 0.4, 0.6, 1.0, 1.0, 0.6, 0.4]),
            (TextureWrap::Clamp, [0.4, 0.4, 0.4, 0.4, 0.6, 1.0, 1.0, 1.0, 1.0]),
        ];
        for (wrap, row) in cases {
            for filter in [TextureFilter::Bilinear, TextureFilter::Nearest] {
                let bitmap = bitmap(filter, wrap, [1.0; 2]);
                for (i, expected) in row.into_iter().enumerate() {
                    let u = (i as f32 + 0.5) / 3.0 - 1.0;
                    let found = red(&bitmap, u, 0.25);
                    assert!(
                        (found - expected).abs() < 1e-6,
                        "{wrap:?} {filter:?} {u}: {found} for {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn there_is_no_seam_where_a_picture_meets_itself() {
        let value = |wrap, u: f32, v: f32| red(&bitmap(TextureFilter::Bilinear, wrap, [1.0; 2]), u, v);
        for v in [0.0, 0.1, 0.5, 0.9] {
            // Repeated, the edge is half way between the outer texels of both sides; mirrored, it is the outer texel.
            for u in [-1.0, 0.0, 1.0] {
                let (below, above) = (
                    value(TextureWrap::Repeat, u - 1e-6, v),
                    value(TextureWrap::Repeat, u + 1e-6, v),
                );
                assert!((below - above).abs() < 1e-4, "({u}, {v}): {below} {above}");
            }
            let middle = value(TextureWrap::Repeat, 0.0, 0.25);
            assert!((middle - 0.7).abs() < 1e-6, "{middle}");
            let edge = value(TextureWrap::Mirror, 0.0, 0.25);
            assert!((edge - 0.4).abs() < 1e-6, "{edge}");
        }
        let vertical = value(TextureWrap::Repeat, 0.5, 0.0);
        assert!((vertical - 0.35).abs() < 1e-6, "{vertical}");
    }

    #[test]
    fn the_scale_counts_pictures() {
        let bitmap = bitmap(TextureFilter::Nearest, TextureWrap::Repeat, [10.0, -1.0]);
        assert_eq!(red(&bitmap, 0.51, 0.75), 0.4);
        assert_eq!(red(&bitmap, 0.51, 0.25), 0.0);
        assert_eq!(red(&bitmap, 0.59, 0.75), 1.0);
    }

    #[test]
    fn the_largest_coordinates_are_looked_up_like_any_others() {
        for wrap in [TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp] {
            for filter in [TextureFilter::Bilinear, TextureFilter::Nearest] {
                let bitmap = bitmap(filter, wrap, [1e6, -1e6]);
                for x in [f32::MAX, f32::MIN, 1e12, -1e-38, 0.0] {
                    let found = red(&bitmap, x, -x);
                    assert!((0.0..=1.0).contains(&found), "{wrap:?} {filter:?} {x}: {found}");
                }
            }
        }
    }

    #[test]
    fn one_texel_is_the_same_everywhere() {
        let color = Rgb::new(0.123_456_7, 0.3, 1.0);
        for wrap in [TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp] {
            let picture = Picture::linear(1, 1, vec![color]).expect("a colour");
            let bitmap = Bitmap::new(picture, TextureFilter::Bilinear, wrap, [1.0; 2]);
            for (u, v) in [(0.0, 0.0), (0.3, 0.9), (-7.7, 123.4)] {
                assert_eq!(bitmap.color(Vec2::new(u, v)), color);
            }
        }
    }
}
