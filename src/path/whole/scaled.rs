//! Products of many densities: numbers with an exponent that does not run out.

/// A number m · 2ᵉ with m in [1, 2), or zero, or none at all: what products of a path's densities are kept as. An edge of a
/// thousandth of the scene's size, or of a thousand times it, has a density beyond that of the next by a factor of a million; sixty
/// of them are beyond every f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    mantissa: f64,
    exponent: i64,
}

/// Bits of an f64 below its exponent.
const FRACTION_BITS: u32 = 52;
/// The exponent's bits that stand for an exponent of 0.
const BIAS: u64 = 1023;
/// Exponents farther apart than this make a ratio zero or infinite.
const MOST: i64 = 1022;

impl Scaled {
    /// 1.
    pub const ONE: Self = Self {
        mantissa: 1.0,
        exponent: 0,
    };

    /// The number `value`. Subnormal ones are zero, what is infinite or no number stays so.
    #[inline]
    #[must_use]
    pub fn new(value: f64) -> Self {
        Self {
            mantissa: value,
            exponent: 0,
        }
        .normalized()
    }

    #[inline]
    fn normalized(self) -> Self {
        let bits = self.mantissa.to_bits();
        let exponent = bits >> FRACTION_BITS & 0x7FF;
        if exponent == 0 {
            return Self {
                mantissa: 0.0,
                exponent: 0,
            };
        }
        if exponent == 0x7FF {
            return Self { exponent: 0, ..self };
        }
        Self {
            mantissa: f64::from_bits(bits & !(0x7FF << FRACTION_BITS) | BIAS << FRACTION_BITS),
            exponent: self.exponent + exponent as i64 - BIAS as i64,
        }
    }

    /// This number times `factor`.
    #[inline]
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        self.by(Self::new(factor))
    }

    /// The product of two numbers.
    #[inline]
    #[must_use]
    pub fn by(self, other: Self) -> Self {
        Self {
            mantissa: self.mantissa * other.mantissa,
            exponent: self.exponent + other.exponent,
        }
        .normalized()
    }

    /// This number over another: 0 or infinite where that is beyond f64, no number for 0 / 0.
    #[inline]
    #[must_use]
    pub fn over(self, other: Self) -> f64 {
        let ratio = self.mantissa / other.mantissa;
        if self.mantissa == 0.0 || other.mantissa == 0.0 {
            // Whatever the other's exponent.
            return ratio;
        }
        let exponent = self.exponent - other.exponent;
        if exponent > MOST {
            return ratio * f64::INFINITY;
        }
        if exponent < -MOST {
            return ratio * 0.0;
        }
        ratio * f64::from_bits(((exponent + BIAS as i64) as u64) << FRACTION_BITS)
    }

    /// Whether this is larger than another number; of numbers that are not negative.
    #[inline]
    #[must_use]
    pub fn exceeds(self, other: Self) -> bool {
        if self.mantissa == 0.0 || other.mantissa == 0.0 {
            return self.mantissa > other.mantissa;
        }
        (self.exponent, self.mantissa) > (other.exponent, other.mantissa)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn products_of_a_thousand_densities_neither_overflow_nor_vanish() {
        let density = |i: i32| libm::exp(f64::from(i % 37) * 5.0 - 40.0);
        let (mut up, mut down) = (Scaled::ONE, Scaled::ONE);
        for i in 0..1000 {
            up = up.times(density(i));
            down = down.times(density(999 - i));
        }
        assert!((up.over(down) - 1.0).abs() < 1e-12, "{up:?} {down:?}");
        assert!(up.exceeds(Scaled::ONE) && !Scaled::ONE.exceeds(up));
        assert_eq!((up.over(Scaled::ONE), Scaled::ONE.over(up)), (f64::INFINITY, 0.0));
    }

    #[test]
    fn what_is_zero_infinite_or_no_number_stays_so() {
        let zero = Scaled::new(0.0);
        assert_eq!(
            (zero.times(1e300).over(Scaled::ONE), Scaled::ONE.over(zero)),
            (0.0, f64::INFINITY)
        );
        let small = Scaled::new(1e-300).times(1e-300);
        assert_eq!((zero.over(small), small.over(zero)), (0.0, f64::INFINITY));
        assert!(zero.over(zero).is_nan() && Scaled::new(f64::NAN).times(2.0).over(Scaled::ONE).is_nan());
        assert_eq!(Scaled::new(f64::INFINITY).over(Scaled::ONE), f64::INFINITY);
        assert!(Scaled::ONE.exceeds(zero) && !zero.exceeds(Scaled::ONE) && !zero.exceeds(zero));
    }

    proptest! {
        #[test]
        fn ratios_are_those_of_the_numbers(a in 1e-150_f64..1e150, b in 1e-150_f64..1e150) {
            prop_assert_eq!(Scaled::new(a).over(Scaled::new(b)), a / b);
            prop_assert_eq!(Scaled::new(a).exceeds(Scaled::new(b)), a > b);
            let product = Scaled::new(a).times(b).over(Scaled::ONE);
            prop_assert!((product / (a * b) - 1.0).abs() < 1e-15, "{} {}", product, a * b);
        }
    }
}
