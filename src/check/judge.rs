//! Verdicts: all tests of a check share one significance.

use super::density::PILOTS;
use super::family::Family;
use super::report::{TestKind, TestOutcome};
use super::sheet::{Sheet, Sums};
use super::tally::{Mean, Tally};
use crate::stats::normal::two_sided_p;
use crate::stats::z_test::{smallest_visible_bias, z_threshold};

/// Equal values that a test must be worth to be judged: below, means are no normal variables.
const LEAST_EFFECTIVE: f64 = 100.0;
/// How many times the largest value the spread of a sum must be for its test to be judged: where a few values could be most of
/// the sum, samples without them look as if nothing could be.
const LEAST_SPREAD: f64 = 4.0;
/// Known draws that a cell of a region must hold for its test to be judged, times the bound on E[r⁴] of the weights. The mean
/// of n values has 1/n of their excess kurtosis: 4 % at most of what r⁴ can make it.
const LEAST_KNOWN: f64 = 25.0;
/// The probability with which the smallest visible bias is found.
const POWER: f64 = 0.95;

/// Sums of one run, and what they are sums of.
pub(super) struct Judged<'a> {
    pub(super) run: &'a str,
    pub(super) families: &'a [Family],
    pub(super) sums: &'a Sums,
    /// A bound on the fourth moment of the weights, where they are those of proposals in a region.
    pub(super) fourth_moment: Option<f64>,
}

/// A test before its verdict.
struct Candidate {
    kind: TestKind,
    run: usize,
    steps: u64,
    name: String,
    mean: Mean,
    beside: f64,
    /// The replica that deviates most in the direction of the mean.
    extreme: u32,
}

/// A test with the run that it is of and the replica that shows it best.
pub(super) struct Verdict {
    pub(super) outcome: TestOutcome,
    pub(super) run: usize,
    pub(super) chain: u32,
}

/// Tests that were not judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Unjudged {
    /// Those that too few replicas had anything to do with.
    pub(super) rare: usize,
    /// Those of cells of a region in which too few known draws are for their sums to be normal.
    pub(super) of_region: usize,
}

/// Judges all tests of all runs, and counts those that cannot be judged.
pub(super) fn judge(runs: &[Judged<'_>], significance: f64) -> (Vec<Verdict>, Unjudged) {
    let mut candidates = Vec::new();
    let mut unjudged = Unjudged::default();
    for (number, run) in runs.iter().enumerate() {
        for sheet in &run.sums.sheets {
            let mut sheet = Reader {
                sheet,
                run: number,
                family: &run.families[sheet.family],
                replicas: run.sums.replicas,
                heaviest: run.sums.heaviest,
                fourth_moment: run.fourth_moment,
                candidates: &mut candidates,
                unjudged: &mut unjudged,
            };
            if sheet.sheet.kind == TestKind::Flow {
                sheet.read_pairs();
            } else {
                sheet.read_cells();
            }
        }
    }
    let tests = candidates.len();
    let verdict = |candidate: Candidate| {
        let mean = candidate.mean;
        let z = if candidate.kind == TestKind::Decided {
            mean.z_of_known_error()
        } else {
            mean.z()
        };
        let outcome = TestOutcome {
            kind: candidate.kind,
            run: runs[candidate.run].run.to_owned(),
            steps: candidate.steps,
            name: candidate.name,
            mean: mean.mean,
            error: mean.error,
            z,
            p: two_sided_p(z),
            bias: mean.mean / candidate.beside,
            sees: smallest_visible_bias(mean.error, significance, tests, POWER) / candidate.beside,
            passed: z.abs() <= z_threshold(significance, tests),
            witness: None,
        };
        Verdict {
            outcome,
            run: candidate.run,
            chain: candidate.extreme,
        }
    };
    (candidates.into_iter().map(verdict).collect(), unjudged)
}

/// Reads the candidates off a sheet.
struct Reader<'a> {
    sheet: &'a Sheet,
    run: usize,
    family: &'a Family,
    replicas: u64,
    heaviest: f64,
    fourth_moment: Option<f64>,
    candidates: &'a mut Vec<Candidate>,
    unjudged: &'a mut Unjudged,
}

