//! Comparisons of runs.

use chainlight::stats::comparison;
use chainlight::stats::normal::{sidak, upper_quantile};
use chainlight::stats::student::t_quantile;
use chainlight::stats::z_test::Estimate;

/// The probability that any test of a family fails when nothing is wrong.
pub const ALPHA: f64 = 0.01;
/// The probability with which the smallest visible bias is found.
const POWER: f64 = 0.95;
const CHANNELS: usize = 3;

/// Block means (number block · 3 + channel) of independent runs.
#[derive(Clone, Debug)]
pub struct BlockMeans {
    /// Run by run.
    pub rows: Vec<Vec<f64>>,
}

impl BlockMeans {
    /// The same of pictures brighter by a factor: a planted error.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |row: &Vec<f64>| row.iter().map(|mean| mean * factor).collect();
        Self {
            rows: self.rows.iter().map(scaled).collect(),
        }
    }

    /// Estimates over runs: of each channel's mean over the counted blocks, then of every counted block and channel.
    fn estimates(&self, counted: &[bool]) -> Vec<Estimate> {
        let blocks = || (0..counted.len()).filter(|&block| counted[block]);
        let number = blocks().count() as f64;
        let mean = |row: &Vec<f64>, channel: usize| {
            blocks().map(|block| row[block * CHANNELS + channel]).sum::<f64>() / number
        };
        let over_runs =
            |statistic: &dyn Fn(&Vec<f64>) -> f64| Estimate::of(&self.rows.iter().map(statistic).collect::<Vec<f64>>());
        let means = (0..CHANNELS).map(|channel| over_runs(&|row| mean(row, channel)));
        let single = blocks().flat_map(|block| (0..CHANNELS).map(move |channel| block * CHANNELS + channel));
        means.chain(single.map(|i| over_runs(&|row| row[i]))).collect()
    }
}

/// The number of statistics that two sets of runs are compared in.
#[must_use]
pub fn statistics(counted: &[bool]) -> usize {
    CHANNELS * (1 + counted.iter().filter(|&&counted| counted).count())
}

/// What came of comparing two sets of runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Statistics compared.
    pub statistics: usize,
    /// Those that differ significantly.
    pub failures: usize,
    /// The largest |t|.
    pub largest: f64,
    /// The two estimates that differ by it.
    pub worst: [Estimate; 2],
    /// Its block; none for a mean over blocks.
    pub block: Option<usize>,
    /// The smallest relative bias of the mean over all counted blocks that would be found, in the channel where it is largest.
    pub visible: f64,
}

/// Compares the counted blocks of two sets of runs, as part of a family of `tests` tests.
#[must_use]
pub fn compare(a: &BlockMeans, b: &BlockMeans, counted: &[bool], tests: usize) -> Verdict {
    let freedom = [a, b].map(|means| means.rows.len() as f64 - 1.0);
    let (a, b) = (a.estimates(counted), b.estimates(counted));
    let compared: Vec<_> = a
        .iter()
        .zip(&b)
        .map(|(&a, &b)| comparison::compare(a, b, freedom))
        .collect();
    let visible = compared.iter().zip(&b).take(CHANNELS).map(|(test, b)| {
        let threshold = t_quantile(1.0 - 0.5 * sidak(ALPHA, tests), test.degrees_of_freedom);
        test.error * (threshold + upper_quantile(1.0 - POWER)) / b.mean
    });
    let size = |i: &usize| compared[*i].t.abs();
    let worst = (0..compared.len())
        .max_by(|a, b| size(a).total_cmp(&size(b)))
        .unwrap_or_default();
    let mut blocks = (0..counted.len()).filter(|&block| counted[block]);
    Verdict {
        statistics: compared.len(),
        failures: compared.iter().filter(|test| !test.passes(ALPHA, tests)).count(),
        largest: size(&worst),
        worst: [a[worst], b[worst]],
        block: (worst / CHANNELS).checked_sub(1).and_then(|number| blocks.nth(number)),
        visible: visible.fold(0.0, f64::max),
    }
}
