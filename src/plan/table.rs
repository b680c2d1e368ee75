//! Tables as a plan lists them.

use crate::path::{BookedWeight, ChainKey, Contribution, Decisions, FilmPixel};
use crate::table::{Column, ColumnSpec, LANES};
use std::fmt;

/// The chain table of an estimator whose every step is an independent sample of each chain's pixel.
pub(super) fn sampling_chains() -> TablePlan {
    let mut table = TablePlan::new(TableKind::Chains, Extent::PerChain(1));
    table
        .column::<ChainKey>("draws are keyed by it")
        .column::<FilmPixel>("the pixel that a step's sample counts for")
        .column::<Contribution>("a step's sample")
        .column::<BookedWeight>("what the decision booked")
        .column::<Decisions>("every chain decides exactly once a step");
    table
}

/// The tables of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableKind {
    /// One entry per chain.
    Chains,
    /// One entry per vertex of a proposed path and chain, bounce-major.
    Proposals,
    /// One entry per ray or segment in flight.
    Rays,
}

impl TableKind {
    /// The table's name as plans print it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Chains => "chains",
            Self::Proposals => "proposal vertices",
            Self::Rays => "rays",
        }
    }
}

/// How many entries a table has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// So many per chain of the tile.
    PerChain(u32),
    /// One lane group, whatever the tile.
    OneGroup,
}

/// A table of a plan.
#[derive(Clone, Debug)]
pub struct TablePlan {
    /// Which.
    pub kind: TableKind,
    /// Its entries, relative to the tile.
    pub extent: Extent,
    /// Lane-group rows; 0 until the tile's size is known.
    pub rows: u32,
    /// Its columns.
    pub columns: Vec<ColumnPlan>,
}

/// A column of a plan.
#[derive(Clone)]
pub struct ColumnPlan {
    /// Which column, and how it is spawned.
    pub spec: ColumnSpec,
    /// Why it is there.
    pub reason: &'static str,
}

impl fmt::Debug for ColumnPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({} B): {}", self.spec.name, self.spec.bytes, self.reason)
    }
}

impl TablePlan {
    pub(super) const fn new(kind: TableKind, extent: Extent) -> Self {
        Self {
            kind,
            extent,
            rows: 0,
            columns: Vec::new(),
        }
    }

    /// Adds column `C`.
    pub(super) fn column<C: Column>(&mut self, reason: &'static str) -> &mut Self {
        self.columns.push(ColumnPlan {
            spec: ColumnSpec::of::<C>(),
            reason,
        });
        self
    }

    /// Fixes the number of rows for a tile of `chains` chains.
    pub(super) fn fit(&mut self, chains: u32) {
        let groups = chains / LANES as u32;
        self.rows = match self.extent {
            Extent::PerChain(entries) => entries * groups,
            Extent::OneGroup => 1,
        };
    }

    /// Bytes of one entry over all columns.
    #[must_use]
    pub fn entry_bytes(&self) -> usize {
        self.columns.iter().map(|column| column.spec.bytes).sum()
    }

    /// Bytes of the whole table.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.entry_bytes() as u64 * u64::from(self.rows) * LANES as u64
    }
}
