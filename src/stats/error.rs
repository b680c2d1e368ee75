//! The error of a picture: how far its blocks are from the truth in the root mean square, with bounds.
//!
//! The error that one picture happens to have is Q = (1/n) Σ (x̄ᵢ − μᵢ)², over its n statistics. It is a random number,
//! and its expectation is only estimated, so the bounds are those of a **prediction**: with tr S the spread of G
//! groups, Q over its estimate tr S / (G n) is a ratio of two independent mean squares of ν components each, one over
//! G − 1 degrees of freedom. It follows the F distribution with ν and ν (G − 1) degrees of freedom, exactly where the
//! components are equal and the groups normal, and closely otherwise (`coverage` holds how closely).

#[cfg(test)]
mod coverage;

use super::components::Spread;
use super::fisher::f_quantile;
use super::group_means::GroupMeans;
use serde::Serialize;

/// The root-mean-square error of a picture's statistics, in their units (or as a fraction, see
/// [`relative_to`](Self::relative_to)).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PictureError {
    /// The estimate: the root of the expected mean-square error.
    pub rms: f64,
    /// Where the error that this picture has lies with probability 0.95, from the smallest to the largest.
    pub interval: [f64; 2],
    /// What the error that this picture has is below with probability 0.95.
    pub upper: f64,
    /// Over how many equal, independent components the error is distributed. One: the whole picture is too bright or too
    /// dark together, and the interval is wide. Zero where there is no error at all.
    pub components: f64,
}

impl PictureError {
    /// The error of the mean over the groups; `None` for fewer than two groups. Zero where the groups agree to the last
    /// bit, as in a picture that all of them leave black: what every group misses shows in no spread.
    #[must_use]
    pub fn of(means: &GroupMeans) -> Option<Self> {
        let spread = Spread::of(means)?;
        Some(Self::new(
            spread.total_variance / means.groups() as f64 / means.statistics() as f64,
            spread.components,
            spread.total_degrees_of_freedom(),
        ))
    }

    /// The error of means whose errors are independent of each other and whose variances are well known, as pixels or
    /// blocks of a path-traced picture with many samples each. No variance is negative. Zero for no means.
    #[must_use]
    pub fn of_independent(variances_of_means: &[f64]) -> Self {
        let total: f64 = variances_of_means.iter().sum();
        if total <= 0.0 {
            return Self::new(0.0, 0.0, f64::INFINITY);
        }
        let concentration: f64 = variances_of_means.iter().map(|v| (v / total) * (v / total)).sum();
        Self::new(
            total / variances_of_means.len() as f64,
            1.0 / concentration,
            f64::INFINITY,
        )
    }

    /// The error of the sum of two parts that are independent of each other: the mean over the groups, and one whose statistics are
    /// independent of each other and have these well-known variances, none negative and one for each statistic of the groups.
    /// `None` for fewer than two groups.
    ///
    /// With the covariances Σ of the first part's mean and diagonal D of the second's, the sum is distributed over
    /// (tr Σ + tr D)² / tr (Σ + D)² components, and the part of its variance that is estimated has the degrees of freedom of the
    /// first (Satterthwaite 1946).
    #[must_use]
    pub fn of_parts(means: &GroupMeans, variances: &[f64]) -> Option<Self> {
        let spread = Spread::of(means)?;
        let (groups, statistics) = (means.groups() as f64, means.statistics() as f64);
        let known: f64 = variances.iter().sum();
        if known <= 0.0 {
            return Self::of(means);
        }
        let estimated = spread.total_variance / groups;
        let total = estimated + known;
        // Relative to the sum first, so that nothing over- or underflows.
        let estimated_share = estimated / total;
        let (mut squares, mut of_estimate) = (0.0, 0.0);
        if estimated > 0.0 {
            squares = estimated_share * estimated_share / spread.components;
            of_estimate = squares / spread.degrees_of_freedom;
        }
        for (statistic, variance) in variances.iter().take(means.statistics()).enumerate() {
            let share = variance / total;
            let error = means.estimate(statistic).error;
            squares += share * (2.0 * (error * error / total) + share);
        }
        Some(Self::new(
            total / statistics,
            (1.0 / squares).clamp(1.0, statistics),
            1.0 / of_estimate,
        ))
    }

    /// From the expected mean-square error, its components, and the degrees of freedom of that estimate.
    fn new(mean_square: f64, components: f64, degrees_of_freedom: f64) -> Self {
        let rms = mean_square.sqrt();
        let bound = |p: f64| {
            if components > 0.0 {
                rms * f_quantile(p, components, degrees_of_freedom).sqrt()
            } else {
                rms
            }
        };
        Self {
            rms,
            interval: [bound(0.025), bound(0.975)],
            upper: bound(0.95),
            components,
        }
    }

