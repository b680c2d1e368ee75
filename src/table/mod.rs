//! Tables: how everything that changes while rendering is laid out.
//!
//! A table is one archetype of a tile's [`World`](bevy_ecs::world::World). Its rows are **lane groups**: [`LANES`]
//! chains (or rays) side by side, every component an array of [`LANES`] values per scalar, aligned to a cache line.
//! So a column is an array of SIMD lanes and, flattened, a plain slice indexed by chain. bevy keeps about 8 bytes of
//! ticks per component and 24 per entity in every row; at one vertex a row they would outweigh the vertex, at sixteen
//! they vanish. Rows are spawned once per tile and never move, so a row number is the address.

mod column;
mod lanes;
mod whole;

pub use column::{Column, ColumnSpec, Rows};
pub use lanes::{
    LANES, LaneValue, Lanes3, LanesD2, LanesF32, LanesF64, LanesU2, LanesU32, LanesU64, LanesUL2, lane_groups,
};
pub use whole::{Read, Table, Write};
