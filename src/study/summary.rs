//! What the runs of one way to render have to say.
//!
//! Quantiles over runs make no assumption on how errors are distributed: a few of them decide the mean where samples are seldom and
//! bright.

use super::estimates::{Interval, bounds_of_median, mean, median, quantile, ratio_of_logs};
use super::study_file::{Errors, RunRecord, Snapshot};
use super::{ReferenceRecord, SceneStudy, WayStudy};
use serde::Serialize;

/// How many times the reference's own error an error must be to be told from it.
const ABOVE_REFERENCE: f64 = 3.0;
/// The errors of which it is told when they are reached.
const TARGETS: [f64; 3] = [1e-1, 1e-2, 1e-3];

/// A kind of error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Measure {
    /// Mean squared error.
    Mse,
    /// Relative mean squared error.
    RelMse,
    /// The same without the worst 0.1 % of pixels.
    RelMseTrimmed,
    /// Symmetric mean absolute relative error.
    Smape,
    /// Mean of ꟻLIP.
    Flip,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Mse, Self::RelMse, Self::RelMseTrimmed, Self::Smape, Self::Flip];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mse => "MSE",
            Self::RelMse => "relMSE",
            Self::RelMseTrimmed => "relMSE without the worst 0.1 %",
            Self::Smape => "SMAPE",
            Self::Flip => "FLIP",
        }
    }

    /// Its name in files' names.
    #[must_use]
    pub const fn file_name(self) -> &'static str {
        match self {
            Self::Mse => "mse",
            Self::RelMse => "relmse",
            Self::RelMseTrimmed => "relmse-trimmed",
            Self::Smape => "smape",
            Self::Flip => "flip",
        }
    }

    const fn of(self, errors: &Errors) -> f64 {
        match self {
            Self::Mse => errors.mse,
            Self::RelMse => errors.rel_mse,
            Self::RelMseTrimmed => errors.rel_mse_trimmed,
            Self::Smape => errors.smape,
            Self::Flip => errors.flip,
        }
    }

    /// What the reference's own error adds to it; 0 where that is not known. An upper bound of trimmed errors; of others it is not known.
    fn of_reference(self, reference: &ReferenceRecord) -> f64 {
        let own = match self {
            Self::Mse => reference.own_mse,
            Self::RelMse | Self::RelMseTrimmed => reference.own_rel_mse,
            Self::Smape | Self::Flip => None,
        };
        own.unwrap_or(0.0)
    }
}

/// Errors of all runs at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    /// When the picture was due, in seconds.
    pub due: f64,
    /// When it was looked at, in the median.
    pub seconds: f64,
    /// Samples, or mutations, per pixel, in the median.
    pub per_pixel: f64,
    /// The 10 %, 50 % and 90 % quantiles of the error.
    pub quantiles: [f64; 3],
    /// Runs.
    pub runs: usize,
    /// Whether the error is so near to the reference's own that nothing can be said of it: the curve ends before.
    pub is_reference: bool,
}

/// The time to an error, over runs. Runs that take longer than they were given count as endless.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TimeTo {
    /// The error.
    pub error: f64,
    /// Seconds in the median over runs, with its interval; infinite, and so absent in JSON, where most runs do not get there.
    pub seconds: Interval,
    /// Runs that get there.
    pub reached: usize,
    /// Whether the median is but an upper bound: the first picture was that good.
    pub at_most: bool,
}

/// What the runs of one way to render a scene have to say, of one measure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The way's name.
    pub way: String,
    /// The measure.
    pub measure: Measure,
    /// Errors against time.
    pub points: Vec<Point>,
    /// Times to errors.
    pub times: Vec<TimeTo>,
    /// d ln error / d ln time over the curve's second half, which bootstraps do not bend: −1 for squared errors of independent samples.
    pub slope: Option<Interval>,
    /// How much more efficient it is than the study's first way: the ratio of 1 / (error × time) at the end.
    pub efficiency: Option<Interval>,
    /// The relative squared bias at the end, from pairs of runs, less the reference's own error.
    pub squared_bias: Option<Interval>,
}

impl Summary {
    /// Where the curve ends: the last look that can be told from the reference, or the last of all where none can.
    #[must_use]
    pub fn end(&self) -> Option<&Point> {
        let told = self.points.iter().rfind(|point| !point.is_reference);
        told.or(self.points.last())
    }

    /// What the runs of `way` in `scene` have to say.
    #[must_use]
    pub fn of(scene: &SceneStudy, way: &WayStudy, measure: Measure) -> Self {
        let own = measure.of_reference(&scene.reference);
        let points = points(&way.runs, measure, own);
        let last = |way: &WayStudy| logs_of_work(way, measure, own);
        let efficiency = scene.ways.first().and_then(|first| {
            if first.name == way.name {
                return None;
            }
            ratio_of_logs(&last(first), &last(way))
        });
        let own_rel = scene.reference.own_rel_mse.unwrap_or(0.0);
        let shared: Vec<f64> = way
            .runs
            .iter()
            .filter_map(|run| run.snapshots.last()?.shared)
            .map(|shared| shared - own_rel)
            .collect();
        Self {
            way: way.name.clone(),
            measure,
            times: TARGETS
                .iter()
                .filter_map(|&error| time_to(&way.runs, measure, own, error))
                .collect(),
            slope: slope(&way.runs, measure, own),
            points,
            efficiency,
            squared_bias: mean(&shared),
        }
    }
}

