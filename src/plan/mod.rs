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
pub use system::{InPlan, Phases, Place, Stage, SystemPlan, SystemSpec, TraceStep, Traces};
pub use table::{ColumnPlan, Extent, TableId, TablePlan};
pub use technique::{Technique, UnknownTechnique};
pub use tile::TilePlan;

use crate::scene::Scene;

/// What a render will do, and why.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The technique that was asked for.
    pub technique: Technique,
    /// Every effect, on or off.
    pub effects: Vec<EffectPlan>,
    /// What every tile's world is built from.
    pub tile: TilePlan,
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
        let (systems, tables) = match technique {
            Technique::Pt => (
                path_tracing::systems(scene, &effects),
                path_tracing::tables(scene, &effects),
            ),
            Technique::PtReference => (reference::systems(&effects), reference::tables(&effects)),
        };
        let tile = TilePlan::new(systems, tables, tile_size);
        let tree_bytes = scene.geometry.tree_bytes() as u64;
        Self {
            technique,
            effects,
            tile,
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
}
