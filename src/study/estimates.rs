//! Estimates over runs, with their intervals. Those of medians lie between two runs in their order (Conover 1999, section 3.2), and are
//! right however runs are distributed; those of means and ratios are Student's.

use crate::stats::student::t_quantile;
use serde::Serialize;

/// The probability with which intervals hold what they are of.
const CONFIDENCE: f64 = 0.95;

/// An estimate with its interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// The estimate.
    pub value: f64,
    /// Its bounds; all numbers, where nothing is known of them.
    pub bounds: [f64; 2],
}

/// The quantile of sorted values, between neighbours where it falls between two (Hyndman and Fan 1996, definition 7).
pub(super) fn quantile(sorted: &[f64], p: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let place = p * last as f64;
    let below = place as usize;
    let above = (below + 1).min(last);
    let share = place - below as f64;
    if share == 0.0 {
        return sorted[below];
    }
    sorted[below] * (1.0 - share) + sorted[above] * share
}

/// The median of sorted values, some of which may be infinite.
pub(super) fn median(sorted: &[f64]) -> f64 {
    let (low, high) = (sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2]);
    if low == high { low } else { 0.5 * (low + high) }
}

/// The interval of the median of sorted values: between the k-th from either end, with the largest k for which fewer than k of them are
/// below the truth with a probability of 2.5 % at most. All numbers where there is no such k.
pub(super) fn bounds_of_median(sorted: &[f64]) -> [f64; 2] {
    let n = sorted.len();
    let mut probability = libm::exp2(-(n as f64));
    let (mut below, mut k) = (0.0, 0);
    while below + probability <= 0.5 * (1.0 - CONFIDENCE) && k < n / 2 {
        below += probability;
        probability *= (n - k) as f64 / (k + 1) as f64;
        k += 1;
    }
    match k {
        0 => [0.0, f64::INFINITY],
        k => [sorted[k - 1], sorted[n - k]],
    }
}

/// exp of the difference of two means, with Welch's (1947) degrees of freedom.
pub(super) fn ratio_of_logs(first: &[f64], other: &[f64]) -> Option<Interval> {
    let [a, b] = [first, other].map(moments);
    let ((a, va, na), (b, vb, nb)) = (a?, b?);
    let variance = va / na + vb / nb;
    let degrees = variance * variance / (va * va / (na * na * (na - 1.0)) + vb * vb / (nb * nb * (nb - 1.0)));
    let half = if variance > 0.0 {
        t_quantile(0.5 * (1.0 + CONFIDENCE), degrees) * variance.sqrt()
    } else {
        0.0
    };
    Some(Interval {
        value: libm::exp(a - b),
        bounds: [libm::exp(a - b - half), libm::exp(a - b + half)],
    })
}

/// Mean, variance and number of values, of which there are two at least.
fn moments(values: &[f64]) -> Option<(f64, f64, f64)> {
    let n = values.len() as f64;
    if n < 2.0 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0);
    Some((mean, variance, n))
}

/// The mean of values, of which there are two at least.
pub(super) fn mean(values: &[f64]) -> Option<Interval> {
    let (mean, variance, n) = moments(values)?;
    let half = t_quantile(0.5 * (1.0 + CONFIDENCE), n - 1.0) * (variance / n).sqrt();
    Some(Interval {
        value: mean,
        bounds: [mean - half, mean + half],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Purpose, StreamKey};

    #[test]
    fn quantiles_lie_between_neighbours() {
        let sorted = [1.0, 2.0, 4.0, 8.0, 16.0];
        assert_eq!(
            [0.0, 0.1, 0.5, 0.875, 1.0].map(|p| quantile(&sorted, p)),
            [1.0, 1.4, 4.0, 12.0, 16.0]
        );
        assert!(quantile(&[], 0.5).is_nan());
        assert_eq!(
            (quantile(&[3.0], 0.9), median(&sorted), median(&sorted[1..])),
            (3.0, 4.0, 6.0)
        );
        assert_eq!(median(&[1.0, f64::INFINITY, f64::INFINITY]), f64::INFINITY);
    }

    /// P(X <= 3) = 0.0106 and P(X <= 4) = 0.0384 of 16 tosses, P(X = 0) = 0.0156 of 6 and 0.031 of 5.
    #[test]
    fn bounds_of_medians_are_those_of_the_binomial_distribution() {
        let sorted: Vec<f64> = (1..=16).map(f64::from).collect();
        assert_eq!(bounds_of_median(&sorted), [4.0, 13.0]);
        assert_eq!(bounds_of_median(&sorted[..6]), [1.0, 6.0]);
        assert_eq!(bounds_of_median(&sorted[..5]), [0.0, f64::INFINITY]);
    }

    /// Of exponential values, as skewed as times are, in 2000 samples of 12.
    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let (mut medians, mut ratios, mut means) = (0, 0, 0);
        for sample in 0..2000 {
            let mut stream = StreamKey::new(5, sample, 0).stream(Purpose::FILM, 0);
            let mut exponential = || -libm::log(1.0 - stream.next_f64());
            let mut values: Vec<f64> = (0..12).map(|_| exponential()).collect();
            let mut logs = |n: usize| -> Vec<f64> {
                (0..n)
                    .map(|_| 0.3 * (0..4).map(|_| exponential()).sum::<f64>())
                    .collect()
            };
            let holds =
                |interval: Interval, truth: f64| i32::from(interval.bounds[0] <= truth && truth <= interval.bounds[1]);
            let (first, other) = (logs(12), logs(8));
            ratios += holds(ratio_of_logs(&first, &other).expect("enough"), 1.0);
            means += holds(mean(&first).expect("enough"), 1.2);
            values.sort_by(f64::total_cmp);
            let [low, high] = bounds_of_median(&values);
            let truth = std::f64::consts::LN_2;
            medians += i32::from(low <= truth && truth <= high);
        }
        // Medians: 96.1 % by the binomial distribution, give or take 0.4; the others a little less than 95 %, of skewed values.
        for (name, held, range) in [
            ("medians", medians, 1896..1948),
            ("ratios", ratios, 1860..1940),
            ("means", means, 1830..1930),
        ] {
            assert!(range.contains(&held), "{name}: {held}");
        }
    }

    #[test]
    fn ratios_and_means_are_as_computed_by_hand() {
        let equal = ratio_of_logs(&[1.0, 1.0], &[0.0, 0.0]).expect("enough");
        assert!((equal.value - std::f64::consts::E).abs() < 1e-12 && equal.bounds == [equal.value; 2]);
        assert_eq!(ratio_of_logs(&[1.0], &[1.0, 2.0]), None);
        let of = mean(&[1.0, 3.0]).expect("enough");
        // t of 97.5 % with one degree of freedom is 12.706.
        assert!((of.value - 2.0).abs() < 1e-12 && (of.bounds[1] - 2.0 - 12.706_204_7).abs() < 1e-6);
    }
}