/// An error less what the reference adds to it; not below a share of that.
fn error_of(snapshot: &Snapshot, measure: Measure, own: f64) -> f64 {
    (measure.of(&snapshot.errors) - own).max(own / ABOVE_REFERENCE)
}

/// Whether an error can be told from the reference's own.
fn is_told(snapshot: &Snapshot, measure: Measure, own: f64) -> bool {
    let error = measure.of(&snapshot.errors);
    error > 0.0 && error >= ABOVE_REFERENCE * own
}

fn points(runs: &[RunRecord], measure: Measure, own: f64) -> Vec<Point> {
    let mut due: Vec<f64> = runs.iter().flat_map(|run| &run.snapshots).map(|s| s.due).collect();
    due.sort_by(f64::total_cmp);
    due.dedup();
    due.into_iter()
        .map(|due| {
            let here = || runs.iter().flat_map(|run| &run.snapshots).filter(|s| s.due == due);
            let sorted = |value: &dyn Fn(&Snapshot) -> f64| {
                let mut values: Vec<f64> = here().map(value).collect();
                values.sort_by(f64::total_cmp);
                values
            };
            let errors = sorted(&|s| error_of(s, measure, own));
            let told = here().filter(|s| is_told(s, measure, own)).count();
            Point {
                due,
                seconds: quantile(&sorted(&|s| s.seconds), 0.5),
                per_pixel: quantile(&sorted(&|s| s.per_pixel), 0.5),
                quantiles: [0.1, 0.5, 0.9].map(|p| quantile(&errors, p)),
                runs: errors.len(),
                is_reference: 2 * told < errors.len(),
            }
        })
        .collect()
}

/// When a run's error falls below `error`, on straight lines between its looks in logarithms; whether it was before the first. `None`
/// for one that never does.
fn reached(run: &RunRecord, measure: Measure, own: f64, error: f64) -> Option<(f64, bool)> {
    let at = |s: &Snapshot| error_of(s, measure, own);
    let first = run.snapshots.iter().position(|s| at(s) <= error)?;
    let there = &run.snapshots[first];
    let Some(before) = first.checked_sub(1).map(|i| &run.snapshots[i]) else {
        return Some((there.seconds, true));
    };
    let (high, low) = (libm::log(at(before)), libm::log(at(there)));
    let share = (high - libm::log(error)) / (high - low);
    let (from, to) = (libm::log(before.seconds), libm::log(there.seconds));
    Some((libm::exp(from + share * (to - from)), false))
}

fn time_to(runs: &[RunRecord], measure: Measure, own: f64, error: f64) -> Option<TimeTo> {
    if runs.is_empty() || error <= ABOVE_REFERENCE * own {
        return None;
    }
    let found: Vec<Option<(f64, bool)>> = runs.iter().map(|run| reached(run, measure, own, error)).collect();
    let mut times: Vec<f64> = found
        .iter()
        .map(|found| found.map_or(f64::INFINITY, |(t, _)| t))
        .collect();
    times.sort_by(f64::total_cmp);
    let value = median(&times);
    Some(TimeTo {
        error,
        seconds: Interval {
            value,
            bounds: bounds_of_median(&times),
        },
        reached: found.iter().flatten().count(),
        at_most: found.iter().flatten().any(|&(time, first)| first && time >= value),
    })
}

/// ln (error × time) of every run's end.
fn logs_of_work(way: &WayStudy, measure: Measure, own: f64) -> Vec<f64> {
    way.runs
        .iter()
        .filter_map(|run| run.snapshots.last())
        .filter(|s| is_told(s, measure, own))
        .map(|s| libm::log(error_of(s, measure, own) * s.seconds))
        .collect()
}

