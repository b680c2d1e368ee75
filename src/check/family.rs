//! Families of test functions: the indicators of the cells of one partition of states.

use super::{coordinates, path_families};
use crate::chain::{Class, ProposedClass, ProposedTarget, Signature, StateClass, Target};
use crate::film::BlockGrid;
use crate::path::ChainTable;
use crate::plan::TilePlan;
use crate::render::TileWorld;
use crate::scene::Scene;

/// Which of the two states that a decision is between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Current,
    Proposed,
}

/// A state's cell in a partition; [`NOWHERE`] where it has none.
pub(super) type Cell = u8;
/// No cell: the partition says nothing of such states.
pub(super) const NOWHERE: Cell = Cell::MAX;

/// Lengths that are told apart; longer ones are in the last cell.
const LENGTHS: usize = 16;
/// Octaves of f that are told apart, from 2^[`FIRST_OCTAVE`] up.
const OCTAVES: usize = 28;
const FIRST_OCTAVE: i32 = -20;

type Look = Box<dyn Fn(&mut TileWorld, Side, &mut [Cell]) + Send + Sync>;

/// A partition of states.
pub(super) struct Family {
    /// What its cells are called.
    pub(super) cells: Vec<String>,
    /// Whether independent samples are equally likely in all cells, given that they are in one.
    pub(super) is_uniform: bool,
    look: Look,
}

impl Family {
    pub(super) fn new(
        cells: Vec<String>,
        is_uniform: bool,
        look: impl Fn(&mut TileWorld, Side, &mut [Cell]) + Send + Sync + 'static,
    ) -> Self {
        Self {
            cells,
            is_uniform,
            look: Box::new(look),
        }
    }

    /// Writes the cell of every chain's state.
    pub(super) fn look(&self, world: &mut TileWorld, side: Side, cells: &mut [Cell]) {
        (self.look)(world, side, cells);
    }
}

/// The families that states of a plan have. The first has one cell, which all states are in.
pub(super) fn families(plan: &TilePlan, blocks: &BlockGrid, scene: &Scene) -> Vec<Family> {
    let mut families = vec![
        Family::new(vec!["all states".to_owned()], false, |_, _, cells| cells.fill(0)),
        by_class((0..blocks.blocks()).map(|b| blocks.name(b)).collect(), |class| {
            class.block() as usize
        }),
        by_class(lengths("length"), |class| class.length_class()),
        by_class(
            (0..StateClass::SIGNATURES)
                .map(|n| format!("signature {}", Signature::of_number(n).name()))
                .collect(),
            |class| class.signature().number(),
        ),
        octaves(),
    ];
    families.extend(coordinates::families(plan));
    families.extend(path_families::families(plan, scene));
    families
}

/// Names of cells by a length.
pub(super) fn lengths(what: &str) -> Vec<String> {
    (0..LENGTHS)
        .map(|length| {
            let more = if length + 1 == LENGTHS { " or more" } else { "" };
            format!("{what} {length}{more}")
        })
        .collect()
}

/// The cell number `index` of `count`, the last one for all beyond.
pub(super) fn cell(index: usize, count: usize) -> Cell {
    index.min(count.saturating_sub(1)).min(usize::from(NOWHERE) - 1) as Cell
}

fn by_class(cells: Vec<String>, number: fn(StateClass) -> usize) -> Family {
    let count = cells.len();
    Family::new(cells, false, move |world, side, cells| {
        let mut classes = vec![0; cells.len()];
        match side {
            Side::Current => world.read::<Class, ChainTable>(&mut classes),
            Side::Proposed => world.read::<ProposedClass, ChainTable>(&mut classes),
        }
        for (to, class) in cells.iter_mut().zip(classes) {
            *to = cell(number(StateClass(class)), count);
        }
    })
}

/// Octaves of the target: any mutation that favours bright or dark states shows here.
fn octaves() -> Family {
    let name = |octave: usize| {
        format!(
            "f in [2^{0}, 2^{1})",
            octave as i32 + FIRST_OCTAVE,
            octave as i32 + FIRST_OCTAVE + 1
        )
    };
    Family::new((0..OCTAVES).map(name).collect(), false, |world, side, cells| {
        let mut targets = vec![0.0; cells.len()];
        match side {
            Side::Current => world.read::<Target, ChainTable>(&mut targets),
            Side::Proposed => world.read::<ProposedTarget, ChainTable>(&mut targets),
        }
        for (to, target) in cells.iter_mut().zip(targets) {
            *to = if target > 0.0 && target.is_finite() {
                let exponent = (target.to_bits() >> 23) as i32 - 127;
                cell((exponent - FIRST_OCTAVE).max(0) as usize, OCTAVES)
            } else {
                NOWHERE
            };
        }
    })
}

/// The cells of many chains' states, family by family.
#[derive(Clone, Default)]
pub(super) struct Cells {
    rows: Vec<Vec<Cell>>,
}

impl Cells {
    /// Looks at the first `chains` chains.
    pub(super) fn look(&mut self, families: &[Family], world: &mut TileWorld, side: Side, chains: usize) {
        self.rows.resize_with(families.len(), Vec::new);
        for (row, family) in self.rows.iter_mut().zip(families) {
            row.resize(chains, NOWHERE);
            family.look(world, side, row);
        }
    }

    /// The cells in one family.
    pub(super) fn of(&self, family: usize) -> &[Cell] {
        &self.rows[family]
    }
}
