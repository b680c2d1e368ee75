//! The tests that chains keep what they sample: target and flow.

use super::family::{Cell, Cells, Side};
use super::replicas::{Replicas, Subject};
use super::report::TestKind;
use super::sheet::{Sheet, Sums};

/// The sheets of the tests after each of `steps`, for all families but the one of a single cell.
fn sheets(subject: &Subject, steps: &[u64]) -> Vec<Sheet> {
    let families = &subject.families;
    let last = steps.last().copied().unwrap_or(1);
    let mut sheets = Vec::new();
    for family in 1..families.len() {
        let of_cells = |kind, steps| Sheet::of_cells(kind, steps, family, families);
        sheets.extend(steps.iter().map(|&steps| of_cells(TestKind::Target, steps)));
        sheets.push(of_cells(TestKind::Decided, last));
        sheets.push(Sheet::of_pairs(TestKind::Flow, family, families));
    }
    sheets
}

/// Runs batches of replicas, from `first` on, and sums up what tests need. `steps` are the numbers of steps after which
/// states are looked at, in ascending order.
pub(super) fn run(replicas: &mut Replicas<'_>, first: u32, batches: u32, steps: &[u64]) -> Sums {
    let mut sums = Sums {
        sheets: sheets(replicas.subject, steps),
        ..Sums::default()
    };
    (0..batches).for_each(|batch| run_batch(replicas, first + batch * super::replicas::BATCH, steps, &mut sums));
    sums
}

fn run_batch(replicas: &mut Replicas<'_>, first: u32, steps: &[u64], sums: &mut Sums) {
    let number = replicas.subject.number as u32;
    let weights = replicas.draw(first, super::replicas::BATCH);
    replicas.take();
    sums.replicas += weights.len() as u64;
    sums.heaviest = weights.iter().copied().fold(sums.heaviest, f64::max);
    sums.lit += weights.iter().filter(|&&w| w > 0.0).count() as u64;
    let (mut start, mut before, mut proposed) = (Cells::default(), Cells::default(), Cells::default());
    replicas.look(&mut start, Side::Current);
    let last = steps.last().copied().unwrap_or(0);
    for step in 1..=last {
        let looked_at = steps.contains(&step);
        if looked_at {
            replicas.look(&mut before, Side::Current);
        }
        replicas.step(step - 1);
        if !looked_at {
            continue;
        }
        let (acceptances, accepted) = (replicas.acceptances(), replicas.accepted());
        replicas.look(&mut proposed, Side::Proposed);
        if step == 1 {
            let chosen = replicas.chosen();
            let ours = (weights.iter().zip(&chosen).zip(&acceptances))
                .filter(|((weight, chosen), _)| **weight > 0.0 && **chosen == number);
            for (_, &acceptance) in ours {
                sums.proposed += 1;
                sums.failed += u64::from(acceptance == 0.0);
            }
        }
        for sheet in sums.sheets.iter_mut().filter(|sheet| sheet.steps == step) {
            let (start, before, proposed) = (
                start.of(sheet.family),
                before.of(sheet.family),
                proposed.of(sheet.family),
            );
            let replica = |chain: usize| Replica {
                chain: first + chain as u32,
                weight: weights[chain],
                acceptance: acceptances[chain],
                accepted: accepted[chain],
                start: start[chain],
                before: before[chain],
                proposed: proposed[chain],
            };
            let lit = (0..weights.len()).filter(|&chain| weights[chain] > 0.0).map(replica);
            match sheet.kind {
                TestKind::Target => lit.for_each(|replica| replica.add_target(sheet)),
                TestKind::Flow => lit.for_each(|replica| replica.add_flow(sheet)),
                TestKind::Decided => lit.for_each(|replica| replica.add_decision(sheet)),
                _ => {}
            }
        }
    }
}

/// What a test sees of one replica.
struct Replica {
    chain: u32,
    weight: f64,
    /// a of the last step.
    acceptance: f64,
    /// Whether its proposal was taken.
    accepted: bool,
    start: Cell,
    /// Before the last step.
    before: Cell,
    /// The last step's proposal.
    proposed: Cell,
}

impl Replica {
    /// Adds w ((1 − a) h(x_{K−1}) + a h(y) − h(x₀)) for the indicators h of all cells. Terms that cancel are left out, so
    /// that a replica which changes nothing adds nothing, not even rounding.
    fn add_target(&self, sheet: &mut Sheet) {
        let taken = self.weight * self.acceptance;
        let kept = self.weight * (1.0 - self.acceptance);
        let mut changes = [(self.start, 0.0), (self.before, 0.0), (self.proposed, 0.0)];
        if self.before == self.proposed {
            if self.start != self.before {
                (changes[0].1, changes[1].1) = (-self.weight, self.weight);
            }
        } else if self.start == self.before {
            (changes[0].1, changes[2].1) = (-taken, taken);
        } else if self.start == self.proposed {
            (changes[0].1, changes[1].1) = (-kept, kept);
        } else {
            (changes[0].1, changes[1].1, changes[2].1) = (-self.weight, kept, taken);
        }
        sheet.add_beside(self.start, self.weight);
        for (cell, change) in changes {
            sheet.add(cell, change, self.chain);
        }
    }

    /// Adds w a from the start's cell to the proposal's.
    fn add_flow(&self, sheet: &mut Sheet) {
        sheet.add_flow(self.start, self.proposed, self.weight * self.acceptance, self.chain);
    }

    /// Adds whether the proposal was taken, less the probability of that. Given both states it is a toss of a coin, so no
    /// weight is needed.
    fn add_decision(&self, sheet: &mut Sheet) {
        sheet.add_coin(self.proposed, self.accepted, self.acceptance, self.chain);
        sheet.add_beside(self.proposed, self.acceptance);
    }
}
