//! Splat lists of accepted proposals.

use super::super::tile::{Queues, TilePlace};
use crate::chain::AcceptedList;
use crate::path::{ChainTable, ProposedSplatCount, ProposedSplatTable, SplatColor, SplatCount, SplatPixel, SplatTable};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::Res;

/// Makes the splat list of every accepted proposal that of the current state. Stands in the splat stage, since the list it
/// overwrites has to be splatted first.
pub fn take_splats(
    place: Res<TilePlace>,
    queues: Res<Queues>,
    accepted: Read<AcceptedList, ChainTable>,
    proposed_counts: Read<ProposedSplatCount, ChainTable>,
    proposed_pixels: Read<SplatPixel, ProposedSplatTable>,
    proposed_colors: Read<SplatColor, ProposedSplatTable>,
    mut counts: Write<SplatCount, ChainTable>,
    mut pixels: Write<SplatPixel, SplatTable>,
    mut colors: Write<SplatColor, SplatTable>,
) {
    let (accepted, proposed_counts) = (accepted.rows(), proposed_counts.rows());
    let (proposed_pixels, proposed_colors) = (proposed_pixels.rows(), proposed_colors.rows());
    let (counts, pixels, colors) = (counts.rows(), pixels.rows(), colors.rows());
    for entry in 0..queues.accepted {
        let chain = accepted.at(entry) as usize;
        let count = proposed_counts.at(chain);
        counts.put(chain, count);
        for splat in (0..count).map(|k| place.vertex(chain, k)) {
            pixels.put(splat, proposed_pixels.at(splat));
            colors.put(splat, proposed_colors.at(splat));
        }
    }
}
