//! Coordinates of primary sample space in fixed point, and the small step that perturbs them.
//!
//! A coordinate is a whole number c that stands for u = c/2³² (or c/2⁶⁴, the wide kind) in [0, 1), and the ends of that
//! interval are joined. Adding a step is then an addition of integers that wraps around by itself, with two properties
//! that no arithmetic in floating point has: a step is taken back exactly by its opposite, which is as likely, so the
//! kernel is symmetric to the last bit; and for any step, c ↦ c + step is a bijection, so uniform coordinates stay uniform.

use crate::math;
use std::f64::consts::LN_2;

/// The least step that a [`Kernel`] takes: 2⁻²⁴, the resolution of [`to_f32`].
pub const LEAST_STEP: f32 = 1.0 / 16_777_216.0;

/// Half way around, beyond which a step would be a shorter one in the other direction.
const LONGEST_STEP: f32 = 0.5;

const UNITS_NARROW: f64 = 4_294_967_296.0;
const UNITS_WIDE: f64 = UNITS_NARROW * UNITS_NARROW;
/// Bits of a random number that choose a step's size; the lowest one chooses its sign.
const SIZE_BITS: u32 = 31;

/// The coordinate in [0, 1): a multiple of 2⁻²⁴, never 1.
#[inline]
#[must_use]
pub const fn to_f32(c: u32) -> f32 {
    (c >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// The wide coordinate in [0, 1): a multiple of 2⁻⁵³, never 1.
#[inline]
#[must_use]
pub const fn to_f64(c: u64) -> f64 {
    (c >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}

/// The small step of Kelemen, Szirmay-Kalos, Antal and Csonka (2002, section 4): sizes from s₁ to s₂ whose logarithm is
/// uniform, |d| = s₂ exp(−ln(s₂/s₁) v) for a uniform v, in either direction. Its density per unit of the coordinate is
/// 1/(2 |d| ln(s₂/s₁)) where s₁ <= |d| <= s₂, and zero elsewhere. It is symmetric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// s₁ and s₂.
    sizes: [f32; 2],
    /// −log₂(s₂/s₁), per unit of the size bits.
    log2_per_bit: f32,
    /// −ln(2 ln(s₂/s₁)): the logarithm of the density at a distance of 1, were it allowed.
    log_density_at_one: f64,
    /// s₁ and s₂ in units of a narrow and of a wide coordinate.
    narrow: [u32; 2],
    wide: [u64; 2],
}

/// A [`Kernel`] that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error, miette::Diagnostic)]
#[error("perturbations from {smallest} to {largest} of a random number's range")]
#[diagnostic(help("give sizes of which the first is smaller, from 2^-24 to 0.5; from 1/1024 to 1/64 is common"))]
pub struct KernelError {
    /// The smallest size asked for.
    pub smallest: f32,
    /// The largest size asked for.
    pub largest: f32,
}

impl Kernel {
    /// The kernel of steps from `smallest` to `largest`.
    ///
    /// # Errors
    ///
    /// If not [`LEAST_STEP`] <= `smallest` < `largest` <= 0.5.
    pub fn new(smallest: f32, largest: f32) -> Result<Self, KernelError> {
        if !(smallest >= LEAST_STEP && smallest < largest && largest <= LONGEST_STEP) {
            return Err(KernelError { smallest, largest });
        }
        let sizes = [smallest, largest];
        let octaves = libm::log2(f64::from(largest) / f64::from(smallest));
        Ok(Self {
            sizes,
            log2_per_bit: (-octaves / f64::from(1_u32 << SIZE_BITS)) as f32,
            log_density_at_one: -libm::log(2.0 * LN_2 * octaves),
            narrow: sizes.map(narrow),
            wide: sizes.map(wide),
        })
    }

    /// The coordinate `c` perturbed, by 32 random bits: the lowest is the step's sign, the others its size.
    #[inline]
    #[must_use]
    pub fn perturb(&self, c: u32, random: u32) -> u32 {
        step_narrow(c, narrow(self.size(random)), random)
    }

    /// As [`perturb`](Self::perturb), of a wide coordinate. A size has 24 significant bits, as the narrow one.
    #[inline]
    #[must_use]
    pub fn perturb_wide(&self, c: u64, random: u32) -> u64 {
        step_wide(c, wide(self.size(random)), random)
    }

    /// The steps that 32 random bits each make of coordinates, all at
    /// once, since the sizes of several steps can be computed side by side.
    #[inline]
    #[must_use]
    pub fn steps<const N: usize>(&self, random: [u32; N]) -> Steps<N> {
        let mut sizes = [0.0; N];
        for (size, random) in sizes.iter_mut().zip(random) {
            *size = self.size(random);
        }
        Steps { sizes, random }
    }

    /// The logarithm of the density, per unit of the coordinate, with which [`perturb`](Self::perturb) leads from one
    /// coordinate to the other: the same both ways, −∞ where no step leads.
    #[inline]
    #[must_use]
    pub fn log_density(&self, from: u32, to: u32) -> f64 {
        let there = to.wrapping_sub(from);
        let distance = there.min(there.wrapping_neg());
        let possible = (self.narrow[0]..=self.narrow[1]).contains(&distance);
        self.log_density_at(possible, f64::from(distance) / UNITS_NARROW)
    }

    /// As [`log_density`](Self::log_density), of wide coordinates.
    #[inline]
    #[must_use]
    pub fn log_density_wide(&self, from: u64, to: u64) -> f64 {
        let there = to.wrapping_sub(from);
        let distance = there.min(there.wrapping_neg());
        let possible = (self.wide[0]..=self.wide[1]).contains(&distance);
        self.log_density_at(possible, distance as f64 / UNITS_WIDE)
    }

    /// A coordinate uniform over those that a step from `c` can reach, both ways: what densities are tested against.
    #[inline]
    #[must_use]
    pub fn uniform_in_support(&self, c: u32, random: u32) -> u32 {
        let [least, most] = self.narrow.map(u64::from);
        let size = least + ((u64::from(random >> 1) * (most - least + 1)) >> SIZE_BITS);
        step_narrow(c, size as u32, random)
    }

    /// As [`uniform_in_support`](Self::uniform_in_support), of a wide coordinate: one of 2³² evenly spaced ones.
    #[inline]
    #[must_use]
    pub fn uniform_in_support_wide(&self, c: u64, random: u32) -> u64 {
        let [least, most] = self.wide.map(u128::from);
        let size = least + ((u128::from(random >> 1) * (most - least + 1)) >> SIZE_BITS);
        step_wide(c, size as u64, random)
    }

    /// The length of the coordinates that a step can reach: 2 (s₂ − s₁).
    #[must_use]
    pub fn support_length(&self) -> f64 {
        let [smallest, largest] = self.sizes.map(f64::from);
        2.0 * (largest - smallest)
    }

    /// Of the weights w = 1/(V k) of small steps against coordinates uniform over the support, where V is its length and k
    /// the kernel's density: the largest, and E[w²]. E[w] is 1. With ρ = s₁/s₂ and l = ln(1/ρ), w = (|d|/s₂) l/(1 − ρ), so
    /// they are l/(1 − ρ) and l (1 + ρ)/(2 (1 − ρ)).
    #[must_use]
    pub fn weights_of_uniform(&self) -> [f64; 2] {
        let largest = self.largest_weight();
        [largest, 0.5 * largest * (1.0 + self.ratio())]
    }

    /// E[w⁴] of those weights: l³ (1 + ρ + ρ² + ρ³)/(4 (1 − ρ)³). Where n coordinates are uniform over their support, the
    /// weights of proposals have its n-th power.
    #[must_use]
    pub fn fourth_moment_of_uniform(&self) -> f64 {
        let (largest, ratio) = (self.largest_weight(), self.ratio());
        0.25 * largest * largest * largest * (1.0 + ratio) * (1.0 + ratio * ratio)
    }

    fn largest_weight(&self) -> f64 {
        let [smallest, largest] = self.sizes.map(f64::from);
        let gap = (largest - smallest) / smallest;
        libm::log1p(gap) * largest / (largest - smallest)
    }

    fn ratio(&self) -> f64 {
        let [smallest, largest] = self.sizes.map(f64::from);
        smallest / largest
    }

    /// The size of a step, from s₁ to s₂, give or take some 10⁻⁶ of itself.
    #[inline]
    fn size(&self, random: u32) -> f32 {
        let [smallest, largest] = self.sizes;
        // 31 bits fit a signed integer, which processors convert faster.
        let v = (random >> 1) as i32 as f32;
        // A power that is not positive is at most 1, but rounding may lead below s₁.
        let size = largest * math::exp2(self.log2_per_bit * v);
        if size < smallest { smallest } else { size }
    }

    #[inline]
    fn log_density_at(&self, possible: bool, distance: f64) -> f64 {
        if possible {
            self.log_density_at_one - libm::log(distance)
        } else {
            f64::NEG_INFINITY
        }
    }
}

/// A size below 1 and of at least [`LEAST_STEP`], in units of 2⁻⁶⁴: exact. An `f64` in [1, 2) has 52 bits behind the point,
/// which is more than such a size needs, and the shift leaves only them. No conversion that saturates is as fast.
#[inline]
const fn wide(size: f32) -> u64 {
    (1.0 + size as f64).to_bits() << 12
}

/// As [`wide`], in units of 2⁻³², to the nearest.
#[inline]
const fn narrow(size: f32) -> u32 {
    ((wide(size) + (1 << 31)) >> 32) as u32
}

/// Small steps that were drawn together, see [`Kernel::steps`].
#[derive(Clone, Copy, Debug)]
pub struct Steps<const N: usize> {
    sizes: [f32; N],
    random: [u32; N],
}

impl<const N: usize> Steps<N> {
    /// `c`, moved by step number `step`: what [`Kernel::perturb`] makes of it.
    #[inline]
    #[must_use]
    pub const fn narrow(&self, step: usize, c: u32) -> u32 {
        step_narrow(c, narrow(self.sizes[step]), self.random[step])
    }

    /// The wide coordinate `c`, moved by step number `step`: what [`Kernel::perturb_wide`] makes of it.
    #[inline]
    #[must_use]
    pub const fn wide(&self, step: usize, c: u64) -> u64 {
        step_wide(c, wide(self.sizes[step]), self.random[step])
    }
}

/// `c` plus `size`, or minus it where the lowest bit of `random` is set (then `mask` negates: !x + 1).
#[inline]
const fn step_narrow(c: u32, size: u32, random: u32) -> u32 {
    let mask = (random & 1).wrapping_neg();
    c.wrapping_add((size ^ mask).wrapping_sub(mask))
}

/// As [`step_narrow`], of a wide coordinate.
#[inline]
const fn step_wide(c: u64, size: u64, random: u32) -> u64 {
    let mask = ((random & 1) as u64).wrapping_neg();
    c.wrapping_add((size ^ mask).wrapping_sub(mask))
}

#[cfg(test)]
#[path = "primary_tests.rs"]
mod tests;
