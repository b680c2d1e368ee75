//! Lanes as arrays: what every machine has, and whatever the compiler makes of it.

use super::{Entry, Lanes, Reference, Task};

/// Arrays.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

#[inline(always)]
fn each<T: Copy, const N: usize>(a: [T; N], b: [T; N], of: impl Fn(T, T) -> T) -> [T; N] {
    let mut out = a;
    for lane in 0..N {
        out[lane] = of(a[lane], b[lane]);
    }
    out
}

#[inline(always)]
fn mask<T: Copy, const N: usize>(a: [T; N], b: [T; N], holds: impl Fn(T, T) -> bool) -> u32 {
    let mut out = 0;
    for lane in 0..N {
        out |= u32::from(holds(a[lane], b[lane])) << lane;
    }
    out
}

impl Lanes for Plain {
    type Single = [f32; 8];
    type Double = [f64; 4];

    #[inline(always)]
    fn run<T: Task>(self, task: T) -> T::Output {
        task.run(self)
    }

    #[inline(always)]
    fn single(self, numbers: &[f32; 8]) -> [f32; 8] {
        *numbers
    }
    #[inline(always)]
    fn single_splat(self, number: f32) -> [f32; 8] {
        [number; 8]
    }
    #[inline(always)]
    fn single_sub(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        each(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn single_mul(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        each(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn single_max(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        each(a, b, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn single_min(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        each(a, b, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn single_le(self, a: [f32; 8], b: [f32; 8]) -> u32 {
        mask(a, b, |a, b| a <= b)
    }

    #[inline(always)]
    fn leave(self, mut mask: u32, distances: [f32; 8], children: &[Reference; 8], room: &mut [Entry; 8]) -> usize {
        let mut count = 0;
        while mask != 0 {
            let lane = (mask.trailing_zeros() & 7) as usize;
            mask &= mask - 1;
            let entry = Entry::new(distances[lane], children[lane]);
            room[count & 7] = entry;
            // The nearest so far stays last.
            let before = room[count.wrapping_sub(1) & 7];
            if count > 0 && before.distance() <= entry.distance() {
                (room[(count - 1) & 7], room[count & 7]) = (entry, before);
            }
            count += 1;
        }
        count
    }

    #[inline(always)]
    fn double(self, numbers: &[f32; 4]) -> [f64; 4] {
        numbers.map(f64::from)
    }
    #[inline(always)]
    fn double_load(self, numbers: &[f64; 4]) -> [f64; 4] {
        *numbers
    }

    #[inline(always)]
    fn double_splat(self, number: f64) -> [f64; 4] {
        [number; 4]
    }
    #[inline(always)]
    fn double_array(self, a: [f64; 4]) -> [f64; 4] {
        a
    }
    #[inline(always)]
    fn double_add(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        each(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn double_sub(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        each(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn double_mul(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        each(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn double_div(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        each(a, b, |a, b| a / b)
    }
    #[inline(always)]
    fn double_le(self, a: [f64; 4], b: [f64; 4]) -> u32 {
        mask(a, b, |a, b| a <= b)
    }
    #[inline(always)]
    fn double_lt(self, a: [f64; 4], b: [f64; 4]) -> u32 {
        mask(a, b, |a, b| a < b)
    }
    #[inline(always)]
    fn double_ne(self, a: [f64; 4], b: [f64; 4]) -> u32 {
        mask(a, b, |a, b| a != b)
    }
}
