//! Tests of means by their standard errors: is it what it should be, are two the same, and how small a bias would show.
//!
//! The statistic is taken as normal: right for means over many samples of bounded variance.

use super::normal::{sidak, two_sided_p, upper_quantile};
use serde::Serialize;

/// A mean and its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The mean.
    pub mean: f64,
    /// The standard error of the mean, not negative.
    pub error: f64,
}

/// The outcome of a z-test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ZTest {
    /// The difference in standard errors. Zero when there is no difference, infinite when there is one but no error.
    pub z: f64,
    /// The probability of a |z| at least this large when nothing is wrong.
    pub p: f64,
    /// The standard error of the difference.
    pub error: f64,
}

impl Estimate {
    /// The mean of `samples` and its standard error: infinite for fewer than two. Two passes, so that nothing cancels.
    #[must_use]
    pub fn of(samples: &[f64]) -> Self {
        let n = samples.len() as f64;
        if samples.is_empty() {
            return Self {
                mean: 0.0,
                error: f64::INFINITY,
            };
        }
        let mean = samples.iter().sum::<f64>() / n;
        if samples.len() < 2 {
            return Self {
                mean,
                error: f64::INFINITY,
            };
        }
        let scatter: f64 = samples.iter().map(|x| (x - mean) * (x - mean)).sum();
        Self {
            mean,
            error: (scatter / (n * (n - 1.0))).sqrt(),
        }
    }

    /// Tests whether this estimates `expected`.
    #[must_use]
    pub fn against(self, expected: f64) -> ZTest {
        ZTest::new(self.mean - expected, self.error)
    }

    /// Tests whether this and an independent `other` estimate the same.
    #[must_use]
    pub fn against_estimate(self, other: Self) -> ZTest {
        ZTest::new(
            self.mean - other.mean,
            (self.error * self.error + other.error * other.error).sqrt(),
        )
    }
}

impl ZTest {
    fn new(difference: f64, error: f64) -> Self {
        let z = if difference == 0.0 { 0.0 } else { difference / error };
        Self {
            z,
            p: two_sided_p(z),
            error,
        }
    }

    /// Whether this passes as one of `tests` that all pass with probability 1 − `alpha` when nothing is wrong (Sidak). A
    /// z that is not a number fails.
    #[must_use]
    pub fn passes(&self, alpha: f64, tests: usize) -> bool {
        self.z.abs() <= z_threshold(alpha, tests)
    }

    /// The smallest true difference that this test, one of `tests` at `alpha`, finds with probability `power`.
    #[must_use]
    pub fn smallest_visible_bias(&self, alpha: f64, tests: usize, power: f64) -> f64 {
        smallest_visible_bias(self.error, alpha, tests, power)
    }
}

/// The |z| that each of `tests` two-sided tests may reach, so that all pass with probability 1 − `alpha` when nothing is
/// wrong.
#[must_use]
pub fn z_threshold(alpha: f64, tests: usize) -> f64 {
    upper_quantile(0.5 * sidak(alpha, tests))
}

/// The smallest true difference that a test with the standard error `error`, one of `tests` at `alpha`, finds with
/// probability `power`: (threshold + z of the power) standard errors. The other side's tail is left out; it adds less than
/// `alpha / 2` to the power.
#[must_use]
pub fn smallest_visible_bias(error: f64, alpha: f64, tests: usize, power: f64) -> f64 {
    error * (z_threshold(alpha, tests) + upper_quantile(1.0 - power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_have_the_textbook_error() {
        let e = Estimate::of(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!(e.mean, 2.5);
        assert!((e.error - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        assert_eq!(
            Estimate::of(&[7.0]),
            Estimate {
                mean: 7.0,
                error: f64::INFINITY
            }
        );
        assert_eq!(
            Estimate::of(&[]),
            Estimate {
                mean: 0.0,
                error: f64::INFINITY
            }
        );
    }

    #[test]
    fn differences_are_counted_in_standard_errors() {
        let (a, b) = (Estimate { mean: 1.0, error: 0.3 }, Estimate { mean: 2.0, error: 0.4 });
        assert!((a.against_estimate(b).z + 2.0).abs() < 1e-12);
        assert!((a.against(0.4).z - 2.0).abs() < 1e-12);
        assert!((a.against(0.4).p - 0.0455).abs() < 1e-4);
    }

    #[test]
    fn an_exact_estimate_passes_only_when_it_is_right() {
        let exact = Estimate { mean: 1.0, error: 0.0 };
        assert!(exact.against(1.0).passes(0.01, 10));
        assert!(!exact.against(1.0 + 1e-9).passes(0.01, 10));
        assert!(
            !Estimate {
                mean: f64::NAN,
                error: 1.0
            }
            .against(1.0)
            .passes(0.01, 1)
        );
    }

    #[test]
    fn more_tests_raise_the_threshold() {
        assert!((z_threshold(0.05, 1) - 1.959_964).abs() < 1e-6);
        assert!((z_threshold(0.05, 100) - 3.474).abs() < 1e-3);
        assert!((smallest_visible_bias(2.0, 0.05, 1, 0.95) - 2.0 * (1.959_964 + 1.644_854)).abs() < 1e-5);
    }

    /// 4000 repetitions of a test on means of uniform numbers: the share that fails is alpha without a bias, and the
    /// promised power with the smallest bias it is said to see.
    #[test]
    fn significance_and_power_are_as_stated() {
        let (alpha, power, n) = (0.05, 0.9, 100);
        let error = (1.0 / 12.0 / n as f64).sqrt();
        let bias = smallest_visible_bias(error, alpha, 1, power);
        let mut state = 1_u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut failing_share = |bias: f64| {
            let fails = |mean: f64| {
                !Estimate {
                    mean: mean + bias,
                    error,
                }
                .against(0.5)
                .passes(alpha, 1)
            };
            (0..4000)
                .filter(|_| fails((0..n).map(|_| uniform()).sum::<f64>() / n as f64))
                .count() as f64
                / 4000.0
        };
        // Four standard errors of the shares: 0.014 and 0.019.
        assert!((failing_share(0.0) - alpha).abs() < 0.014);
        assert!((failing_share(bias) - power).abs() < 0.019);
    }
}
