//! Do independent groups of chains find the same?
//!
//! Inside a group, batches of chains show how far means scatter when nothing is stuck. Groups whose means lie farther
//! apart than that have not mixed: a mode that some of them found is missing in others, or has the wrong weight. A mode
//! that **all** groups miss shows in no such comparison; see [`comparison`](super::comparison) for what can show it.

use super::fisher::f_upper_tail;
use super::normal::sidak;
use super::z_test::Estimate;
use serde::Serialize;

/// Differences of this many units of rounding of the largest value are none.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How far the groups' means of one statistic lie apart, against what the batches inside the groups let expect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// The variance of the groups' means over the one that the batches predict, which is the mean variance of a group's
    /// batches divided by their number. About one where nothing is wrong. Zero where all values are the same, infinite
    /// where batches show no spread and groups do.
    pub ratio: f64,
    /// The probability of a ratio at least this large when nothing is wrong: an F test, exact for normal batches.
    pub p: f64,
    /// The potential scale reduction R̂ (Gelman and Rubin 1992) with groups for chains and batches for draws:
    /// √((B − 1 + ratio) / B) with B batches. One where all values are the same.
    pub r_hat: f64,
}

impl Agreement {
    /// Of one statistic: `group_means` of G groups, and `batch_means` of the same number of equally large batches of
    /// chains in each, group-major. Batches of a group have to be independent of each other but for what they are
    /// tested on. `None` for fewer than two groups or batches, for unequal numbers of batches, and for values that are
    /// not finite.
    #[must_use]
    pub fn of(group_means: &[f64], batch_means: &[f64]) -> Option<Self> {
        let groups = group_means.len();
        if groups < 2 || batch_means.len() < 2 * groups || !batch_means.len().is_multiple_of(groups) {
            return None;
        }
        let all = || group_means.iter().chain(batch_means);
        if all().any(|value| !value.is_finite()) {
            return None;
        }
        let batches = batch_means.len() / groups;
        let rounding = ROUNDING * all().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        // The squared standard error of a mean of n values is their variance over n.
        let squared_error = |values: &[f64]| {
            let error = Estimate::of(values).error;
            if error <= rounding { 0.0 } else { error * error }
        };
        let between = squared_error(group_means) * groups as f64;
        let within = batch_means.chunks_exact(batches).map(squared_error).sum::<f64>() / groups as f64;
        let ratio = if between == 0.0 { 0.0 } else { between / within };
        let (above, below) = ((groups - 1) as f64, (groups * (batches - 1)) as f64);
        let b = batches as f64;
        Some(Self {
            ratio,
            p: f_upper_tail(ratio, above, below),
            r_hat: if between == 0.0 && within == 0.0 {
                1.0
            } else {
                ((b - 1.0 + ratio) / b).sqrt()
            },
        })
    }
}

/// A statistic in which the groups disagree.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Disagreement {
    /// Which statistic: the place of its agreement.
    pub statistic: usize,
    /// Its ratio of variances, see [`Agreement::ratio`].
    pub ratio: f64,
    /// Its probability when nothing is wrong, see [`Agreement::p`].
    pub p: f64,
}

