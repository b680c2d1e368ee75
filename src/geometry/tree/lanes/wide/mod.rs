//! As many numbers of single precision at once as the machine takes.
//!
//! What is computed with these may be fused, and so be rounded otherwise on another machine: it may only decide what is looked at more
//! closely.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod plain;

/// Numbers in what is processed at a time: one or two registers.
pub const BUNDLE: usize = 16;

/// Up to sixteen numbers of single precision at once.
pub trait Wide: Copy {
    /// Numbers at once: a part of [`BUNDLE`].
    const WIDTH: usize;
    /// That many numbers.
    type Numbers: Copy;
    /// That many numbers of double precision.
    type Doubles: Copy;
    /// Yes or no for each.
    type Flags: Copy;

    /// The `part`-th so many numbers.
    fn wide(self, numbers: &[f32; BUNDLE], part: usize) -> Self::Numbers;
    /// Writes the `part`-th so many numbers.
    fn wide_put(self, numbers: &mut [f32; BUNDLE], part: usize, values: Self::Numbers);
    /// One number for all.
    fn wide_splat(self, number: f32) -> Self::Numbers;
    /// a + b.
    fn wide_add(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// a − b.
    fn wide_sub(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// a · b.
    fn wide_mul(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// a · b + c, rounded once or twice.
    fn wide_mul_add(self, a: Self::Numbers, b: Self::Numbers, c: Self::Numbers) -> Self::Numbers;
    /// The larger of both; b where one is not a number.
    fn wide_max(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// The lesser of both; b where one is not a number.
    fn wide_min(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// |a|.
    fn wide_abs(self, a: Self::Numbers) -> Self::Numbers;
    /// a where b is positive, −a where it is negative.
    fn wide_turned(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// The `part`-th so many numbers.
    fn doubles(self, numbers: &[f64; BUNDLE], part: usize) -> Self::Doubles;
    /// c − a · b in double precision, then rounded to single.
    fn minus_dot(self, c: f64, a: &[f64; 3], b: [Self::Doubles; 3]) -> Self::Numbers;
    /// a < b.
    fn wide_lt(self, a: Self::Numbers, b: Self::Numbers) -> Self::Flags;
    /// Not a < b: also where one is not a number.
    fn wide_not_lt(self, a: Self::Numbers, b: Self::Numbers) -> Self::Flags;
    /// Both.
    fn both(self, a: Self::Flags, b: Self::Flags) -> Self::Flags;
    /// One of them, or both.
    fn either(self, a: Self::Flags, b: Self::Flags) -> Self::Flags;
    /// a where flagged, b elsewhere.
    fn wide_select(self, flags: Self::Flags, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// A bit for each flag.
    fn bits(self, flags: Self::Flags) -> u32;
}
