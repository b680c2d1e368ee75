//! The size of a tile: as many chains as keep the tables that a step touches inside a core's cache.

use super::table::{Extent, TablePlan};

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
pub(super) fn choose(tables: &[TablePlan]) -> (u32, String) {
    let bytes: usize = tables.iter().map(touched_bytes).sum();
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
    match table.extent {
        Extent::PerChain(entries) => table.entry_bytes() * entries.min(TYPICAL_VERTICES) as usize,
        Extent::OneGroup => 0,
    }
}
