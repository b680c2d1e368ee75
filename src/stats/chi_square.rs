//! Pearson's chi-square test: do counts come from a distribution, and how small a deviation would show.

use super::normal::bisect;
use serde::Serialize;
use statrs::function::gamma::checked_gamma_ur;

/// Cells with fewer expected counts are pooled: below five the statistic is not near its distribution.
const MIN_EXPECTED: f64 = 5.0;

/// The outcome of a chi-square test.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChiSquare {
    /// Σ (observed − expected)² / expected over the cells. Infinite where counts fell in cells that allow none.
    pub statistic: f64,
    /// Cells after pooling, less one.
    pub degrees_of_freedom: usize,
    /// The probability of a statistic at least this large when nothing is wrong.
    pub p: f64,
    /// Counts in all.
    pub samples: u64,
}

/// Tests `observed` counts against `probabilities` of the same cells. The probabilities are taken as fractions of the
/// samples; they should sum to one, since samples that fell nowhere are not seen. Cells with fewer than five expected
/// counts are pooled, smallest first, until the pool has five; what is left goes with the last pool.
/// Cells beyond the shorter list count as missing: zero counts, or zero probability.
#[must_use]
pub fn chi_square(observed: &[u64], probabilities: &[f64]) -> ChiSquare {
    let samples: u64 = observed.iter().sum();
    let cells = observed.len().max(probabilities.len());
    let cell = |i: usize| {
        let count = observed.get(i).copied().unwrap_or(0) as f64;
        (count, probabilities.get(i).copied().unwrap_or(0.0) * samples as f64)
    };
    let mut cells: Vec<(f64, f64)> = (0..cells).map(cell).collect();
    cells.sort_by(|a, b| a.1.total_cmp(&b.1));

    let impossible = cells.iter().any(|&(count, expected)| count > 0.0 && expected <= 0.0);
    let mut pools: Vec<(f64, f64)> = Vec::new();
    let mut pool = (0.0, 0.0);
    for (count, expected) in cells {
        pool = (pool.0 + count, pool.1 + expected);
        if pool.1 >= MIN_EXPECTED {
            pools.push(std::mem::take(&mut pool));
        }
    }
    match pools.last_mut() {
        Some(last) => *last = (last.0 + pool.0, last.1 + pool.1),
        None => pools.push(pool),
    }
    let statistic = if impossible {
        f64::INFINITY
    } else {
        pools
            .iter()
            .filter(|p| p.1 > 0.0)
            .map(|(o, e)| (o - e) * (o - e) / e)
            .sum()
    };
    let degrees_of_freedom = pools.len() - 1;
    ChiSquare {
        statistic,
        degrees_of_freedom,
        p: upper_tail(statistic, degrees_of_freedom),
        samples,
    }
}

impl ChiSquare {
    /// The smallest deviation that this test at significance `alpha` finds with probability `power`, as the root mean
    /// square relative error of the cells' probabilities, w = √(Σ (q − p)²/p) for true probabilities q (Cohen's w). The
    /// statistic is then noncentral chi-square with noncentrality n w².
    #[must_use]
    pub fn smallest_visible_deviation(&self, alpha: f64, power: f64) -> f64 {
        let dof = self.degrees_of_freedom;
        if dof == 0 || self.samples == 0 {
            return f64::INFINITY;
        }
        let k = dof as f64;
        let critical = bisect(0.0, 1e3 + 10.0 * k, |x| upper_tail(x, dof) > alpha);
        let noncentrality = bisect(0.0, 1e3 + 10.0 * k, |l| noncentral_upper_tail(critical, dof, l) < power);
        (noncentrality / self.samples as f64).sqrt()
    }
}

/// The probability that a chi-square variable of `dof` degrees of freedom is above `x`. Without a degree of freedom the
/// variable is zero.
#[must_use]
pub fn upper_tail(x: f64, dof: usize) -> f64 {
    if dof == 0 || x.is_nan() {
        return if x <= 0.0 || dof == 0 && x.is_finite() {
            1.0
        } else {
            0.0
        };
    }
    gamma_q(0.5 * dof as f64, 0.5 * x)
}

/// As [`upper_tail`], of a noncentral chi-square variable: a Poisson mixture of central ones, with mean λ/2.
fn noncentral_upper_tail(x: f64, dof: usize, noncentrality: f64) -> f64 {
    let mean = 0.5 * noncentrality;
    if mean <= 0.0 {
        return upper_tail(x, dof);
    }
    // All but e⁻³² of the Poisson weight lies within eight deviations of its mean.
    let spread = 8.0 * mean.sqrt() + 40.0;
    let (first, last) = ((mean - spread).max(0.0) as usize, (mean + spread) as usize);
    (first..=last)
        .map(|j| {
            let log_weight = j as f64 * libm::log(mean) - mean - libm::lgamma(j as f64 + 1.0);
            libm::exp(log_weight) * upper_tail(x, dof + 2 * j)
        })
        .sum()
}

