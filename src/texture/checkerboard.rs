//! `Checkerboard`: two colours in turn, in rectangles of equal size.
//!
//! | parameter | meaning | unit | default |
//! |---|---|---|---|
//! | `even` | the colour of the cell at u = v = 0, and of every second one from there | [0, 1] per channel | 0.4 |
//! | `odd` | the colour of the others | [0, 1] per channel | 0.2 |
//! | `scale` | cells per unit of u and of v | [-1e6, 1e6] | (1, 1) |
//!
//! Use it for floors, and to see how texture coordinates lie on a shape. Do not use it for tiles with joints or any third colour:
//! a `Bitmap` has them. The cell ⌊su⌋ + ⌊tv⌋ is even or odd (Ebert et al. 2003, chapter 2).
//!
//! A cell holds its edges towards smaller coordinates. Nothing is filtered: cells smaller than a pixel are averaged by the
//! samples of the pixel. A scale of zero makes stripes.

use crate::color::Rgb;
use glam::Vec2;

/// Two colours in turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checkerboard {
    even: Rgb,
    odd: Rgb,
    scale: [f64; 2],
}

impl Checkerboard {
    /// `even` in the cell at the origin, `scale` cells per unit.
    #[must_use]
    pub fn new(even: Rgb, odd: Rgb, scale: [f32; 2]) -> Self {
        Self {
            even,
            odd,
            scale: scale.map(f64::from),
        }
    }

    /// The colour at finite texture coordinates.
    #[inline]
    #[must_use]
    pub fn color(&self, uv: Vec2) -> Rgb {
        // Of whole numbers, so that it is exact at any distance.
        let cell = |x: f32, scale: f64| (f64::from(x) * scale).floor().rem_euclid(2.0);
        if cell(uv.x, self.scale[0]) == cell(uv.y, self.scale[1]) {
            self.even
        } else {
            self.odd
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOARD: (Rgb, Rgb) = (Rgb::new(0.1, 0.2, 0.3), Rgb::new(0.7, 0.8, 0.9));

    #[test]
    fn cells_take_turns_and_hold_their_lower_edges() {
        let (even, odd) = BOARD;
        let board = Checkerboard::new(even, odd, [4.0, 2.0]);
        for (u, v, color) in [
            (0.0, 0.0, even),
            (0.24, 0.49, even),
            (0.25, 0.0, odd),
            (0.0, 0.5, odd),
            (0.25, 0.5, even),
            (-1e-30, 0.0, odd),
            (-0.01, -0.01, even),
            (-0.26, 0.0, even),
            (1e9, 0.0, even),
            (1.0 - f32::EPSILON / 2.0, 0.0, odd),
        ] {
            assert_eq!(board.color(Vec2::new(u, v)), color, "({u}, {v})");
        }
    }

    #[test]
    fn a_scale_of_zero_makes_stripes_and_a_negative_one_turns_them_over() {
        let (even, odd) = BOARD;
        let stripes = Checkerboard::new(even, odd, [0.0, -1.0]);
        assert_eq!(stripes.color(Vec2::new(17.3, 0.0)), even);
        assert_eq!(stripes.color(Vec2::new(-5.0, 0.5)), odd);
        assert_eq!(stripes.color(Vec2::new(-5.0, 1.5)), even);
    }
}
