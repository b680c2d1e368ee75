//! Verdicts of statistical tests. Each prints the smallest deviation that it could have seen, so that a pass says how
//! much it is worth; each has a counterpart that must fail.

use chainlight::stats::chi_square::{ChiSquare, chi_square};
use chainlight::stats::normal::sidak;
use chainlight::stats::z_test::Estimate;

/// The probability that any test of a family fails when nothing is wrong.
pub const ALPHA: f64 = 0.01;
/// The probability with which the smallest visible deviation is found.
pub const POWER: f64 = 0.95;

/// Tests that share a chance of a false alarm: one in a hundred for all together (Sidak).
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Number of tests that must pass.
    pub tests: usize,
}

impl Family {
    /// The significance of one test.
    pub fn significance(self) -> f64 {
        sidak(ALPHA, self.tests)
    }

    /// Holds that `counts` come from `probabilities`, by a test that sees cells off by `sees` in the root mean square.
    #[track_caller]
    pub fn follows(self, case: &str, counts: &[u64], probabilities: &[f64], sees: f64) {
        let result = chi_square(counts, probabilities);
        let visible = result.smallest_visible_deviation(self.significance(), POWER);
        say(&format!(
            "{case}: p {:.4}, sees {:.2} % of the cells in the root mean square",
            result.p,
            100.0 * visible
        ));
        assert!(
            result.p > self.significance() && visible < sees,
            "{case}: {result:?}, sees {visible}"
        );
    }

    /// Holds that the same test would refuse `counts`: the planted bias shows.
    #[track_caller]
    pub fn refuses(self, case: &str, counts: &[u64], probabilities: &[f64]) -> ChiSquare {
        let result = chi_square(counts, probabilities);
        assert!(result.p < self.significance(), "{case} goes unnoticed: {result:?}");
        result
    }

    /// Holds that a mean is `expected` give or take `slack`, by a test that sees a relative bias of `sees`. The slack is
    /// for rounding and truncation; it adds to the bias that is seen.
    #[track_caller]
    pub fn is(self, case: &str, mean: Estimate, expected: f64, slack: f64, sees: f64) {
        let z = mean.against(nearest(mean.mean, expected, slack));
        let visible = (z.smallest_visible_bias(ALPHA, self.tests, POWER) + slack) / expected.abs();
        say(&format!(
            "{case}: {:.6} ± {:.6}, expected {expected:.6}, z {:.2}, sees {:.3} %",
            mean.mean,
            mean.error,
            z.z,
            100.0 * visible
        ));
        assert!(
            z.passes(ALPHA, self.tests) && visible < sees,
            "{case}: {mean:?}, expected {expected}, {z:?}, sees {visible}"
        );
    }

    /// Holds that the same test would refuse `expected`: the planted bias shows.
    #[track_caller]
    pub fn is_not(self, case: &str, mean: Estimate, expected: f64, slack: f64) {
        let z = mean.against(nearest(mean.mean, expected, slack));
        assert!(
            !z.passes(ALPHA, self.tests),
            "{case} goes unnoticed: {mean:?}, expected {expected}, {z:?}"
        );
    }

    /// Holds that the correlation of `pairs` independent pairs of uniform numbers is zero.
    #[track_caller]
    pub fn is_uncorrelated(self, case: &str, mean: Estimate) {
        let z = mean.against(0.0);
        let visible = 12.0 * z.smallest_visible_bias(ALPHA, self.tests, POWER);
        say(&format!("{case}: z {:.2}, sees a correlation of {visible:.4}", z.z));
        assert!(z.passes(ALPHA, self.tests) && visible < 0.01, "{case}: {mean:?}, {z:?}");
    }
}

/// The value nearest to `mean` among those within `slack` of `expected`.
fn nearest(mean: f64, expected: f64, slack: f64) -> f64 {
    if mean.is_nan() {
        return expected;
    }
    mean.clamp(expected - slack, expected + slack)
}

#[expect(clippy::print_stdout, reason = "a test says what it could have seen")]
pub fn say(line: &str) {
    println!("{line}");
}
