//! Arithmetic on several numbers at once, by whichever instructions the machine has.
//!
//! Everything is one IEEE operation on each lane, and nothing is fused: whatever the instructions, results are the same to the bit.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod plain;
pub mod wide;

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub use avx512::Avx512;
pub use plain::Plain;

use super::node::Reference;
use super::stack::Entry;
use wide::Wide;

/// Something to be done with lanes.
pub trait Task {
    /// What comes of it.
    type Output;
    /// Does it.
    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// Eight numbers of single precision and four of double at once. A value of such a type is the proof that the machine has the
/// instructions; what is generic over it is compiled for each of them, if it is inlined all the way (`#[inline(always)]`).
pub trait Lanes: Wide {
    /// Eight of single precision.
    type Single: Copy;
    /// Four of double precision.
    type Double: Copy;

    /// Does a task, compiled for these instructions.
    fn run<T: Task>(self, task: T) -> T::Output;

    /// Eight numbers.
    fn single(self, numbers: &[f32; 8]) -> Self::Single;
    /// One number eight times.
    fn single_splat(self, number: f32) -> Self::Single;
    /// a − b.
    fn single_sub(self, a: Self::Single, b: Self::Single) -> Self::Single;
    /// a · b.
    fn single_mul(self, a: Self::Single, b: Self::Single) -> Self::Single;
    /// The larger of both; b where one is not a number.
    fn single_max(self, a: Self::Single, b: Self::Single) -> Self::Single;
    /// The lesser of both; b where one is not a number.
    fn single_min(self, a: Self::Single, b: Self::Single) -> Self::Single;
    /// A bit for each lane where a ≤ b.
    fn single_le(self, a: Self::Single, b: Self::Single) -> u32;
    /// Writes the children that `mask` has a bit for, with their distances, the nearest of them last (the first of those that are as near),
    /// and says how many they are. What is written behind them means nothing.
    fn leave(self, mask: u32, distances: Self::Single, children: &[Reference; 8], room: &mut [Entry; 8]) -> usize;

    /// Four numbers, exactly.
    fn double(self, numbers: &[f32; 4]) -> Self::Double;
    /// Four numbers.
    fn double_load(self, numbers: &[f64; 4]) -> Self::Double;
    /// One number four times.
    fn double_splat(self, number: f64) -> Self::Double;
    /// The numbers.
    fn double_array(self, a: Self::Double) -> [f64; 4];
    /// a + b.
    fn double_add(self, a: Self::Double, b: Self::Double) -> Self::Double;
    /// a − b.
    fn double_sub(self, a: Self::Double, b: Self::Double) -> Self::Double;
    /// a · b.
    fn double_mul(self, a: Self::Double, b: Self::Double) -> Self::Double;
    /// a / b.
    fn double_div(self, a: Self::Double, b: Self::Double) -> Self::Double;
    /// A bit for each lane where a ≤ b.
    fn double_le(self, a: Self::Double, b: Self::Double) -> u32;
    /// A bit for each lane where a < b.
    fn double_lt(self, a: Self::Double, b: Self::Double) -> u32;
    /// A bit for each lane where a ≠ b.
    fn double_ne(self, a: Self::Double, b: Self::Double) -> u32;
}
