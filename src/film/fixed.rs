//! Fixed-point numbers the film sums in: exact to add, in any order.
//!
//! A value is stored as a multiple of 2⁻⁶⁴ units and its square as a multiple of 2⁻¹⁰⁴ units², where the unit is a power
//! of two near the scene's brightest radiance. Squares get 192 bits, because they span twice the exponents: a pixel lit
//! at 2⁻⁴⁰ units (a dim wall in a scene that also shows the sun) has squares at 2⁻⁸⁰, and its error must not read zero.

/// Bits after the binary point of a sum, in units.
pub const VALUE_FRACTION_BITS: i32 = 64;
/// Bits after the binary point of a sum of squares, in units².
pub const SQUARE_FRACTION_BITS: i32 = 104;
/// The largest value that is stored as it is, as a power of two of units. Its square (2⁸⁰ units²) is well below the
/// 2⁸⁸ units² at which a sum of squares ends.
pub const LIMIT_BITS: i32 = 40;

/// The power of two that the film's fixed-point numbers are counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    exponent: i32,
}

/// One channel of a splat, ready to be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedValue {
    /// The value in multiples of 2⁻⁶⁴ units, rounded to nearest, halves away from zero.
    pub value: i128,
    /// The significand's square; the square is this times 2^`square_shift` multiples of 2⁻¹⁰⁴ units².
    square_significand: u64,
    square_shift: i32,
}

impl Unit {
    /// The smallest power of two that is at least `radiance`; one, when `radiance` is not a positive finite number.
    pub fn at_least(radiance: f32) -> Self {
        if !(radiance.is_finite() && radiance > 0.0) {
            return Self { exponent: 0 };
        }
        let (significand, exponent) = split(radiance);
        let top = 63 - significand.leading_zeros() as i32;
        let ceiling = if significand.is_power_of_two() { top } else { top + 1 };
        Self {
            exponent: exponent + ceiling,
        }
    }

    /// The unit with this binary logarithm, where [`Unit::at_least`] makes one.
    pub fn from_exponent(exponent: i32) -> Option<Self> {
        (-149..=128).contains(&exponent).then_some(Self { exponent })
    }

    /// log₂ of the unit.
    pub const fn exponent(self) -> i32 {
        self.exponent
    }

    /// The largest magnitude stored as it is: 2⁴⁰ units, or the largest `f32` where that is smaller.
    pub fn limit(self) -> f32 {
        power_of_two(self.exponent + LIMIT_BITS).min(f64::from(f32::MAX)) as f32
    }

    /// Converts a finite value of magnitude at most [`Unit::limit`].
    #[inline]
    pub fn fixed(self, value: f32) -> FixedValue {
        let (significand, exponent) = split(value);
        let shift = exponent + VALUE_FRACTION_BITS - self.exponent;
        let magnitude = if shift >= 0 {
            i128::from(significand) << shift
        } else {
            i128::from(round_shift(significand, shift.unsigned_abs()))
        };
        FixedValue {
            value: if value.is_sign_negative() {
                -magnitude
            } else {
                magnitude
            },
            square_significand: significand * significand,
            // 2(exponent - unit) + 104 = 2(shift - 64) + 104
            square_shift: 2 * shift - (2 * VALUE_FRACTION_BITS - SQUARE_FRACTION_BITS),
        }
    }
}

/// A sum of squares: 192 bits, least significant limb first, in multiples of 2⁻¹⁰⁴ units². Pinned at its largest value
/// once it would pass it; since squares are never negative, whether it is pinned does not depend on the order either.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub struct SquareSum([u64; 3]);

impl SquareSum {
    const PINNED: Self = Self([u64::MAX; 3]);

    /// Adds the square of a value.
    #[inline]
    pub fn add(&mut self, v: &FixedValue) {
        let (p, t) = (v.square_significand, v.square_shift);
        if (0..=80).contains(&t) {
            // p < 2⁴⁸, so nothing leaves the 128 bits. This is every value from 2⁻⁴⁰ to 2⁹ units or so.
            self.add_limbs(u128::from(p) << t, 0);
        } else if t < 0 {
            self.add_limbs(u128::from(round_shift(p, t.unsigned_abs())), 0);
        } else {
            // Above bit 80 the square straddles the upper limbs: lift it by 64, and the rest goes below.
            let rest = t - 64;
            let wide = u128::from(p) << (rest % 64);
            if rest < 64 {
                self.add_limbs((wide & u128::from(u64::MAX)) << 64, (wide >> 64) as u64);
            } else {
                self.add_limbs(0, wide as u64);
            }
        }
    }

    #[inline]
    fn add_limbs(&mut self, low: u128, high: u64) {
        let own = u128::from(self.0[0]) | (u128::from(self.0[1]) << 64);
        let (sum, carry) = own.overflowing_add(low);
        let (top, over_carry) = self.0[2].overflowing_add(u64::from(carry));
        let (top, over_high) = top.overflowing_add(high);
        *self = if over_carry | over_high {
            Self::PINNED
        } else {
            Self([sum as u64, (sum >> 64) as u64, top])
        };
    }

