//! Eight numbers in an array.

use super::{BUNDLE, Wide};
use crate::geometry::tree::lanes::Plain;

const WIDTH: usize = 8;
type Numbers = [f32; WIDTH];

#[inline(always)]
fn each(a: Numbers, b: Numbers, of: impl Fn(f32, f32) -> f32) -> Numbers {
    let mut out = a;
    for lane in 0..WIDTH {
        out[lane] = of(a[lane], b[lane]);
    }
    out
}

/// All bits of a number for each lane: what compilers make vector comparisons of.
#[inline(always)]
fn flags(a: Numbers, b: Numbers, holds: impl Fn(f32, f32) -> bool) -> [u32; WIDTH] {
    let mut out = [0; WIDTH];
    for lane in 0..WIDTH {
        out[lane] = if holds(a[lane], b[lane]) { u32::MAX } else { 0 };
    }
    out
}

impl Wide for Plain {
    const WIDTH: usize = WIDTH;
    type Numbers = Numbers;
    type Doubles = [f64; WIDTH];
    type Flags = [u32; WIDTH];

    #[inline(always)]
    fn wide(self, numbers: &[f32; BUNDLE], part: usize) -> Numbers {
        numbers.as_chunks().0[part]
    }
    #[inline(always)]
    fn wide_put(self, numbers: &mut [f32; BUNDLE], part: usize, values: Numbers) {
        numbers.as_chunks_mut().0[part] = values;
    }
    #[inline(always)]
    fn wide_splat(self, number: f32) -> Numbers {
        [number; WIDTH]
    }
    #[inline(always)]
    fn wide_add(self, a: Numbers, b: Numbers) -> Numbers {
        each(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn wide_sub(self, a: Numbers, b: Numbers) -> Numbers {
        each(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn wide_mul(self, a: Numbers, b: Numbers) -> Numbers {
        each(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn wide_mul_add(self, a: Numbers, b: Numbers, c: Numbers) -> Numbers {
        each(each(a, b, |a, b| a * b), c, |ab, c| ab + c)
    }
    #[inline(always)]
    fn wide_max(self, a: Numbers, b: Numbers) -> Numbers {
        each(a, b, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn wide_min(self, a: Numbers, b: Numbers) -> Numbers {
        each(a, b, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn wide_abs(self, a: Numbers) -> Numbers {
        a.map(f32::abs)
    }
    #[inline(always)]
    fn wide_turned(self, a: Numbers, b: Numbers) -> Numbers {
        const SIGN: u32 = 1 << 31;
        each(a, b, |a, b| f32::from_bits(a.to_bits() ^ (b.to_bits() & SIGN)))
    }
    #[inline(always)]
    fn doubles(self, numbers: &[f64; BUNDLE], part: usize) -> [f64; WIDTH] {
        numbers.as_chunks().0[part]
    }
    #[inline(always)]
    fn minus_dot(self, c: f64, a: &[f64; 3], b: [[f64; WIDTH]; 3]) -> Numbers {
        let mut out = [0.0; WIDTH];
        for lane in 0..WIDTH {
            out[lane] = (c - a[0] * b[0][lane] - a[1] * b[1][lane] - a[2] * b[2][lane]) as f32;
        }
        out
    }
    #[inline(always)]
    fn wide_lt(self, a: Numbers, b: Numbers) -> [u32; WIDTH] {
        flags(a, b, |a, b| a < b)
    }
    #[inline(always)]
    fn wide_not_lt(self, a: Numbers, b: Numbers) -> [u32; WIDTH] {
        self.wide_lt(a, b).map(|flag| !flag)
    }
    #[inline(always)]
    fn both(self, a: [u32; WIDTH], b: [u32; WIDTH]) -> [u32; WIDTH] {
        let mut out = a;
        for lane in 0..WIDTH {
            out[lane] &= b[lane];
        }
        out
    }
    #[inline(always)]
    fn either(self, a: [u32; WIDTH], b: [u32; WIDTH]) -> [u32; WIDTH] {
        let mut out = a;
        for lane in 0..WIDTH {
            out[lane] |= b[lane];
        }
        out
    }
    #[inline(always)]
    fn wide_select(self, flags: [u32; WIDTH], a: Numbers, b: Numbers) -> Numbers {
        let mut out = a;
        for lane in 0..WIDTH {
            out[lane] = f32::from_bits(a[lane].to_bits() & flags[lane] | b[lane].to_bits() & !flags[lane]);
        }
        out
    }
    #[inline(always)]
    fn bits(self, flags: [u32; WIDTH]) -> u32 {
        let mut bits = 0;
        for (lane, flag) in flags.into_iter().enumerate() {
            bits |= (flag & 1) << lane;
        }
        bits
    }
}
