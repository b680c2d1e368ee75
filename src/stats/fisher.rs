//! The F distribution: its tails and its quantiles, for any positive degrees of freedom, fractional, large or infinite.
//!
//! Written here because what it is used for needs both degrees of freedom in the millions, where an incomplete beta
//! function with a fixed number of terms has not converged, and where differences of log-gamma functions cancel.

use std::f64::consts::PI;

/// Degrees of freedom from here on stand for infinitely many: what they change is below the rounding.
const MANY: f64 = 1e15;
/// Half the range of ln f in which quantiles are sought.
const LOG_RANGE: f64 = 690.0;
/// More terms than the continued fraction takes: about √(degrees of freedom) at its worst.
const MAX_TERMS: usize = 1_000_000;

/// Both tails at one place, and the density of ln f there.
struct Tails {
    lower: f64,
    upper: f64,
    log_density: f64,
}

/// The probability that a variable of the F distribution with `d1` and `d2` degrees of freedom is above `f`. Keeps its
/// digits in the far tail. Degrees of freedom may be fractional or infinite; not a number where they are not positive.
#[must_use]
pub fn f_upper_tail(f: f64, d1: f64, d2: f64) -> f64 {
    if is_valid(d1, d2) {
        tails(f, d1, d2).upper
    } else {
        f64::NAN
    }
}

/// The f below which a variable of the F distribution with `d1` and `d2` degrees of freedom lies with probability `p`.
/// With `d2` infinite this is the quantile of chi-square over its `d1` degrees of freedom. Not a number where a degree of
/// freedom is not positive or `p` is not in [0, 1].
#[must_use]
pub fn f_quantile(p: f64, d1: f64, d2: f64) -> f64 {
    quantile_of_tails(p, 1.0 - p, d1, d2)
}

/// As [`f_quantile`], with the probability above given too, so that neither loses digits near one.
pub(super) fn quantile_of_tails(lower: f64, upper: f64, d1: f64, d2: f64) -> f64 {
    if !is_valid(d1, d2) || !(0.0..=1.0).contains(&lower) || !(0.0..=1.0).contains(&upper) {
        return f64::NAN;
    }
    if lower == 0.0 {
        return 0.0;
    }
    if upper == 0.0 {
        return f64::INFINITY;
    }
    // Newton's steps for the logarithm of the smaller tail as a function of ln f, kept inside a shrinking bracket.
    let (mut low, mut high, mut at) = (-LOG_RANGE, LOG_RANGE, 0.0);
    for _ in 0..200 {
        let here = tails(libm::exp(at), d1, d2);
        let is_below = if lower < upper {
            here.lower < lower
        } else {
            here.upper > upper
        };
        if is_below {
            low = at;
        } else {
            high = at;
        }
        let step = if lower < upper {
            here.lower / here.log_density * libm::log(lower / here.lower)
        } else {
            here.upper / here.log_density * libm::log(here.upper / upper)
        };
        let newton = at + step;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        let moved = (next - at).abs();
        at = next;
        if moved <= 1e-14 * at.abs().max(0.1) {
            break;
        }
    }
    libm::exp(at)
}

fn is_valid(d1: f64, d2: f64) -> bool {
    d1 > 0.0 && d2 > 0.0
}

/// The tails at `f`. The distribution is that of the incomplete beta function I_x(a, b) with a = d1/2, b = d2/2 and
/// x = d1 f / (d1 f + d2); the side of the mean that `f` is on is computed, the other is what is left.
fn tails(f: f64, d1: f64, d2: f64) -> Tails {
    if f.is_nan() {
        return Tails {
            lower: f64::NAN,
            upper: f64::NAN,
            log_density: f64::NAN,
        };
    }
    let (d1, d2) = (d1.min(MANY), d2.min(MANY));
    let (a, b, ratio) = (0.5 * d1, 0.5 * d2, d1 / d2);
    let x = if f > 0.0 { 1.0 / (1.0 + 1.0 / (ratio * f)) } else { 0.0 };
    let y = 1.0 / (1.0 + ratio * f.max(0.0));
    if x == 0.0 || y == 0.0 {
        return Tails {
            lower: if x == 0.0 { 0.0 } else { 1.0 },
            upper: if x == 0.0 { 1.0 } else { 0.0 },
            log_density: 0.0,
        };
    }
    // x and y over their values at f = 1, where both exponents' first orders cancel.
    let log_x = log_of(1.0 + ratio, f * y, (f - 1.0) * y);
    let log_y = log_of(1.0 + ratio, y, (1.0 - f) * ratio * y);
    let log_gammas = stirling_remainder(a + b) - stirling_remainder(a) - stirling_remainder(b);
    let log_density = (a / (1.0 + ratio) / (2.0 * PI)).sqrt() * libm::exp(a * log_x + b * log_y + log_gammas);
    let distance = a * (f - 1.0).abs() * y;
    if f <= 1.0 {
        let lower = (log_density / fraction(a, b, x, y, distance)).min(1.0);
        Tails {
            lower,
            upper: 1.0 - lower,
            log_density,
        }
    } else {
        let upper = (log_density / fraction(b, a, y, x, distance)).min(1.0);
        Tails {
            lower: 1.0 - upper,
            upper,
            log_density,
        }
    }
}

