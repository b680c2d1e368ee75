//! Sheets: the sums of one test over the cells, or pairs of cells, of one family.

use super::family::{Cell, Family, NOWHERE};
use super::report::TestKind;
use super::tally::Tally;

/// The sums of one test over one family.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub(super) kind: TestKind,
    /// Steps after which it was taken.
    pub(super) steps: u64,
    pub(super) family: usize,
    /// Cells of the family.
    pub(super) cells: usize,
    /// By cell, or by pair of cells: the first times their number, plus the second, which is larger.
    pub(super) rows: Vec<Tally>,
    /// What a row's mean is small or large beside, summed over replicas.
    pub(super) beside: Vec<f64>,
    /// By cell, known draws among replicas that are counted here and in no sum: they say what can be judged.
    pub(super) pilots: Vec<u64>,
}

impl Sheet {
    /// An empty sheet for the cells of family number `family`.
    pub(super) fn of_cells(kind: TestKind, steps: u64, family: usize, families: &[Family]) -> Self {
        let cells = families[family].cells.len();
        Self {
            kind,
            steps,
            family,
            cells,
            rows: vec![Tally::default(); cells],
            beside: vec![0.0; cells],
            pilots: vec![0; cells],
        }
    }

    /// An empty sheet for pairs of cells of family number `family`.
    pub(super) fn of_pairs(kind: TestKind, family: usize, families: &[Family]) -> Self {
        let cells = families[family].cells.len();
        Self {
            kind,
            steps: 1,
            family,
            cells,
            rows: vec![Tally::default(); cells * cells],
            beside: Vec::new(),
            pilots: Vec::new(),
        }
    }

    /// Adds `value` in a cell.
    #[inline]
    pub(super) fn add(&mut self, cell: Cell, value: f64, chain: u32) {
        if cell != NOWHERE && value != 0.0 {
            self.rows[usize::from(cell)].add(value, chain);
        }
    }

    /// Adds a coin's outcome, see [`Tally::add_coin`].
    #[inline]
    pub(super) fn add_coin(&mut self, cell: Cell, heads: bool, a: f64, chain: u32) {
        if cell != NOWHERE {
            self.rows[usize::from(cell)].add_coin(heads, a, chain);
        }
    }

    /// Adds to what the cell's mean is beside.
    #[inline]
    pub(super) fn add_beside(&mut self, cell: Cell, value: f64) {
        if cell != NOWHERE {
            self.beside[usize::from(cell)] += value;
        }
    }

    /// Counts a known draw that is in no sum.
    #[inline]
    pub(super) fn add_pilot(&mut self, cell: Cell) {
        if cell != NOWHERE {
            self.pilots[usize::from(cell)] += 1;
        }
    }

    /// Adds a flow of `value` from one cell to another.
    #[inline]
    pub(super) fn add_flow(&mut self, from: Cell, to: Cell, value: f64, chain: u32) {
        if from == to || from == NOWHERE || to == NOWHERE || value == 0.0 {
            return;
        }
        let (from, to) = (usize::from(from), usize::from(to));
        if from < to {
            self.rows[from * self.cells + to].add(value, chain);
        } else {
            self.rows[to * self.cells + from].add(-value, chain);
        }
    }

    /// Adds the sums of other replicas.
    pub(super) fn merge(&mut self, other: &Self) {
        self.rows.iter_mut().zip(&other.rows).for_each(|(a, b)| a.merge(b));
        self.beside.iter_mut().zip(&other.beside).for_each(|(a, b)| *a += b);
        self.pilots.iter_mut().zip(&other.pilots).for_each(|(a, b)| *a += b);
    }
}

/// What a chunk of replicas came to.
#[derive(Clone, Debug, Default)]
pub(super) struct Sums {
    pub(super) sheets: Vec<Sheet>,
    /// Replicas.
    pub(super) replicas: u64,
    /// Those with light.
    pub(super) lit: u64,
    /// The largest weight of a replica.
    pub(super) heaviest: f64,
    /// First proposals of the mutation from states with light.
    pub(super) proposed: u64,
    /// Those that could not have been taken.
    pub(super) failed: u64,
    /// Proposals that are where they cannot be: not the state itself, or where T is zero or no number.
    pub(super) strays: u64,
    /// The first replica with one.
    pub(super) first_stray: Option<u32>,
}

impl Sums {
    /// The sum over chunks, in their order.
    pub(super) fn of(chunks: Vec<Self>) -> Self {
        let mut chunks = chunks.into_iter();
        let mut sum = chunks.next().unwrap_or_default();
        for chunk in chunks {
            sum.sheets.iter_mut().zip(&chunk.sheets).for_each(|(a, b)| a.merge(b));
            sum.replicas += chunk.replicas;
            sum.lit += chunk.lit;
            sum.heaviest = sum.heaviest.max(chunk.heaviest);
            sum.proposed += chunk.proposed;
            sum.failed += chunk.failed;
            sum.strays += chunk.strays;
            sum.first_stray = sum.first_stray.or(chunk.first_stray);
        }
        sum
    }

    /// Counts a proposal that is where it cannot be.
    pub(super) fn note_stray(&mut self, chain: u32) {
        self.strays += 1;
        self.first_stray = self.first_stray.or(Some(chain));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flows_back_are_taken_from_flows_there() {
        let family = Family::new(vec![String::new(); 3], false, |_, _, _| {});
        let mut sheet = Sheet::of_pairs(TestKind::Flow, 0, &[family]);
        sheet.add_flow(0, 2, 1.0, 7);
        sheet.add_flow(2, 0, 0.25, 8);
        sheet.add_flow(1, 1, 9.0, 9);
        sheet.add_flow(NOWHERE, 1, 9.0, 9);
        let flows: Vec<f64> = sheet.rows.iter().map(|row| row.mean(2).mean).collect();
        assert_eq!(flows, [0.0, 0.0, 0.375, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    }
}