    /// The error as a fraction of `mean`, as a rule the mean of the statistics. `None` where the mean is zero or not a
    /// finite number.
    #[must_use]
    pub fn relative_to(&self, mean: f64) -> Option<Self> {
        let mean = mean.abs();
        (mean > 0.0 && mean.is_finite()).then(|| Self {
            rms: self.rms / mean,
            interval: self.interval.map(|bound| bound / mean),
            upper: self.upper / mean,
            components: self.components,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::student::t_quantile;

    #[test]
    fn one_statistic_gives_students_interval() {
        // Of one number the error is below t standard errors: 95 % of the time for the two-sided t.
        let samples = [1.0, 2.0, 3.0, 4.0];
        let means = GroupMeans::from_rows(&samples.map(|x| [x])).expect("a table");
        let error = PictureError::of(&means).expect("groups");
        assert!((error.rms - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
        assert!((error.upper - error.rms * t_quantile(0.975, 3.0)).abs() < 1e-12);
        let [low, high] = error.interval;
        assert!((low - error.rms * t_quantile(0.5125, 3.0)).abs() < 1e-12);
        assert!((high - error.rms * t_quantile(0.9875, 3.0)).abs() < 1e-12);
    }

    #[test]
    fn a_fraction_of_the_mean_has_the_same_shape() {
        let means = GroupMeans::from_rows(&[[1.0, 4.0], [2.0, 5.0], [4.0, 3.0]]).expect("a table");
        let error = PictureError::of(&means).expect("groups");
        let relative = error.relative_to(-2.0).expect("a mean");
        assert_eq!((relative.rms, relative.upper), (error.rms / 2.0, error.upper / 2.0));
        assert_eq!(relative.interval, [error.interval[0] / 2.0, error.interval[1] / 2.0]);
        assert_eq!(relative.components, error.components);
        assert!(
            [0.0, f64::NAN, f64::INFINITY]
                .iter()
                .all(|&m| error.relative_to(m).is_none())
        );
    }

    #[test]
    fn without_spread_there_is_no_error_and_without_groups_no_answer() {
        let black = PictureError::of(&GroupMeans::from_rows(&[[0.0; 3]; 16]).expect("a table"));
        let zero = PictureError {
            rms: 0.0,
            interval: [0.0, 0.0],
            upper: 0.0,
            components: 0.0,
        };
        assert_eq!(black, Some(zero));
        assert_eq!(PictureError::of_independent(&[0.0, 0.0]), zero);
        assert_eq!(PictureError::of_independent(&[]), zero);
        assert_eq!(
            PictureError::of(&GroupMeans::from_rows(&[[1.0]]).expect("a table")),
            None
        );
    }

    #[test]
    fn parts_add_up() {
        let means = GroupMeans::from_rows(&[[1.0, 4.0], [2.0, 5.0], [4.0, 3.0], [1.5, 4.5]]).expect("a table");
        let one = PictureError::of(&means).expect("groups");
        // Nothing added is nothing changed, and nothing estimated leaves what is known.
        assert_eq!(PictureError::of_parts(&means, &[0.0, 0.0]), Some(one));
        let even = GroupMeans::from_rows(&[[1.0, 4.0]; 4]).expect("a table");
        let known = PictureError::of_parts(&even, &[0.01, 0.03]).expect("groups");
        let alone = PictureError::of_independent(&[0.01, 0.03]);
        for (a, b) in [
            (known.rms, alone.rms),
            (known.components, alone.components),
            (known.interval[0], alone.interval[0]),
            (known.upper, alone.upper),
        ] {
            assert!((a / b - 1.0).abs() < 1e-12, "{known:?} {alone:?}");
        }
        let both = PictureError::of_parts(&means, &[0.01, 0.03]).expect("groups");
        assert!((both.rms * both.rms - one.rms * one.rms - alone.rms * alone.rms).abs() < 1e-12);
        assert!(both.components >= 1.0 && both.components <= 2.0);
        let single = GroupMeans::from_rows(&[[1.0]]).expect("a table");
        assert_eq!(PictureError::of_parts(&single, &[0.01]), None);
    }

    #[test]
    fn known_variances_count_their_components() {
        let even = PictureError::of_independent(&[0.04; 100]);
        assert!((even.rms - 0.2).abs() < 1e-15 && (even.components - 100.0).abs() < 1e-9);
        // Chi-square of 100 degrees of freedom over 100: 0.7422, 1.2956 and, for the bound above, 1.2434.
        assert!((even.interval[0] / even.rms - 0.742_219_f64.sqrt()).abs() < 1e-5);
        assert!((even.interval[1] / even.rms - 1.295_612_f64.sqrt()).abs() < 1e-5);
        assert!((even.upper / even.rms - 1.243_421_f64.sqrt()).abs() < 1e-5);
        let mut uneven = [0.0; 100];
        (uneven[3], uneven[50]) = (1.0, 1.0);
        assert!((PictureError::of_independent(&uneven).components - 2.0).abs() < 1e-12);
    }
}
