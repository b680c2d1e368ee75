//! A tile: its systems, its tables, and its size, as many chains as keep the tables that a step touches inside a core's
//! cache.

use super::system::SystemPlan;
use super::table::{Extent, TableId, TablePlan};
use crate::path::Sought;
use crate::path::mis::Heuristic;
use crate::systems::list::{SPLAT_LIST_LAYERS, SPLAT_SAMPLE_LAYERS, SPLAT_STATE_LAYERS, SPLIT_LAYERS, TAKE_LAYERS};
use crate::table::LANES;

/// The subpaths of a chain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subpaths {
    /// One, from the camera.
    #[default]
    Camera,
    /// One, from a light.
    Light,
    /// One from each end.
    Both,
}

impl Subpaths {
    /// How many a chain has.
    #[must_use]
    pub const fn count(self) -> u32 {
        match self {
            Self::Camera | Self::Light => 1,
            Self::Both => 2,
        }
    }
}

/// What a tile's world is built from, and nothing else.
#[derive(Clone, Debug)]
pub struct TilePlan {
    /// Systems in the order in which they run: by place, and in one place as they were listed.
    pub systems: Vec<SystemPlan>,
    /// Tables.
    pub tables: Vec<TablePlan>,
    /// Chains that the tables have room for, a multiple of [`LANES`].
    pub size: u32,
    /// Why the tile has this size.
    pub reason: String,
    /// The subpaths of each of its chains: every table has room for all of them.
    pub subpaths: Subpaths,
    /// How weights are made of densities where light that is met is weighed against sampling it.
    pub heuristic: Heuristic,
    /// The light that its paths look for.
    pub sought: Sought,
    /// The fewest edges of a path that chains look for.
    pub shortest: u32,
    /// The most edges of a path, where they are fewer than the scene's.
    pub longest: u32,
}

impl TilePlan {
    /// Plans a tile of `systems` and `tables` for `size` chains, rounded up to whole lane groups; if none is given, for as
    /// many as fit the cache.
    #[must_use]
    pub fn new(systems: Vec<SystemPlan>, tables: Vec<TablePlan>, size: Option<u32>) -> Self {
        Self::with_subpaths(Subpaths::Camera, systems, tables, size)
    }

    /// The same for chains of these subpaths.
    #[must_use]
    pub fn with_subpaths(
        subpaths: Subpaths,
        mut systems: Vec<SystemPlan>,
        tables: Vec<TablePlan>,
        size: Option<u32>,
    ) -> Self {
        systems.sort_by_key(|system| system.spec.place());
        let (size, reason) = match size {
            Some(asked) => (
                asked.clamp(1, MAX_CHAINS).next_multiple_of(LANES as u32),
                "asked for".to_owned(),
            ),
            None => choose(&tables, subpaths),
        };
        let mut tile = Self {
            systems,
            tables,
            size: 0,
            reason: String::new(),
            subpaths,
            heuristic: Heuristic::default(),
            sought: Sought::default(),
            shortest: 1,
            longest: u32::MAX,
        };
        tile.resize(size, reason);
        tile
    }

    /// Subpaths that the tables have room for.
    #[must_use]
    pub const fn capacity(&self) -> u32 {
        self.size * self.subpaths.count()
    }

    /// The first subpath that starts at a light, see [`TilePlace`](crate::systems::tile::TilePlace).
    #[must_use]
    pub const fn lights_from(&self) -> u32 {
        match self.subpaths {
            Subpaths::Camera => u32::MAX,
            Subpaths::Light => 0,
            Subpaths::Both => self.size,
        }
    }

    /// The first depth whose vertices have primary coordinates.
    #[must_use]
    pub fn first_coordinate(&self) -> u32 {
        let table = self.tables.iter().find(|table| table.id == TableId::PROPOSED_PRIMARY);
        match table.map(|table| table.extent) {
            Some(Extent::PerDepth { first, .. }) => first,
            _ => 1,
        }
    }

    /// Gives the tile another size, a multiple of [`LANES`].
    pub(super) fn resize(&mut self, size: u32, reason: String) {
        let capacity = size * self.subpaths.count();
        for table in &mut self.tables {
            table.fit(capacity);
        }
        (self.size, self.reason) = (size, reason);
    }

    /// The same tile for a single chain: its tables are a lane group wide.
    #[must_use]
    pub fn for_one_chain(mut self) -> Self {
        self.resize(LANES as u32, "one chain".to_owned());
        self
    }

    /// The same tile without the systems that split light into layers.
    #[must_use]
    pub fn without_layers(mut self) -> Self {
        let of_layers = [
            SPLIT_LAYERS,
            SPLAT_SAMPLE_LAYERS,
            SPLAT_LIST_LAYERS,
            SPLAT_STATE_LAYERS,
            TAKE_LAYERS,
        ];
        self.systems.retain(|system| !of_layers.contains(&system.spec));
        self
    }

    /// Memory of the tile's tables as they are built, in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.tables.iter().map(TablePlan::bytes).sum()
    }

    /// Memory of the tile's tables when paths have made them grow as far as they can, in bytes.
    #[must_use]
    pub fn most_bytes(&self) -> u64 {
        self.tables.iter().map(TablePlan::most_bytes).sum()
    }
}

/// The most chains of a tile.
pub const MAX_CHAINS: u32 = 1 << 20;
/// What a tile's step should touch at most: half of the second-level cache of common cores (1 to 2 MiB).
const CACHE_BUDGET: usize = 1 << 20;
/// Vertices of a path that a step typically touches, whatever the depth that tables are built for: roulette ends most
/// paths soon after its first depth.
const TYPICAL_VERTICES: u32 = crate::path::roulette::FIRST_DEPTH + 1;
/// The range from which the size is chosen: below it the schedule's own cost shows, above it nothing is gained.
const RANGE: (u32, u32) = (64, 4096);

/// Chooses a power of two, and says why.
fn choose(tables: &[TablePlan], subpaths: Subpaths) -> (u32, String) {
    let bytes = tables.iter().map(touched_bytes).sum::<usize>() * subpaths.count() as usize;
    let fitting = (CACHE_BUDGET / bytes.max(1)) as u32;
    let size =
        (fitting.max(1).next_power_of_two() / if fitting.is_power_of_two() { 1 } else { 2 }).clamp(RANGE.0, RANGE.1);
    (
        size,
        format!(
            "a step touches about {bytes} B per chain, and {} KiB of tables stay in cache",
            CACHE_BUDGET >> 10
        ),
    )
}

/// Bytes per chain that a step typically touches.
fn touched_bytes(table: &TablePlan) -> usize {
    table.entry_bytes() * table.extent.most_entries().min(TYPICAL_VERTICES) as usize
}