/// ln(`scale` · `value`) = ln(1 + `excess`), by whichever keeps its digits.
fn log_of(scale: f64, value: f64, excess: f64) -> f64 {
    if excess.abs() < 0.5 {
        libm::log1p(excess)
    } else {
        libm::log(scale) + libm::log(value)
    }
}

/// ln Γ(a) less Stirling's (a − ½) ln a − a + ½ ln 2π.
fn stirling_remainder(a: f64) -> f64 {
    if a < 10.0 {
        return libm::lgamma(a) - ((a - 0.5) * libm::log(a) - a + 0.5 * libm::log(2.0 * PI));
    }
    let square = 1.0 / (a * a);
    (1.0 / 12.0 - square * (1.0 / 360.0 - square * (1.0 / 1260.0 - square * (1.0 / 1680.0 - square / 1188.0)))) / a
}

/// The continued fraction that x^a y^b / B(a, b) is divided by to give I_x(a, b), with y = 1 − x and
/// `distance` = a y − b x ≥ 0 (DiDonato and Morris 1992, equation 9), evaluated by Lentz's method.
fn fraction(a: f64, b: f64, x: f64, y: f64, distance: f64) -> f64 {
    let tiny = f64::MIN_POSITIVE / f64::EPSILON;
    let away_from_zero = |v: f64| if v.abs() < tiny { tiny } else { v };
    let mut value = away_from_zero(a * (distance + 1.0) / (a + 1.0));
    let (mut c, mut d) = (value, 0.0);
    for term in 1..=MAX_TERMS {
        let n = term as f64;
        let span = a + 2.0 * n - 1.0;
        let numerator = (a + n - 1.0) / span * ((a + b + n - 1.0) * x) * n * ((b - n) * x) / span;
        let denominator = n + n * (b - n) * x / span + (a + n) * (distance + 1.0 + n * (1.0 + y)) / (span + 2.0);
        d = 1.0 / away_from_zero(denominator + numerator * d);
        c = away_from_zero(denominator + numerator / c);
        let change = c * d;
        value *= change;
        if (change - 1.0).abs() <= f64::EPSILON {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::chi_square;
    use statrs::distribution::{ContinuousCDF, FisherSnedecor};

    fn assert_near(got: f64, expected: f64, relative: f64, case: &str) {
        assert!(
            (got - expected).abs() <= relative * expected.abs(),
            "{case}: {got:e} is not {expected:e}"
        );
    }

    #[test]
    fn quantiles_are_those_of_tables() {
        for (p, d1, d2, expected) in [
            (0.95, 1.0, 1.0, 161.447_638_797_588),
            (0.975, 1.0, 1.0, 647.789_011_477_844),
            (0.95, 2.0, 10.0, 4.102_821_015_130_40),
            (0.95, 5.0, 10.0, 3.325_834_530_413_01),
            (0.99, 10.0, 10.0, 4.849_146_802_080_83),
            (0.975, 15.0, 240.0, 1.888_315_856_095_06),
            (0.95, 120.0, 120.0, 1.351_886_459_221_24),
            // Fractional degrees, by an incomplete beta function of 40 digits.
            (0.975, 1.37, 20.55, 5.142_726_579_676_19),
            (0.025, 3.5, 52.5, 0.095_774_038_506_017_7),
            // Chi-square over its degrees of freedom.
            (0.95, 1.0, f64::INFINITY, 3.841_458_820_694_12),
            (0.025, 10.0, f64::INFINITY, 0.324_697_278_024_107),
        ] {
            assert_near(f_quantile(p, d1, d2), expected, 1e-11, &format!("{p} {d1} {d2}"));
            // One over the variable has the degrees of freedom swapped.
            let swapped = 1.0 / f_quantile(1.0 - p, d2, d1);
            assert_near(swapped, f_quantile(p, d1, d2), 1e-10, &format!("swapped {p} {d1} {d2}"));
        }
    }

    /// With two degrees above, the tail is (1 + 2 f / d)^(−d/2), for any d.
    #[test]
    fn tails_and_quantiles_agree_with_the_closed_form_of_two_degrees() {
        for d in [0.3, 1.0, 2.5, 17.25, 1e3, 1e6, 1e9] {
            for f in [1e-9, 0.01, 0.5, 0.999, 1.0, 1.5, 4.0, 30.0, 300.0] {
                let upper = libm::exp(-0.5 * d * libm::log1p(2.0 * f / d));
                let case = format!("d {d} f {f}");
                assert_near(f_upper_tail(f, 2.0, d), upper, 1e-12 * (1.0 + f), &case);
                let lower = -libm::expm1(-0.5 * d * libm::log1p(2.0 * f / d));
                assert_near(tails(f, 2.0, d).lower, lower, 1e-9, &case);
                // One over the variable has the degrees of freedom swapped: this holds the other half of the code.
                assert_near(tails(1.0 / f, d, 2.0).lower, upper, 1e-12 * (1.0 + f), &case);
                if upper > 1e-280 {
                    assert_near(quantile_of_tails(lower, upper, 2.0, d), f, 1e-9, &case);
                }
            }
        }
    }

    #[test]
    fn tails_agree_with_an_independent_implementation() {
        for (d1, d2) in [(1.0, 3.0), (0.7, 15.0), (3.3, 49.5), (20.5, 307.5), (150.0, 900.0)] {
            let other = FisherSnedecor::new(d1, d2).expect("positive degrees");
            for f in [1e-3, 0.2, 0.8, 1.0, 1.2, 3.0, 12.0] {
                assert_near(f_upper_tail(f, d1, d2), other.sf(f), 1e-9, &format!("{d1} {d2} {f}"));
            }
        }
    }

    #[test]
    fn infinitely_many_degrees_give_chi_square() {
        for degrees in [1, 2, 7, 192, 20_000] {
            let d = degrees as f64;
            for f in [0.01, 0.7, 0.99, 1.0, 1.01, 1.3, 5.0] {
                let expected = chi_square::upper_tail(f * d, degrees);
                let got = f_upper_tail(f, d, f64::INFINITY);
                assert!((got - expected).abs() < 1e-9, "{d} {f}: {got} is not {expected}");
            }
        }
    }

    /// Millions of degrees of freedom: the logarithm is nearly normal, and quantiles return to where they came from.
    #[test]
    fn large_degrees_of_freedom_converge() {
        for (d1, d2) in [(1e6, 1e6), (1e6, 1.5e7), (3e5 + 0.5, f64::INFINITY)] {
            let spread = (2.0 / d1 + 2.0 / d2).sqrt();
            for (p, z) in [(0.025, -1.959_964), (0.5, 0.0), (0.95, 1.644_854), (0.975, 1.959_964)] {
                let got = libm::log(f_quantile(p, d1, d2)) / spread;
                // The next term of the expansion is of the order of the spread.
                assert!((got - z).abs() < 3.0 * spread, "{d1} {d2} {p}: {got}");
                let back = f_upper_tail(f_quantile(p, d1, d2), d1, d2);
                assert_near(back, 1.0 - p, 1e-9, &format!("{d1} {d2} {p}"));
            }
        }
    }

    #[test]
    fn what_has_no_answer_is_not_a_number() {
        assert!(f_quantile(0.5, 0.0, 1.0).is_nan() && f_quantile(0.5, 1.0, -1.0).is_nan());
        assert!(f_quantile(1.5, 1.0, 1.0).is_nan() && f_quantile(f64::NAN, 1.0, 1.0).is_nan());
        assert!(f_upper_tail(f64::NAN, 1.0, 1.0).is_nan() && f_upper_tail(1.0, f64::NAN, 1.0).is_nan());
        assert_eq!(
            (f_quantile(0.0, 3.0, 4.0), f_quantile(1.0, 3.0, 4.0)),
            (0.0, f64::INFINITY)
        );
        assert_eq!(
            (f_upper_tail(-1.0, 3.0, 4.0), f_upper_tail(f64::INFINITY, 3.0, 4.0)),
            (1.0, 0.0)
        );
    }
}