    /// Whether the sum has left its range.
    pub fn is_pinned(self) -> bool {
        self == Self::PINNED
    }

    /// The sum with these limbs, least significant first.
    pub const fn from_limbs(limbs: [u64; 3]) -> Self {
        Self(limbs)
    }

    /// The limbs, least significant first.
    pub const fn limbs(self) -> [u64; 3] {
        self.0
    }
}

/// `value` = ± significand × 2^exponent, the significand below 2²⁴. Zero has a significand of zero.
#[inline]
fn split(value: f32) -> (u64, i32) {
    let bits = value.to_bits();
    let biased = ((bits >> 23) & 0xff) as i32;
    let fraction = u64::from(bits & 0x7f_ffff);
    if biased == 0 {
        (fraction, -149)
    } else {
        (fraction | 0x80_0000, biased - 150)
    }
}

/// `significand` / 2^`shift`, rounded to nearest, halves up. For significands below 2⁴⁸.
#[inline]
fn round_shift(significand: u64, shift: u32) -> u64 {
    debug_assert!(shift > 0);
    if shift > 62 {
        0
    } else {
        (significand + (1 << (shift - 1))) >> shift
    }
}

/// 2^`exponent`, for exponents of a normal `f64`; the nearest such power outside them.
pub fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-1022, 1023) + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every sign and exponent, with fractions that are all zeros, all ones, and mixed.
    fn values() -> impl Iterator<Item = f32> {
        let lows = [0_u32, 1, 0x5a5a, 0x8000, 0xffff];
        (0..=0xffff_u32)
            .flat_map(move |high| lows.map(|low| f32::from_bits(high << 16 | low)))
            .filter(|v| v.is_finite())
    }

    const UNITS: [f32; 5] = [1.0, 1e9, 1e-6, f32::MAX, f32::from_bits(1)];

    /// `v` × 2^exponent in parts that stay normal: exact.
    fn scaled(v: f64, exponent: i32) -> f64 {
        v * power_of_two(exponent / 2) * power_of_two(exponent - exponent / 2)
    }

    #[test]
    fn conversion_agrees_with_a_slow_exact_one_over_every_exponent() {
        for unit in UNITS.map(Unit::at_least) {
            for v in values().filter(|v| v.abs() <= unit.limit()) {
                let exact = scaled(f64::from(v), VALUE_FRACTION_BITS - unit.exponent()).round() as i128;
                assert_eq!(unit.fixed(v).value, exact, "{v:e} in units of 2^{}", unit.exponent());
            }
        }
    }

    #[test]
    fn squares_agree_with_a_slow_exact_conversion_over_every_exponent() {
        for unit in UNITS.map(Unit::at_least) {
            for v in values().filter(|v| v.abs() <= unit.limit()) {
                let mut sum = SquareSum::default();
                sum.add(&unit.fixed(v));
                let square = scaled(f64::from(v) * f64::from(v), SQUARE_FRACTION_BITS - 2 * unit.exponent()).round();
                // 48 significant bits: the part above 2⁹⁶ and the part below are exact.
                let high = (square * power_of_two(-96)).floor();
                let low = (square - high * power_of_two(96)) as u128;
                let [a, b, c] = sum.limbs();
                assert_eq!(
                    u128::from(a) | u128::from(b as u32) << 64,
                    low,
                    "{v:e} in units of 2^{}",
                    unit.exponent()
                );
                assert_eq!(u128::from(b >> 32) | u128::from(c) << 32, high as u128, "{v:e}");
            }
        }
    }

    #[test]
    fn unit_is_the_smallest_power_of_two_not_below_the_radiance() {
        for (radiance, exponent) in [(1.0, 0), (1.5, 1), (2.0, 1), (0.75, 0), (1e9, 30), (f32::MAX, 128)] {
            assert_eq!(Unit::at_least(radiance).exponent(), exponent, "{radiance}");
        }
        assert_eq!(Unit::at_least(f32::from_bits(1)).exponent(), -149);
        for odd in [0.0, -3.0, f32::NAN, f32::INFINITY] {
            assert_eq!(Unit::at_least(odd).exponent(), 0);
        }
    }

    #[test]
    fn square_sums_carry_across_limbs_and_pin_at_the_top() {
        let unit = Unit::at_least(1.0);
        let mut sum = SquareSum([u64::MAX, u64::MAX, 6]);
        // 2⁻⁵² units, whose square is one step.
        let step = unit.fixed(power_of_two(-52) as f32);
        sum.add(&step);
        assert_eq!(sum.limbs(), [0, 0, 7]);
        let mut sum = SquareSum([u64::MAX, u64::MAX, u64::MAX - 1]);
        sum.add(&step);
        assert!(!sum.is_pinned());
        for v in [unit.fixed(unit.limit()), step, unit.fixed(0.0)] {
            sum = SquareSum([u64::MAX; 3]);
            sum.add(&v);
            assert!(sum.is_pinned());
        }
        let mut sum = SquareSum::default();
        for _ in 0..256 {
            assert!(!sum.is_pinned());
            sum.add(&unit.fixed(unit.limit()));
        }
        assert!(sum.is_pinned(), "256 squares of 2^80 are 2^88");
    }
}
