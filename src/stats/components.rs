//! The spread of a picture across groups, and over how many independent components it is distributed.
//!
//! Errors of chains are correlated over the picture: a group that visited a caustic too often is too bright in all of
//! it. How far a realised mean-square error may lie from its expectation depends on that. With the covariance Σ of one
//! group's statistics, the sum of squares of a normal error has the mean tr Σ and the variance 2 tr Σ², as that of
//! ν = (tr Σ)² / tr Σ² components of equal variance (Satterthwaite 1946).

use super::group_means::GroupMeans;

/// Fewest groups from which ν is estimated. With fewer it is one, the most careful.
const FEWEST_GROUPS: usize = 4;
/// By how many of its standard errors 1/ν is overstated. An error of ν to the high side makes intervals too short, which
/// one to the low side does not make up for. Chosen by the coverage of the intervals (`error::coverage`): with none, four
/// groups whose error has one component larger than many others cover 86 % instead of 95.
const CAUTION: f64 = 0.75;

/// The spread of one group's statistics, as estimated from several groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The sum over the statistics of their variance across groups: an estimate of tr Σ, without bias.
    pub total_variance: f64,
    /// The number ν of equal and independent components that spread alike, from 1 to the number of statistics, rather too
    /// few than too many. Zero where there is no spread.
    pub components: f64,
    /// Degrees of freedom of each component: the groups less one.
    pub degrees_of_freedom: f64,
}

impl Spread {
    /// The spread across the groups; `None` for fewer than two. ν comes from the scalar products of groups: the covariance
    /// of the statistics would be as large as the square of the picture.
    #[must_use]
    pub fn of(means: &GroupMeans) -> Option<Self> {
        if means.groups() < 2 {
            return None;
        }
        let products = Products::of(means);
        let total = products.trace();
        let degrees_of_freedom = (means.groups() - 1) as f64;
        Some(Self {
            total_variance: total / degrees_of_freedom,
            components: if total > 0.0 {
                (1.0 / products.careful_concentration()).clamp(1.0, means.statistics() as f64)
            } else {
                0.0
            },
            degrees_of_freedom,
        })
    }

    /// Degrees of freedom of [`total_variance`](Self::total_variance) as an estimate: those of all components.
    #[must_use]
    pub fn total_degrees_of_freedom(&self) -> f64 {
        self.components * self.degrees_of_freedom
    }
}

/// The scalar products of the groups' differences from their mean.
struct Products {
    groups: usize,
    /// Of groups g and h at g · groups + h.
    values: Vec<f64>,
}

impl Products {
    fn of(means: &GroupMeans) -> Self {
        let (groups, statistics) = (means.groups(), means.statistics());
        let centred = means.centred();
        let row = |g: usize| &centred[g * statistics..][..statistics];
        let mut values = vec![0.0; groups * groups];
        for g in 0..groups {
            for h in 0..=g {
                let product = row(g).iter().zip(row(h)).map(|(x, y)| x * y).sum();
                values[g * groups + h] = product;
                values[h * groups + g] = product;
            }
        }
        Self { groups, values }
    }

    fn at(&self, g: usize, h: usize) -> f64 {
        self.values[g * self.groups + h]
    }

    /// m tr S, for the sample covariance S with m degrees of freedom.
    fn trace(&self) -> f64 {
        (0..self.groups).map(|g| self.at(g, g)).sum()
    }

    /// The products that are left without group `left_out`, whose share in the mean goes too.
    fn without(&self, left_out: usize) -> Self {
        let share = 1.0 / (self.groups - 1) as f64;
        let kept = || (0..self.groups).filter(|&g| g != left_out);
        let product = |g: usize, h: usize| {
            let linear = self.at(g, left_out) + self.at(h, left_out);
            self.at(g, h) + share * (linear + share * self.at(left_out, left_out))
        };
        Self {
            groups: self.groups - 1,
            values: kept().flat_map(|g| kept().map(move |h| product(g, h))).collect(),
        }
    }

    /// An estimate of 1/ν = tr Σ² / (tr Σ)², of three groups or more. tr S² overstates tr Σ²: for normal groups
    /// E tr S² = (1 + 1/m) tr Σ² + (tr Σ)²/m and E (tr S)² = (tr Σ)² + (2/m) tr Σ². Both are solved for. Not positive
    /// where the sample is more even than any.
    fn concentration(&self) -> f64 {
        let m = (self.groups - 1) as f64;
        let trace = self.trace();
        if trace <= 0.0 {
            return 1.0;
        }
        // Relative to the trace first, so that nothing over- or underflows.
        let of_sample: f64 = self.values.iter().map(|p| (p / trace) * (p / trace)).sum();
        let trace_of_square = m * m / ((m + 2.0) * (m - 1.0)) * (of_sample - 1.0 / m);
        trace_of_square / (1.0 - 2.0 / m * trace_of_square)
    }

