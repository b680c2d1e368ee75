//! The normalization b = ∫ f of the target function, from a bootstrap.

use super::resample::counted;
use crate::stats::normal::upper_quantile;
use crate::stats::z_test::Estimate;

/// An estimate of the normalization b = ∫ f: the mean of the weights f(x)/p(x) of independent paths drawn with density p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normalization {
    /// The mean weight, not negative. Zero where no path carried light, which does not prove that there is none.
    pub b: f64,
    /// The standard error of `b`; infinite for fewer than two paths.
    pub standard_error: f64,
    /// The number of paths, those without light included.
    pub samples: u64,
}

impl Normalization {
    /// The mean of `weights` and its standard error. Zeros count: they are paths that found no light. Weights that are
    /// negative or not finite count as zeros, as when [resampling](super::resample()).
    #[must_use]
    pub fn of(weights: &[f64]) -> Self {
        let largest = weights.iter().map(|&w| counted(w)).fold(0.0, f64::max);
        // Relative to the largest, so that no square leaves the range.
        let scale = if largest > 0.0 { largest } else { 1.0 };
        let scaled: Vec<f64> = weights.iter().map(|&w| counted(w) / scale).collect();
        let Estimate { mean, error } = Estimate::of(&scaled);
        Self {
            b: mean * scale,
            standard_error: error * scale,
            samples: weights.len() as u64,
        }
    }

    /// The interval that covers ∫ f with probability `confidence` (0.95, say): as many standard errors on either side as
    /// the normal distribution asks for, and never below zero. It covers less where few paths carry most of the weight,
    /// and nothing but zero where none has any.
    #[must_use]
    pub fn interval(&self, confidence: f64) -> [f64; 2] {
        let errors = upper_quantile(0.5 * (1.0 - confidence));
        let half = if errors > 0.0 {
            errors * self.standard_error
        } else {
            0.0
        };
        [(self.b - half).max(0.0), self.b + half]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};

    #[test]
    fn mean_and_error_are_the_textbooks_zeros_included() {
        let n = Normalization::of(&[0.0, 4.0, 0.0, f64::NAN, -7.0, f64::INFINITY, 0.0, 4.0]);
        assert_eq!((n.b, n.samples), (1.0, 8));
        // Σ (w − 1)² = 6 + 18 over 8 · 7.
        assert!((n.standard_error - (24.0_f64 / 56.0).sqrt()).abs() < 1e-15);
        let [low, high] = n.interval(0.95);
        assert!(low == 0.0 && (high - (1.0 + 1.959_963_985 * n.standard_error)).abs() < 1e-9);
    }

    #[test]
    fn extreme_weights_keep_their_digits() {
        for unit in [1e-320, 1e-200, 1e200, 1e307] {
            let n = Normalization::of(&[unit, 3.0 * unit]);
            assert!(
                (n.b / unit - 2.0).abs() < 1e-3 && (n.standard_error / unit - 1.0).abs() < 1e-3,
                "{n:?}"
            );
        }
    }

    #[test]
    fn nothing_sampled_is_nothing_known() {
        assert_eq!(Normalization::of(&[]).interval(0.95), [0.0, f64::INFINITY]);
        assert_eq!(Normalization::of(&[3.0]).interval(0.95), [0.0, f64::INFINITY]);
        assert_eq!(Normalization::of(&[0.0; 5]).interval(0.95), [0.0, 0.0]);
        for confidence in [f64::NAN, -1.0, 0.0] {
            assert_eq!(Normalization::of(&[2.0; 5]).interval(confidence), [2.0, 2.0]);
            assert_eq!(Normalization::of(&[]).interval(f64::NAN), [0.0, 0.0]);
        }
        assert!(Normalization::of(&[1.0, 2.0]).interval(1.0)[1].is_finite());
    }

    /// 2000 bootstraps of 400 weights, three in four of them zero: 95 % intervals cover the truth 95 times in a hundred.
    #[test]
    fn intervals_cover_as_often_as_they_say() {
        let covers = |repetition: &u32| {
            let mut stream = StreamKey::new(5, *repetition, 0).stream(Purpose::LIGHT, 0);
            let weight = |u: f64| if u < 0.25 { 4.0 * u } else { 0.0 };
            let weights: Vec<f64> = (0..400).map(|_| weight(stream.next_f64())).collect();
            let [low, high] = Normalization::of(&weights).interval(0.95);
            (low..=high).contains(&0.125)
        };
        let share = (0..2000).filter(covers).count() as f64 / 2000.0;
        // Four standard errors of the share: 0.02.
        assert!((share - 0.95).abs() < 0.02, "{share}");
    }
}