impl Reader<'_> {
    fn read_cells(&mut self) {
        for (cell, row) in self.sheet.rows.iter().enumerate() {
            let beside = self.sheet.beside[cell] / self.replicas.max(1) as f64;
            let mean = row.mean(self.replicas);
            if beside == 0.0 && mean.size == 0.0 {
                continue;
            }
            if let Some(moment) = self.fourth_moment {
                if !self.has_normal_sums(cell, moment) {
                    self.unjudged.of_region += 1;
                    continue;
                }
            } else if mean.size > 0.0 && !self.can_judge(row, &mean) {
                // Where nothing changed, nothing is out of balance.
                self.unjudged.rare += 1;
                continue;
            }
            self.push(
                row,
                mean,
                self.family.cells[cell].clone(),
                beside.max(f64::MIN_POSITIVE),
            );
        }
    }

    /// Pairs between which too little flows are judged as one. All pairs together say whether as much goes up the family's
    /// order as down: where cells are lengths or octaves, the test that sees most.
    fn read_pairs(&mut self) {
        let mut rare = Tally::default();
        let mut all = Tally::default();
        self.sheet.rows.iter().for_each(|row| all.merge(row));
        let mean = self.flow(&all);
        if self.can_judge(&all, &mean) {
            let (first, last) = (self.family.cells.first(), self.family.cells.last());
            let name = |cell: Option<&String>| cell.cloned().unwrap_or_default();
            let name = format!("{} ... {}, up and down", name(first), name(last));
            self.push(&all, mean, name, mean.size);
        }
        let mut rare_pairs = 0;
        for (pair, row) in self.sheet.rows.iter().enumerate() {
            let mean = self.flow(row);
            if mean.size == 0.0 {
                continue;
            }
            if !self.can_judge(row, &mean) {
                rare.merge(row);
                rare_pairs += 1;
                continue;
            }
            let (from, to) = (pair / self.sheet.cells, pair % self.sheet.cells);
            let name = format!("{} <-> {}", self.family.cells[from], self.family.cells[to]);
            self.push(row, mean, name, mean.size);
        }
        let mean = self.flow(&rare);
        if self.can_judge(&rare, &mean) {
            let name = format!("{rare_pairs} rarer pairs like {}, together", self.family.cells[0]);
            self.push(&rare, mean, name, mean.size);
        } else if rare_pairs > 0 {
            self.unjudged.rare += 1;
        }
    }

    /// The mean of a flow. There and back are alike when nothing is wrong, so it is not skewed, whatever the sample is.
    fn flow(&self, row: &Tally) -> Mean {
        Mean {
            skewness: 0.0,
            ..row.mean(self.replicas)
        }
    }

    /// Whether the mean can be taken as normal. What is seldom taken one way is taken at once the other, but proposed the more
    /// seldom: many small values on one side stand against a few on the other that are as large as the heaviest replica, whether
    /// one of them is among the sample or not.
    fn can_judge(&self, row: &Tally, mean: &Mean) -> bool {
        let seen = row.most.value.max(-row.least.value);
        let bound = match self.sheet.kind {
            TestKind::Target | TestKind::Flow => seen.max(self.heaviest),
            _ => seen,
        };
        let spread = mean.error * self.replicas as f64;
        mean.effective >= LEAST_EFFECTIVE && (spread == 0.0 || spread >= LEAST_SPREAD * bound)
    }

    /// Whether sums over a cell of weights r are near normal: by the bound on E[r⁴], and the known draws that pilots say are
    /// in the cell. Neither depends on what is tested.
    fn has_normal_sums(&self, cell: usize, fourth_moment: f64) -> bool {
        let expected = self.sheet.pilots[cell] as f64 * f64::from(PILOTS - 1);
        expected >= LEAST_KNOWN * fourth_moment
    }

    fn push(&mut self, row: &Tally, mean: Mean, name: String, beside: f64) {
        let extreme = if mean.mean > 0.0 { row.most } else { row.least };
        self.candidates.push(Candidate {
            kind: self.sheet.kind,
            run: self.run,
            steps: self.sheet.steps,
            name,
            mean,
            beside,
            extreme: extreme.chain,
        });
    }
}