    /// The estimate of 1/ν, not below zero, and [`CAUTION`] standard errors more, by the jackknife over the groups.
    fn careful_concentration(&self) -> f64 {
        if self.groups < FEWEST_GROUPS {
            return 1.0;
        }
        let count = self.groups as f64;
        let left: Vec<f64> = (0..self.groups).map(|g| self.without(g).concentration()).collect();
        let mean = left.iter().sum::<f64>() / count;
        let scatter: f64 = left.iter().map(|c| (c - mean) * (c - mean)).sum();
        self.concentration().max(0.0) + CAUTION * (scatter * (count - 1.0) / count).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::synthetic::Source;
    use crate::stats::z_test::Estimate;

    fn draw(source: &mut Source, groups: usize, variances: &[f64]) -> GroupMeans {
        let values = (0..groups).flat_map(|_| source.normals(variances)).collect();
        GroupMeans::new(groups, variances.len(), values).expect("a table")
    }

    /// Over 2000 tables each, the mean of the total variance is right, and so is the mean of the trace of the squared
    /// covariance, at a significance of 1 in 1000. Smallest visible bias at a power of 0.95: 2 and 5 %.
    #[test]
    fn traces_are_estimated_without_bias() {
        let mut source = Source::new(11);
        let variances: Vec<f64> = (0..24).map(|i| libm::pow(0.8, f64::from(i))).collect();
        let total: f64 = variances.iter().sum();
        let squares: f64 = variances.iter().map(|v| v * v).sum();
        let (mut totals, mut of_squares) = (Vec::new(), Vec::new());
        for _ in 0..2000 {
            let means = draw(&mut source, 16, &variances);
            let spread = Spread::of(&means).expect("groups");
            totals.push(spread.total_variance);
            let concentration = Products::of(&means).concentration();
            // The numerator alone, since a ratio of estimates has a bias of its own.
            let squared = spread.total_variance * spread.total_variance;
            of_squares.push(squared * concentration / (1.0 + 2.0 / 15.0 * concentration));
        }
        for (samples, expected, sees) in [(totals, total, 0.02), (of_squares, squares, 0.05)] {
            let test = Estimate::of(&samples).against(expected);
            assert!(test.passes(1e-3, 2), "{test:?}");
            let visible = test.smallest_visible_bias(1e-3, 2, 0.95) / expected;
            assert!(visible < sees, "sees {visible}");
        }
    }

    #[test]
    fn leaving_a_group_out_is_as_if_it_had_never_been() {
        let mut source = Source::new(12);
        let all = draw(&mut source, 5, &[1.0, 2.0, 3.0]);
        let rows: Vec<&[f64]> = [0, 1, 3, 4].map(|g| all.row(g)).to_vec();
        let fewer = Products::of(&GroupMeans::from_rows(&rows).expect("a table"));
        let left = Products::of(&all).without(2);
        assert_eq!(left.groups, 4);
        for (a, b) in left.values.iter().zip(&fewer.values) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn components_are_told_apart_at_any_scale() {
        for scale in [1e-70, 1.0, 1e70] {
            let mut source = Source::new(13);
            let components = |source: &mut Source, variances: &[f64]| {
                let variances: Vec<f64> = variances.iter().map(|v| v * scale * scale).collect();
                Spread::of(&draw(source, 16, &variances)).expect("groups").components
            };
            let independent = components(&mut source, &[1.0; 192]);
            assert!((120.0..=192.0).contains(&independent), "{independent}");
            let mut one_and_many = [0.001; 192];
            one_and_many[7] = 1.0;
            let dominated = components(&mut source, &one_and_many);
            assert!((1.0..2.5).contains(&dominated), "{dominated}");
            assert_eq!(components(&mut source, &[1.0]), 1.0);
        }
    }

    #[test]
    fn little_to_go_by_gives_the_careful_answer() {
        let spread = |rows: &[[f64; 3]]| Spread::of(&GroupMeans::from_rows(rows).expect("a table"));
        assert_eq!(spread(&[[1.0, 2.0, 3.0]]), None);
        let three = [[1.0, 5.0, 2.0], [3.0, 1.0, 0.0], [2.0, 2.0, 9.0]];
        assert_eq!(
            spread(&three[..2]).map(|s| (s.components, s.degrees_of_freedom)),
            Some((1.0, 1.0))
        );
        assert_eq!(spread(&three).map(|s| s.components), Some(1.0));
        let equal = spread(&[[4.0, 0.0, 1.0]; 16]).expect("groups");
        assert_eq!((equal.total_variance, equal.components), (0.0, 0.0));
    }
}
