//! The plan: from a scene and settings to the effects that exist, and the systems and columns that they bring.
//!
//! Schedule and tables are built from the plan and nothing else ([`crate::render::TileWorld`]), so an effect that a
//! scene does not call for has no system that runs and no column that takes memory. Every entry carries its reason.

mod effect;
mod path_tracing;
mod reference;
mod system;
mod table;
mod technique;
mod tile;

pub use effect::{Effect, EffectPlan};
pub use system::{Place, Stage, SystemId, SystemPlan, TraceStep};
pub use table::{ColumnPlan, TableKind, TablePlan};
pub use technique::{Technique, UnknownTechnique};

use crate::scene::Scene;
use crate::table::LANES;

/// What a render will do, and why.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The technique that was asked for.
    pub technique: Technique,
    /// Every effect, on or off.
    pub effects: Vec<EffectPlan>,
    /// Systems in the order in which they run.
    pub systems: Vec<SystemPlan>,
    /// Tables of a tile.
    pub tables: Vec<TablePlan>,
    /// Chains of a tile, a multiple of [`LANES`].
    pub tile_size: u32,
    /// Why the tile has this size.
    pub tile_reason: String,
    /// How rays are traced.
    pub tracer: &'static str,
    /// Why they are traced so.
    pub tracer_reason: String,
    /// Memory of the tree and its primitives, in bytes.
    pub tree_bytes: u64,
    /// Memory of the film, in bytes.
    pub film_bytes: u64,
}

impl Plan {
    /// Plans `technique` for `scene`. `tile_size` overrides the chains of a tile; it is rounded up to whole lane groups.
    #[must_use]
    pub fn new(scene: &Scene, technique: Technique, tile_size: Option<u32>) -> Self {
        let effects = effect::effects(scene);
        let (systems, mut tables) = match technique {
            Technique::Pt => (
                path_tracing::systems(scene, &effects),
                path_tracing::tables(scene, &effects),
            ),
            Technique::PtReference => (reference::systems(&effects), reference::tables(&effects)),
        };
        let (tile_size, tile_reason) = match tile_size {
            Some(asked) => (
                asked.clamp(1, tile::MAX_CHAINS).next_multiple_of(LANES as u32),
                "asked for".to_owned(),
            ),
            None => tile::choose(&tables),
        };
        for table in &mut tables {
            table.fit(tile_size);
        }
        let tree_bytes = scene.geometry.tree_bytes() as u64;
        Self {
            technique,
            effects,
            systems,
            tables,
            tile_size,
            tile_reason,
            tracer: "binary tree, one ray after another",
            tracer_reason: format!(
                "the only tracer so far; {} primitives",
                scene.geometry.primitive_count()
            ),
            tree_bytes,
            film_bytes: crate::film::Film::bytes(scene.width, scene.height),
        }
    }

    /// Whether `effect` is on.
    #[must_use]
    pub fn has(&self, effect: Effect) -> bool {
        effect::is_on(&self.effects, effect)
    }

    /// Memory of one tile's tables in bytes.
    #[must_use]
    pub fn tile_bytes(&self) -> u64 {
        self.tables.iter().map(TablePlan::bytes).sum()
    }
}
