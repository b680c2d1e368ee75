//! The normal distribution and thresholds for many tests at once.

use std::f64::consts::SQRT_2;

/// The probability that a standard normal variable is above `z`. Keeps its digits in the far tail.
#[must_use]
pub fn upper_tail(z: f64) -> f64 {
    0.5 * libm::erfc(z / SQRT_2)
}

/// The probability that a standard normal variable is farther from zero than `z`, on either side.
#[must_use]
pub fn two_sided_p(z: f64) -> f64 {
    libm::erfc(z.abs() / SQRT_2)
}

/// The z with `upper_tail(z)` = `p`, for a `p` in (0, 1); beyond that ± 40, where the tail underflows.
#[must_use]
pub fn upper_quantile(p: f64) -> f64 {
    bisect(-40.0, 40.0, |z| upper_tail(z) > p)
}

/// The significance each of `tests` independent tests may use, so that all pass together with probability 1 − `alpha`
/// when nothing is wrong (Sidak 1967): 1 − (1 − α)^(1/m).
#[must_use]
pub fn sidak(alpha: f64, tests: usize) -> f64 {
    -libm::expm1(libm::log1p(-alpha) / tests.max(1) as f64)
}

/// Where `before` turns from true to false in [low, high], to the last bit or so.
pub(super) fn bisect(mut low: f64, mut high: f64, before: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if before(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{ContinuousCDF, Normal};

    #[test]
    fn tails_agree_with_an_independent_implementation() {
        let normal = Normal::standard();
        for z in [-8.0, -1.0, 0.0, 0.5, 1.96, 5.0, 10.0] {
            let expected = normal.sf(z);
            assert!((upper_tail(z) - expected).abs() <= 1e-9 * expected, "{z}");
            let expected = 2.0 * normal.sf(z.abs());
            assert!((two_sided_p(z) - expected).abs() <= 1e-9 * expected, "{z}");
        }
    }

    #[test]
    fn quantiles_invert_the_tail() {
        for p in [1e-300, 1e-12, 0.025, 0.5, 0.9, 1.0 - 1e-9] {
            assert!((upper_tail(upper_quantile(p)) - p).abs() <= 1e-12 * p, "{p}");
        }
        assert!((upper_quantile(0.025) - 1.959_963_984_540_054).abs() < 1e-12);
    }

    #[test]
    fn sidak_keeps_the_chance_that_all_tests_pass() {
        for (alpha, tests) in [(0.05, 1), (0.01, 20), (1e-3, 100_000)] {
            let all_pass = libm::pow(1.0 - sidak(alpha, tests), tests as f64);
            assert!((all_pass - (1.0 - alpha)).abs() < 1e-9);
        }
        assert_eq!(sidak(0.05, 0), sidak(0.05, 1));
    }
}
