//! Targets of proposals.

use super::super::tile::{FilmBlocks, TilePlace};
use crate::chain::{ProposedClass, ProposedTarget, StateClass};
use crate::path::{
    ChainTable, Contribution, FilmPixel, ProposedSplatCount, ProposedSplatTable, SplatColor, SplatPixel, target_of,
};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::Res;

/// Writes the target of every proposal, the one splat that a path from the camera makes, and the block that it is in.
pub fn evaluate_targets(
    place: Res<TilePlace>,
    blocks: Res<FilmBlocks>,
    contributions: Read<Contribution, ChainTable>,
    pixels: Read<FilmPixel, ChainTable>,
    mut targets: Write<ProposedTarget, ChainTable>,
    mut classes: Write<ProposedClass, ChainTable>,
    mut counts: Write<ProposedSplatCount, ChainTable>,
    mut splat_pixels: Write<SplatPixel, ProposedSplatTable>,
    mut splat_colors: Write<SplatColor, ProposedSplatTable>,
) {
    let (contributions, pixels) = (contributions.rows(), pixels.rows());
    let (targets, classes, counts) = (targets.rows(), classes.rows(), counts.rows());
    let (splat_pixels, splat_colors) = (splat_pixels.rows(), splat_colors.rows());
    for chain in 0..place.chains as usize {
        let (light, pixel) = (contributions.at(chain), pixels.at(chain));
        let target = target_of(light);
        targets.put(chain, target);
        let block = blocks.0.block_of(pixel).unwrap_or(0) as u32;
        classes.put(chain, StateClass(classes.at(chain)).in_block(block).0);
        let lit = target > 0.0 && target.is_finite();
        counts.put(chain, u32::from(lit));
        if lit {
            splat_pixels.put(chain, pixel);
            splat_colors.put(chain, normalized(light, target));
        }
    }
}

/// `light / target`, for targets down to the smallest number there is.
#[inline]
pub(crate) fn normalized(light: crate::color::Rgb, target: f32) -> crate::color::Rgb {
    let [r, g, b] = light.to_array();
    crate::color::Rgb::new(r / target, g / target, b / target)
}
