//! The tests of the transition density itself: proposals weighted by 1/T spread as known draws do.

use super::coordinates::digests;
use super::family::{Cells, NOWHERE, Side};
use super::replicas::{BATCH, Replicas, Subject};
use super::report::TestKind;
use super::sheet::{Sheet, Sums};

fn sheets(subject: &Subject, kind: TestKind) -> impl Iterator<Item = Sheet> {
    let families = &subject.families;
    (0..families.len())
        .filter(move |&family| kind != TestKind::Uniform || families[family].is_uniform)
        .map(move |family| Sheet::of_cells(kind, 1, family, families))
}

/// One in so many replicas is a pilot: only the cells of its known draw are counted. Pilots are independent of all that is
/// tested, so cells can be chosen by them.
pub(super) const PILOTS: u32 = 8;

/// Region: from the same state, a proposal y of the mutation with the weight r = q/T, and a draw z of the region. For every
/// cell h, E[r h(y)] = ∫ q h = E[h(z)]; over all cells E[r] = 1.
pub(super) fn run_region<'a>(pair: &mut (Replicas<'a>, Replicas<'a>), first: u32, batches: u32) -> Sums {
    let (mutation, region) = (&mut pair.0, &mut pair.1);
    let mut sums = Sums {
        sheets: sheets(mutation.subject, TestKind::Density).collect(),
        ..Sums::default()
    };
    let number = mutation.subject.number as u32;
    let (mut proposed, mut drawn) = (Cells::default(), Cells::default());
    for first in (0..batches).map(|batch| first + batch * BATCH) {
        let weights = mutation.draw(first, BATCH);
        region.draw(first, BATCH);
        for replicas in [&mut *mutation, &mut *region] {
            replicas.take();
            replicas.step(0);
        }
        mutation.look(&mut proposed, Side::Proposed);
        region.look(&mut drawn, Side::Proposed);
        let (chosen, densities) = (mutation.chosen(), mutation.log_densities());
        let known = mutation.support_log_densities();
        for chain in (0..weights.len()).filter(|&c| weights[c] > 0.0 && chosen[c] == number) {
            let replica = first + chain as u32;
            if replica.is_multiple_of(PILOTS) {
                for sheet in &mut sums.sheets {
                    sheet.add_pilot(drawn.of(sheet.family)[chain]);
                }
                continue;
            }
            sums.replicas += 1;
            if !densities[chain].is_finite() {
                sums.note_stray(replica);
                continue;
            }
            let ratio = libm::exp(known[chain] - densities[chain]);
            for sheet in &mut sums.sheets {
                let (y, z) = (proposed.of(sheet.family)[chain], drawn.of(sheet.family)[chain]);
                if y == z {
                    sheet.add(y, ratio - 1.0, replica);
                } else {
                    sheet.add(y, ratio, replica);
                    sheet.add(z, -1.0, replica);
                }
                sheet.add_beside(z, 1.0);
            }
        }
    }
    sums
}

/// The whole space: E[h(y)/T] = E[h(x₀)] over bootstraps' samples x₀; and where coordinates are uniform, 1/T of the
/// proposals is shared equally by the cells of a grid over them.
pub(super) fn run_space(replicas: &mut Replicas<'_>, first: u32, batches: u32) -> Sums {
    let subject = replicas.subject;
    let mut sums = Sums {
        sheets: sheets(subject, TestKind::Density)
            .chain(sheets(subject, TestKind::Uniform))
            .collect(),
        ..Sums::default()
    };
    let (mut proposed, mut sampled) = (Cells::default(), Cells::default());
    for first in (0..batches).map(|batch| first + batch * BATCH) {
        replicas.draw(first, BATCH);
        replicas.look(&mut sampled, Side::Proposed);
        replicas.take();
        replicas.step(0);
        replicas.look(&mut proposed, Side::Proposed);
        let (chosen, densities) = (replicas.chosen(), replicas.log_densities());
        for chain in (0..chosen.len()).filter(|&c| chosen[c] as usize == subject.number) {
            let replica = first + chain as u32;
            sums.replicas += 1;
            if !densities[chain].is_finite() {
                sums.note_stray(replica);
                continue;
            }
            let ratio = libm::exp(-densities[chain]);
            for sheet in &mut sums.sheets {
                let (y, x) = (proposed.of(sheet.family)[chain], sampled.of(sheet.family)[chain]);
                if sheet.kind == TestKind::Uniform {
                    add_uniform(sheet, y, ratio, replica);
                    continue;
                }
                if y == x {
                    sheet.add(y, ratio - 1.0, replica);
                } else {
                    sheet.add(y, ratio, replica);
                    sheet.add(x, -1.0, replica);
                }
                sheet.add_beside(x, 1.0);
            }
        }
    }
    sums
}

/// Adds r (1 − 1/n) to the cell that the proposal is in, of n, and −r/n to the others.
fn add_uniform(sheet: &mut Sheet, y: u8, ratio: f64, replica: u32) {
    if y == NOWHERE {
        return;
    }
    let share = 1.0 / sheet.cells as f64;
    for cell in 0..sheet.cells as u8 {
        let inside = if cell == y { 1.0 } else { 0.0 };
        sheet.add(cell, ratio * (inside - share), replica);
        sheet.add_beside(cell, ratio * share);
    }
}

/// A point mass: counts the proposals that are not the state itself. Those of other mutations are passed over.
pub(super) fn run_state(replicas: &mut Replicas<'_>, first: u32, batches: u32) -> Sums {
    let subject = replicas.subject;
    let mut sums = Sums::default();
    for first in (0..batches).map(|batch| first + batch * BATCH) {
        let weights = replicas.draw(first, BATCH);
        replicas.take();
        let before = states(replicas, Side::Current);
        replicas.step(0);
        let after = states(replicas, Side::Proposed);
        let chosen = replicas.chosen();
        for chain in (0..weights.len()).filter(|&c| weights[c] > 0.0 && chosen[c] as usize == subject.number) {
            sums.replicas += 1;
            if before[chain] != after[chain] {
                sums.note_stray(first + chain as u32);
            }
        }
    }
    sums
}

/// What tells states apart: the target's bits, and a digest of the coordinates.
fn states(replicas: &mut Replicas<'_>, side: Side) -> Vec<(u32, u64)> {
    let targets = replicas.targets(side);
    let digests = digests(&mut replicas.world, side, targets.len());
    targets.into_iter().map(f32::to_bits).zip(digests).collect()
}
