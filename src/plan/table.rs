//! Tables as a plan lists them.

use crate::layer::{LayerTable, ProposedLayerTable};
use crate::path::*;
use crate::table::{Column, ColumnSpec, LANES, Table};
use bevy_ecs::component::ComponentId;
use bevy_ecs::world::{EntityWorldMut, World};
use std::fmt;

/// The chain table of an estimator whose every step is an independent sample of each chain's pixel.
pub(super) fn sampling_chains() -> TablePlan {
    let mut table = TablePlan::new(TableId::CHAINS, Extent::PerChain(1));
    table
        .column::<ChainKey>("draws are keyed by it")
        .column::<FilmPixel>("the pixel that a step's sample counts for")
        .column::<Contribution>("a step's sample")
        .column::<BookedWeight>("what the decision booked")
        .column::<Decisions>("every chain decides exactly once a step");
    table
}

/// A table by name: the marker that tells its rows from others. Two tables of one name are the same.
#[derive(Clone, Copy)]
pub struct TableId {
    name: &'static str,
    spawn: for<'w> fn(&'w mut World) -> EntityWorldMut<'w>,
    marker: fn(&World) -> Option<ComponentId>,
}

impl TableId {
    /// One entry per chain.
    pub const CHAINS: Self = Self::of::<ChainTable>("chains");
    /// One entry per vertex of a proposed path and chain, bounce-major.
    pub const PROPOSALS: Self = Self::of::<ProposalTable>("proposal vertices");
    /// Chains that wait to be scattered, by material model.
    pub const SCATTER: Self = Self::of::<ScatterTable>("scatter lists");
    /// One entry per ray or segment in flight.
    pub const RAYS: Self = Self::of::<RayTable>("rays");

    /// Primary coordinates of current states, by depth from 1 on.
    pub const PRIMARY: Self = Self::of::<PrimaryTable>("primary coordinates");
    /// Primary coordinates of proposals.
    pub const PROPOSED_PRIMARY: Self = Self::of::<ProposedPrimaryTable>("proposed coordinates");
    /// Splats of current states.
    pub const SPLATS: Self = Self::of::<SplatTable>("splats");
    /// Splats of proposals.
    pub const PROPOSED_SPLATS: Self = Self::of::<ProposedSplatTable>("proposed splats");

    /// What layers have of splats of current states.
    pub const LAYERS: Self = Self::of::<LayerTable>("layers");
    /// What layers have of splats of proposals.
    pub const PROPOSED_LAYERS: Self = Self::of::<ProposedLayerTable>("proposed layers");

    /// Vertices of current paths.
    pub const PATHS: Self = Self::of::<whole::PathTable>("paths");
    /// Vertices of proposed paths.
    pub const PROPOSED_PATHS: Self = Self::of::<whole::ProposedPathTable>("proposed paths");

    /// The table whose rows are marked with `Marker`.
    #[must_use]
    pub const fn of<Marker: Table>(name: &'static str) -> Self {
        Self {
            name,
            spawn: |world| world.spawn(Marker::default()),
            marker: |world| world.component_id::<Marker>(),
        }
    }

    /// The table's name as plans print it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// The component that marks its rows, once a world knows it.
    #[must_use]
    pub fn marker(self, world: &World) -> Option<ComponentId> {
        (self.marker)(world)
    }

    /// Spawns a row without columns.
    pub fn spawn(self, world: &mut World) -> EntityWorldMut<'_> {
        (self.spawn)(world)
    }
}

impl PartialEq for TableId {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for TableId {}

impl fmt::Debug for TableId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// How many entries a table has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// So many per chain of the tile.
    PerChain(u32),
    /// One per chain and depth, from the depth `first` on. The table has room for some depths when it is built, and rows
    /// are appended for deeper ones when a path first gets there: bounce-major addresses stay what they are.
    PerDepth {
        /// The first depth that has an entry.
        first: u32,
        /// The last depth that there is room for at first.
        held: u32,
        /// The last depth that there can ever be.
        most: u32,
    },
    /// One lane group, whatever the tile.
    OneGroup,
}

/// The depth that tables have room for at first: beyond it, few paths go.
const FIRST_ROOM: u32 = 8;

impl Extent {
    /// One entry per path vertex, the lens included.
    #[must_use]
    pub fn vertices(max_depth: u32) -> Self {
        Self::from_depth(0, max_depth)
    }

    /// One entry per depth in `first..=most`.
    #[must_use]
    pub fn from_depth(first: u32, most: u32) -> Self {
        Self::PerDepth {
            first,
            held: most.min(FIRST_ROOM).max(first),
            most: most.max(first),
        }
    }

    /// Entries per chain when the tile is built.
    #[must_use]
    pub const fn entries(self) -> u32 {
        match self {
            Self::PerChain(entries) => entries,
            Self::PerDepth { first, held, .. } => held + 1 - first,
            Self::OneGroup => 0,
        }
    }

    /// The most entries per chain that there can be.
    #[must_use]
    pub const fn most_entries(self) -> u32 {
        match self {
            Self::PerDepth { first, most, .. } => most + 1 - first,
            other => other.entries(),
        }
    }
}

/// A table of a plan.
#[derive(Clone, Debug)]
pub struct TablePlan {
    /// Which.
    pub id: TableId,
    /// Its entries, relative to the tile.
    pub extent: Extent,
    /// Whether it holds something from one step to the next, and so is saved with its tile.
    pub is_state: bool,
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
    /// A table without columns, which nothing outlives a step in.
    #[must_use]
    pub const fn new(id: TableId, extent: Extent) -> Self {
        Self {
            id,
            extent,
            is_state: false,
            rows: 0,
            columns: Vec::new(),
        }
    }

    /// The same table, holding state from one step to the next.
    #[must_use]
    pub fn holding_state(self) -> Self {
        Self { is_state: true, ..self }
    }

    /// Adds column `C`, unless the table has it.
    pub fn column<C: Column>(&mut self, reason: &'static str) -> &mut Self {
        let spec = ColumnSpec::of::<C>();
        if !self.has::<C>() {
            self.columns.push(ColumnPlan { spec, reason });
        }
        self
    }

    /// Whether the table has column `C`.
    #[must_use]
    pub fn has<C: Column>(&self) -> bool {
        self.columns
            .iter()
            .any(|column| (column.spec.type_name)() == std::any::type_name::<C>())
    }

    /// Fixes the number of rows for a tile of so many subpaths.
    pub(super) fn fit(&mut self, subpaths: u32) {
        let groups = subpaths / LANES as u32;
        self.rows = match self.extent {
            Extent::OneGroup => 1,
            extent => extent.entries() * groups,
        };
    }

    /// Bytes of one entry over all columns.
    #[must_use]
    pub fn entry_bytes(&self) -> usize {
        self.columns.iter().map(|column| column.spec.bytes).sum()
    }

    /// Bytes of the whole table as it is built.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.entry_bytes() as u64 * u64::from(self.rows) * LANES as u64
    }

    /// Bytes of the whole table when it has grown as far as it can.
    #[must_use]
    pub fn most_bytes(&self) -> u64 {
        let entries = u64::from(self.extent.entries().max(1));
        self.bytes() / entries * u64::from(self.extent.most_entries().max(1))
    }
}
