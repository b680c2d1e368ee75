//! Where light tracing sees anything.

use chainlight::film::BlockGrid;
use chainlight::path::{ChainTable, PathLength, ProposalTable, VERTEX_DISCRETE, VERTEX_INFINITE, VertexKind};
use chainlight::plan::{Plan, PlanOptions, Technique};
use chainlight::render::{Rendering, SplatRender};
use chainlight::scene::Scene;
use chainlight::systems::tile::TilePlace;
use miette::Result;
use std::sync::Arc;

/// Looks per pixel.
const LOOKS: u64 = 64;

/// The blocks of which light tracing finds all light. It is blind to what the lens sees by way of mirrors or smooth glass alone,
/// and to light at infinity behind which there is no surface: blocks are left out of which some camera path's first vertex
/// scattered into one of a few directions, or was at infinity.
///
/// The vertices are those of bidirectional path tracing, so that filters, lens and the lobes of coated surfaces count as they do
/// in pictures.
pub fn seen_by_light_tracing(scene: &Arc<Scene>, blocks_per_side: u32) -> Result<Vec<bool>> {
    let grid = BlockGrid::new(scene.width, scene.height, blocks_per_side);
    let pixels = scene.pixel_count();
    let options = PlanOptions {
        // The whole film in one tile, so that one world has every pixel's path.
        tile_size: Some(pixels),
        ..PlanOptions::default()
    };
    let plan = Plan::with(scene, Technique::Bdpt, &options)?;
    let mut render = SplatRender::new(Arc::clone(scene), plan, 1, 1)?;
    let mut seen = vec![true; grid.blocks()];
    for _ in 0..LOOKS {
        render.burst(1, &|_| {});
        render.for_each_world(&mut |_, world| {
            let place = *world.world().resource::<TilePlace>();
            for pixel in 0..pixels {
                let path = pixel as usize;
                let length = world.at::<PathLength, ChainTable>(path).unwrap_or_default();
                if length == 0 {
                    continue;
                }
                let kind = world.at::<VertexKind, ProposalTable>(place.vertex(path, 1));
                if matches!(kind, Some(VERTEX_DISCRETE | VERTEX_INFINITE))
                    && let Some(block) = grid.block_of(pixel)
                {
                    seen[block] = false;
                }
            }
        });
    }
    Ok(seen)
}
