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
use serde::{Deserialize, Serialize};

/// The variances of a part of a picture whose blocks are independent of each other, as those of a path-traced picture are.
#[derive(Clone, Debug, PartialEq)]
pub struct IndependentBlocks {
    /// The variances of means, block by block; none is negative.
    pub variances: Vec<f64>,
    /// Channels of a block, which may be correlated.
    pub channels: usize,
    /// Degrees of freedom of each block's variances as an estimate.
    pub degrees_of_freedom: f64,
}

/// The root-mean-square error of a picture's statistics, in their units (or as a fraction, see
/// [`relative_to`](Self::relative_to)).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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

    /// The error of the sum of two parts that are independent of each other: the mean over the groups, and one of as many
    /// statistics with these variances. `None` for fewer than two groups.
    ///
    /// With the covariances Σ of the first part's mean and D of the second, the sum is distributed over
    /// (tr Σ + tr D)² / tr (Σ + D)² components, and the degrees of freedom of its estimated variance follow from those of both
    /// (Satterthwaite 1946). Correlations of channels are not known: they are taken to be as large as they can be.
    #[must_use]
    pub fn of_parts(means: &GroupMeans, blocks: &IndependentBlocks) -> Option<Self> {
        let spread = Spread::of(means)?;
        let statistics = means.statistics();
        let known: f64 = blocks.variances.iter().take(statistics).sum();
        if known <= 0.0 {
            return Self::of(means);
        }
        let estimated = spread.total_variance / means.groups() as f64;
        let total = estimated + known;
        // Relative to the sum first, so that nothing over- or underflows.
        let (mut squares, mut of_estimate) = (0.0, 0.0);
        if estimated > 0.0 {
            squares = (estimated / total) * (estimated / total) / spread.components;
            of_estimate = squares / spread.degrees_of_freedom;
        }
        let channels = blocks.channels.max(1);
        for (block, variances) in blocks.variances[..statistics.min(blocks.variances.len())]
            .chunks(channels)
            .enumerate()
        {
            let (mut own, mut both) = (0.0, 0.0);
            for (channel, variance) in variances.iter().enumerate() {
                let share = variance / total;
                own += share;
                let error = means.estimate(block * channels + channel).error;
                both += (error * error / total * share).sqrt();
            }
            squares += own * own + 2.0 * both * both;
            of_estimate += own * own / blocks.degrees_of_freedom;
        }
        Some(Self::new(
            total / statistics as f64,
            (1.0 / squares).clamp(1.0, statistics as f64),
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
        let known = |variances: [f64; 2], channels| IndependentBlocks {
            variances: variances.to_vec(),
            channels,
            degrees_of_freedom: f64::INFINITY,
        };
        let means = GroupMeans::from_rows(&[[1.0, 4.0], [2.0, 5.0], [4.0, 3.0], [1.5, 4.5]]).expect("a table");
        let one = PictureError::of(&means).expect("groups");
        // Nothing added is nothing changed, and nothing estimated leaves what is known.
        assert_eq!(PictureError::of_parts(&means, &known([0.0, 0.0], 1)), Some(one));
        let even = GroupMeans::from_rows(&[[1.0, 4.0]; 4]).expect("a table");
        let apart = PictureError::of_parts(&even, &known([0.01, 0.03], 1)).expect("groups");
        let alone = PictureError::of_independent(&[0.01, 0.03]);
        for (a, b) in [
            (apart.rms, alone.rms),
            (apart.components, alone.components),
            (apart.interval[0], alone.interval[0]),
            (apart.upper, alone.upper),
        ] {
            assert!((a / b - 1.0).abs() < 1e-12, "{apart:?} {alone:?}");
        }
        let both = PictureError::of_parts(&means, &known([0.01, 0.03], 1)).expect("groups");
        assert!((both.rms * both.rms - one.rms * one.rms - alone.rms * alone.rms).abs() < 1e-12);
        assert!(both.components >= 1.0 && both.components <= 2.0);
        let wholly_correlated = PictureError::of_parts(&even, &known([0.01, 0.03], 2)).expect("groups");
        assert!((wholly_correlated.components - 1.0).abs() < 1e-12);
        assert!((wholly_correlated.rms - alone.rms).abs() < 1e-12);
        let single = GroupMeans::from_rows(&[[1.0]]).expect("a table");
        assert_eq!(PictureError::of_parts(&single, &known([0.01, 0.0], 1)), None);
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