/// The mean over runs of the slope of a line through the second half of their looks, in logarithms.
fn slope(runs: &[RunRecord], measure: Measure, own: f64) -> Option<Interval> {
    let of_run = |run: &RunRecord| {
        let told: Vec<[f64; 2]> = run
            .snapshots
            .iter()
            .filter(|s| is_told(s, measure, own))
            .map(|s| [libm::log(s.seconds), libm::log(error_of(s, measure, own))])
            .collect();
        let half = &told[told.len() / 2..];
        if half.len() < 2 {
            return None;
        }
        let n = half.len() as f64;
        let [x, y] = [0, 1].map(|i: usize| half.iter().map(|p| p[i]).sum::<f64>() / n);
        let across: f64 = half.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
        let along: f64 = half.iter().map(|p| (p[0] - x) * (p[0] - x)).sum();
        (along > 0.0).then(|| across / along)
    };
    mean(&runs.iter().filter_map(of_run).collect::<Vec<f64>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::BANDS;

    fn snapshot(seconds: f64, rel_mse: f64) -> Snapshot {
        Snapshot {
            due: seconds,
            seconds,
            steps: 1,
            per_pixel: 8.0 * seconds,
            errors: Errors {
                mse: 2.0 * rel_mse,
                rel_mse,
                rel_mse_trimmed: 0.5 * rel_mse,
                smape: rel_mse.sqrt(),
                flip: 0.1,
                mean_ratio: Some(1.0),
            },
            shared: Some(0.01),
            stated: None,
            spectrum: [1.0; BANDS],
        }
    }

    /// Runs whose error is `factor` / t, a little other in each.
    fn way(name: &str, factor: f64) -> WayStudy {
        let run = |seed: u64| RunRecord {
            seed,
            start_seconds: 0.1,
            snapshots: [0.5, 1.0, 2.0, 4.0, 8.0]
                .map(|t| snapshot(t, factor * (0.9 + 0.025 * seed as f64) / t))
                .into(),
            stages: Vec::new(),
        };
        WayStudy {
            name: name.to_owned(),
            technique: name.to_owned(),
            settings: String::new(),
            runs: (0..9).map(run).collect(),
            layers: None,
        }
    }

    fn scene(own: Option<f64>) -> SceneStudy {
        SceneStudy {
            name: "box".to_owned(),
            file: "box.ron".to_owned(),
            size: (8, 8),
            reference: ReferenceRecord {
                file: "r.exr".to_owned(),
                made_by: None,
                own_mse: own.map(|own| 2.0 * own),
                own_rel_mse: own,
                mean: 1.0,
            },
            ways: vec![way("slow", 0.4), way("fast", 0.1)],
        }
    }

    #[test]
    fn errors_that_fall_with_time_are_told_as_they_are() {
        let scene = scene(None);
        let summary = Summary::of(&scene, &scene.ways[1], Measure::RelMse);
        let last = summary.points[4];
        assert_eq!(
            (summary.points.len(), last.due, last.runs, last.per_pixel),
            (5, 8.0, 9, 64.0)
        );
        assert!((last.quantiles[1] - 0.0125).abs() < 1e-9 && !last.is_reference);
        assert!(last.quantiles[0] < last.quantiles[1] && last.quantiles[1] < last.quantiles[2]);
        let slope = summary.slope.expect("a slope");
        assert!((slope.value + 1.0).abs() < 1e-9, "{slope:?}");
        let efficiency = summary.efficiency.expect("two ways");
        assert!((efficiency.value - 4.0).abs() < 1e-9 && efficiency.bounds[0] < 4.0 && efficiency.bounds[1] > 4.0);
        assert_eq!(Summary::of(&scene, &scene.ways[0], Measure::RelMse).efficiency, None);
        // Of nothing that one knows of the reference's error, all that pairs share is bias.
        assert!((summary.squared_bias.expect("pairs").value - 0.01).abs() < 1e-12);
    }

    #[test]
    fn times_to_errors_are_between_looks_and_endless_beyond_them() {
        let scene = scene(None);
        let summary = Summary::of(&scene, &scene.ways[1], Measure::RelMse);
        let [tenth, hundredth, thousandth] = summary.times[..] else {
            panic!("{:?}", summary.times)
        };
        // 0.1 / t is 0.1 after one second.
        assert!(
            (tenth.seconds.value - 1.0).abs() < 1e-9 && tenth.reached == 9 && !tenth.at_most,
            "{tenth:?}"
        );
        assert!(tenth.seconds.bounds[0] < 1.0 && tenth.seconds.bounds[1] > 1.0);
        assert_eq!((hundredth.reached, thousandth.reached), (0, 0));
        assert_eq!(hundredth.seconds.value, f64::INFINITY);
        let trimmed = Summary::of(&scene, &scene.ways[1], Measure::RelMseTrimmed);
        // Half of it: the first look was that good in most runs.
        assert!(
            trimmed.times[0].at_most && trimmed.times[0].seconds.value == 0.5,
            "{:?}",
            trimmed.times[0]
        );
    }

    #[test]
    fn curves_end_where_the_reference_is_no_better() {
        let scene = scene(Some(0.008));
        let summary = Summary::of(&scene, &scene.ways[1], Measure::RelMse);
        let ended: Vec<bool> = summary.points.iter().map(|point| point.is_reference).collect();
        // 0.2, 0.1, 0.05, 0.025 and 0.0125, of which 0.024 is three times the reference's own.
        assert_eq!(ended, [false, false, false, false, true]);
        // What the reference errs itself is taken off.
        assert!((summary.points[0].quantiles[1] - 0.192).abs() < 1e-9);
        assert!((summary.squared_bias.expect("pairs").value - 0.002).abs() < 1e-12);
        // An error that the reference cannot show is never told to be reached.
        assert_eq!(summary.times.len(), 1);
    }
}