/// The regularised upper incomplete gamma function Q(a, x), for a > 0.
fn gamma_q(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    if x.is_infinite() {
        return 0.0;
    }
    checked_gamma_ur(a, x).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_are_those_of_tables_and_of_closed_forms() {
        // Upper quantiles as statistical tables print them.
        for (x, dof, p) in [
            (3.841_458_820_694_124, 1, 0.05),
            (18.307_038_053_275_146, 10, 0.05),
            (23.209_251_158_954_356, 10, 0.01),
            (124.342_113_404_004_07, 100, 0.05),
        ] {
            assert!(
                (upper_tail(x, dof) - p).abs() < 1e-9,
                "{dof} {x} {}",
                upper_tail(x, dof)
            );
        }
        // Two degrees: e^(-x/2); four: e^(-x/2) (1 + x/2); far tails too.
        for x in [0.1, 1.0, 4.0, 30.0, 100.0] {
            let half = 0.5 * x;
            let (two, four) = (libm::exp(-half), libm::exp(-half) * (1.0 + half));
            assert!((upper_tail(x, 2) - two).abs() < 1e-9 * two, "{x} {}", upper_tail(x, 2));
            assert!(
                (upper_tail(x, 4) - four).abs() < 1e-9 * four,
                "{x} {}",
                upper_tail(x, 4)
            );
        }
        // Many degrees: nearly normal (Wilson and Hilferty 1931).
        for (at, dof) in [(0.99, 20_000), (1.0, 20_000), (1.01, 20_000)] {
            let spread = 2.0 / (9.0 * dof as f64);
            let z = (libm::cbrt(at) - (1.0 - spread)) / spread.sqrt();
            let p = upper_tail(at * dof as f64, dof);
            assert!((p - crate::stats::normal::upper_tail(z)).abs() < 1e-4, "{at} {p}");
        }
        assert_eq!((upper_tail(0.0, 3), upper_tail(f64::INFINITY, 3)), (1.0, 0.0));
        assert_eq!((upper_tail(0.0, 0), upper_tail(f64::NAN, 3)), (1.0, 0.0));
    }

    #[test]
    fn statistic_is_pearsons() {
        let t = chi_square(&[18, 22, 20], &[1.0 / 3.0; 3]);
        assert!((t.statistic - 0.4).abs() < 1e-12);
        assert_eq!((t.degrees_of_freedom, t.samples), (2, 60));
        assert!((t.p - libm::exp(-0.2)).abs() < 1e-12);
    }

    #[test]
    fn thin_cells_are_pooled_until_they_expect_five() {
        // Expected: 1, 1, 1, 2 (pooled to 5), 45, 50.
        let t = chi_square(&[1, 1, 1, 2, 45, 50], &[0.01, 0.01, 0.01, 0.02, 0.45, 0.5]);
        assert_eq!((t.degrees_of_freedom, t.statistic), (2, 0.0));
        let t = chi_square(&[3], &[1.0]);
        assert_eq!((t.degrees_of_freedom, t.p), (0, 1.0));
        assert_eq!(chi_square(&[], &[]).p, 1.0);
    }

    #[test]
    fn a_count_where_none_can_be_fails() {
        for (observed, probabilities) in [
            (vec![500, 499, 1], vec![0.5, 0.5, 0.0]),
            (vec![500, 499, 1], vec![0.5, 0.5]),
        ] {
            assert_eq!(chi_square(&observed, &probabilities).p, 0.0);
        }
    }

    #[test]
    fn visible_deviation_has_the_stated_power() {
        // 20 cells, 2000 counts a test; the last cell's share is moved so that w is the visible deviation.
        let (cells, alpha, power) = (20, 0.05, 0.9);
        let even = vec![1.0 / cells as f64; cells];
        let w = chi_square(&vec![100; cells], &even).smallest_visible_deviation(alpha, power);
        // Alternate cells gain and lose the fraction w: the root mean square is w.
        let mut state = 7_u64;
        let mut draw = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut failing_share = |w: f64| {
            let failing = (0..1000).filter(|_| {
                let mut counts = vec![0_u64; cells];
                for _ in 0..2000 {
                    let pair = (draw() * 10.0) as usize;
                    counts[2 * pair + usize::from(draw() > 0.5 * (1.0 + w))] += 1;
                }
                chi_square(&counts, &even).p < alpha
            });
            failing.count() as f64 / 1000.0
        };
        // Four standard errors of a share over 1000 tests: 0.028 and 0.038.
        assert!((failing_share(0.0) - alpha).abs() < 0.028);
        assert!((failing_share(w) - power).abs() < 0.038);
        assert_eq!(
            chi_square(&[3], &[1.0]).smallest_visible_deviation(alpha, power),
            f64::INFINITY
        );
    }
}
