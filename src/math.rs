//! Elementary functions that give the same bits on every platform.
//!
//! The standard library forwards `sin`, `exp` and their kin to the platform's C library, whose last bits differ. A
//! picture's bytes must not, so everything that shapes one calls these (`clippy.toml` forbids the others). They
//! forward to the [`libm`] crate, which is written in Rust. Square roots are exact everywhere and need no wrapper.

/// Sine of an angle in radians.
#[inline]
#[must_use]
pub fn sin(x: f32) -> f32 {
    libm::sinf(x)
}

/// Cosine of an angle in radians.
#[inline]
#[must_use]
pub fn cos(x: f32) -> f32 {
    libm::cosf(x)
}

/// Tangent of an angle in radians.
#[inline]
#[must_use]
pub fn tan(x: f32) -> f32 {
    libm::tanf(x)
}

/// Natural exponential.
#[inline]
#[must_use]
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// Natural logarithm.
#[inline]
#[must_use]
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// `x` to the power `y`.
#[inline]
#[must_use]
pub fn pow(x: f32, y: f32) -> f32 {
    libm::powf(x, y)
}

/// `2` to the power `x`, for `x` in [-126, 127]; what lies beyond is taken as the nearer end.
///
/// A polynomial of our own, without branches, so that loops over it become vectors: x = k + f with a whole k and
/// |f| <= 1/2, and 2ᶠ by a polynomial of degree 6 (fitted to the least relative error, 3e-9, its coefficients rounded to
/// `f32` one after the other). Rounding makes the relative error of the result less than 1e-7. Whole powers are exact.
#[inline]
#[must_use]
pub fn exp2(x: f32) -> f32 {
    /// 3/2 · 2²³: a sum with it has no room for a fraction, so it rounds, and the last bits are the whole part.
    const ROUNDER: f32 = 12_582_912.0;
    /// The exponent field of 1.
    const BIAS: u32 = 127;
    const MANTISSA_BITS: u32 = 23;
    let x = x.clamp(-126.0, 127.0);
    let rounded = x + ROUNDER;
    let f = x - (rounded - ROUNDER);
    let fraction = 1.0
        + f * (std::f32::consts::LN_2
            + f * (0.240_226_48
                + f * (0.055_503_6 + f * (0.009_618_506 + f * (0.001_339_080_6 + f * 0.000_153_264_63)))));
    // Nine bits are left after the shift: the whole part's sign falls off the top with the rounder's own bits.
    let scale = f32::from_bits((rounded.to_bits().wrapping_add(BIAS)) << MANTISSA_BITS);
    fraction * scale
}

/// The inverse of the error function, for `y` in (-1, 1): `x` with erf(x) = `y`, to a relative error of 1e-7.
///
/// Polynomials in −ln(1 − y²) (Giles 2010, "Approximating the erfinv function", the single-precision ones), evaluated in
/// `f64` so that 1 − y² keeps its digits near the ends.
#[inline]
#[must_use]
pub fn erf_inverse(y: f64) -> f64 {
    /// For −ln(1 − y²) < 5, in powers of it less 2.5, highest first.
    const CENTRE: [f64; 9] = [
        2.810_226_36e-8,
        3.432_739_39e-7,
        -3.523_387_7e-6,
        -4.391_506_54e-6,
        0.000_218_580_87,
        -0.001_253_725_03,
        -0.004_177_681_64,
        0.246_640_727,
        1.501_409_41,
    ];
    /// Beyond, in powers of its root less 3.
    const TAIL: [f64; 9] = [
        -0.000_200_214_257,
        0.000_100_950_558,
        0.001_349_343_22,
        -0.003_673_428_44,
        0.005_739_507_73,
        -0.007_622_461_3,
        0.009_438_870_47,
        1.001_674_06,
        2.832_976_82,
    ];
    let w = -libm::log((1.0 - y) * (1.0 + y));
    let (x, coefficients) = if w < 5.0 {
        (w - 2.5, CENTRE)
    } else {
        (w.sqrt() - 3.0, TAIL)
    };
    y * coefficients.into_iter().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relative_error(x: f32) -> f64 {
        let exact = libm::exp2(f64::from(x));
        (f64::from(exp2(x)) - exact).abs() / exact
    }

    /// Every 1999th number of [-126, 127], of all magnitudes; and every 2⁻¹⁸ of [-21, 1].
    #[test]
    fn powers_of_two_are_near_the_truth_everywhere() {
        let all_magnitudes = (0..=126_f32.to_bits()).step_by(1999).map(f32::from_bits);
        let both_signs = all_magnitudes.flat_map(|x| [x, -x]);
        let where_steps_are = (0..=22_u32 << 18).map(|i| i as f32 / (1 << 18) as f32 - 21.0);
        let worst = both_signs
            .chain(where_steps_are)
            .map(relative_error)
            .fold(0.0, f64::max);
        assert!(worst < 1e-7, "{worst}");
    }

    #[test]
    fn whole_powers_of_two_are_exact() {
        for k in -126_i32..=127 {
            assert_eq!(exp2(k as f32).to_bits(), ((k + 127) as u32) << 23, "{k}");
        }
    }

    #[test]
    fn powers_of_two_saturate_beyond_their_range() {
        for (x, nearest) in [
            (-1e30, -126.0),
            (f32::NEG_INFINITY, -126.0),
            (128.0, 127.0),
            (f32::INFINITY, 127.0),
        ] {
            assert_eq!(exp2(x), exp2(nearest));
        }
        assert!(exp2(f32::NAN).is_nan());
    }

    #[test]
    fn the_inverse_of_the_error_function_inverts_it() {
        for i in -3_900_i32..=3_900 {
            let x = f64::from(i) * 1e-3;
            let found = erf_inverse(libm::erf(x));
            assert!((found - x).abs() <= 1e-6 * x.abs().max(0.1), "{x}: {found}");
        }
        assert_eq!(erf_inverse(0.0), 0.0);
        assert!(erf_inverse(1.0 - f64::EPSILON).is_finite());
    }

    /// The bits of every 2⁻¹⁰ of [-24, 1), summed up: they are the same in every build and on every platform.
    #[test]
    fn powers_of_two_have_the_same_bits_everywhere() {
        let bits = (0..25_u64 << 10).map(|i| exp2(i as f32 / 1024.0 - 24.0).to_bits());
        let sum = bits.fold(0_u64, |sum, b| sum.wrapping_mul(31).wrapping_add(u64::from(b)));
        assert_eq!(sum, 4_722_323_864_859_202_777);
    }
}
