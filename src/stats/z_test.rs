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