/// The statistics in which the groups disagree, in order: none with probability 1 − `alpha` or more when nothing is wrong
/// (Sidak's correction for their number, which holds for statistics that vary together too).
#[must_use]
pub fn judge(agreements: &[Agreement], alpha: f64) -> Vec<Disagreement> {
    let significance = sidak(alpha, agreements.len());
    let disagreement = |(statistic, a): (usize, &Agreement)| {
        (a.p < significance).then_some(Disagreement {
            statistic,
            ratio: a.ratio,
            p: a.p,
        })
    };
    agreements.iter().enumerate().filter_map(disagreement).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::synthetic::Source;

    const GROUPS: usize = 16;
    const BATCHES: usize = 16;
    const STATISTICS: usize = 20;
    const ALPHA: f64 = 0.05;

    fn normal(source: &mut Source) -> f64 {
        source.normal()
    }

    /// Lognormal with σ = 1 (skewness 6): batches that now and then hold a chain stuck in a bright place.
    fn skewed(source: &mut Source) -> f64 {
        libm::exp(source.normal())
    }

    /// Of all statistics, with `shift` standard errors of a group's mean added to one group's batches of statistic 3.
    fn agreements(source: &mut Source, batch: fn(&mut Source) -> f64, shift: f64) -> Vec<Agreement> {
        let mut agreement = |statistic: usize| {
            let mut batches: Vec<f64> = (0..GROUPS * BATCHES).map(|_| batch(source)).collect();
            if statistic == 3 {
                let shift = shift / (BATCHES as f64).sqrt();
                batches[5 * BATCHES..6 * BATCHES].iter_mut().for_each(|b| *b += shift);
            }
            let mean = |group: &[f64]| group.iter().sum::<f64>() / group.len() as f64;
            let means: Vec<f64> = batches.chunks_exact(BATCHES).map(mean).collect();
            Agreement::of(&means, &batches).expect("groups and batches")
        };
        (0..STATISTICS).map(&mut agreement).collect()
    }

    /// Over 1000 families of 20 statistics, the share with a disagreement is the significance, give or take four standard
    /// errors of 0.007. A significance twice as large would show.
    #[test]
    fn groups_that_agree_are_called_apart_as_rarely_as_stated() {
        let mut source = Source::new(21);
        let alarms = (0..1000).filter(|_| !judge(&agreements(&mut source, normal, 0.0), ALPHA).is_empty());
        let share = alarms.count() as f64 / 1000.0;
        assert!((share - ALPHA).abs() < 0.028, "{share}");
    }

    /// Skewed batches raise no more alarms than normal ones: what a rare bright batch adds to its group's mean it adds to
    /// the variance inside the group too.
    #[test]
    fn skewed_batches_raise_no_more_alarms() {
        let mut source = Source::new(22);
        let alarms = (0..1000).filter(|_| !judge(&agreements(&mut source, skewed, 0.0), ALPHA).is_empty());
        let share = alarms.count() as f64 / 1000.0;
        assert!(share < ALPHA + 0.028, "{share}");
    }

    /// One group of sixteen that is off by eight of its standard errors is found in nine of ten cases or more.
    #[test]
    fn a_group_that_is_off_is_found_and_named() {
        let mut source = Source::new(23);
        let found = (0..300).filter(|_| {
            let disagreements = judge(&agreements(&mut source, normal, 8.0), ALPHA);
            disagreements.iter().any(|d| d.statistic == 3 && d.ratio > 2.0)
        });
        let share = found.count() as f64 / 300.0;
        assert!(share > 0.9, "{share}");
    }

    #[test]
    fn ratio_and_r_hat_are_as_computed_by_hand() {
        // Group means 2 and 6: variance 8. Batches 1, 3 and 4, 8: variances 2 and 8, mean 5, of two batches 2.5.
        let a = Agreement::of(&[2.0, 6.0], &[1.0, 3.0, 4.0, 8.0]).expect("groups and batches");
        assert!((a.ratio - 3.2).abs() < 1e-12);
        // The pooled variance (B−1)/B W + between over W, of which R̂ is the root: (2.5 + 8) / 5.
        assert!((a.r_hat - 2.1_f64.sqrt()).abs() < 1e-12);
        // The tail of F with 1 and 2 degrees of freedom: 1 − √(f / (f + 2)).
        assert!((a.p - (1.0 - (3.2_f64 / 5.2).sqrt())).abs() < 1e-12);
    }

    #[test]
    fn what_is_the_same_everywhere_agrees() {
        for value in [0.0, 0.1, 1e30, -7.3e-30] {
            let mean = (0..16).map(|_| value).sum::<f64>() / 16.0;
            let a = Agreement::of(&[mean; 16], &[value; 256]).expect("groups and batches");
            assert_eq!((a.ratio, a.p, a.r_hat), (0.0, 1.0, 1.0));
        }
        // Groups that each hold on to a value of their own do not.
        let stuck = Agreement::of(&[1.0, 2.0], &[1.0, 1.0, 2.0, 2.0]).expect("groups and batches");
        assert_eq!((stuck.ratio, stuck.p), (f64::INFINITY, 0.0));
        assert_eq!(judge(&[stuck], 1e-9)[0].statistic, 0);
        assert_eq!(judge(&[], 0.05), []);
    }

    #[test]
    fn too_little_to_compare_gives_no_answer() {
        assert_eq!(Agreement::of(&[1.0], &[1.0, 2.0]), None);
        assert_eq!(Agreement::of(&[1.0, 2.0], &[1.0, 2.0]), None);
        assert_eq!(Agreement::of(&[1.0, 2.0], &[1.0, 2.0, 3.0, 4.0, 5.0]), None);
        assert_eq!(Agreement::of(&[1.0, f64::NAN], &[1.0, 2.0, 3.0, 4.0]), None);
    }
}
