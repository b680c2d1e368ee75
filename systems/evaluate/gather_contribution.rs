//! A path's light from its vertices.

use super::super::tile::TilePlace;
use crate::color::Rgb;
use crate::path::{ChainTable, Contribution, PathLength, ProposalTable, VertexConnection, VertexEmission, VertexRatio};
use crate::table::{LANES, Read, Rows, Write};
use bevy_ecs::system::Res;

/// Sums, for every chain, the light of its vertices times the throughput up to them:
/// Σ (r₀ ⋯ r_d₋₁)(emission_d + connection_d), nearest vertex first.
pub fn gather_contribution(
    place: Res<TilePlace>,
    lengths: Read<PathLength, ChainTable>,
    ratios: Read<VertexRatio, ProposalTable>,
    emissions: Read<VertexEmission, ProposalTable>,
    connections: Read<VertexConnection, ProposalTable>,
    mut contributions: Write<Contribution, ChainTable>,
) {
    let (lengths, ratios) = (lengths.rows(), ratios.rows());
    let (emissions, connections) = (emissions.rows(), connections.rows());
    let contributions = contributions.rows();
    let chains = place.chains as usize;
    for first in (0..chains).step_by(LANES) {
        for chain in first..chains.min(first + LANES) {
            let (mut radiance, mut throughput) = (Rgb::BLACK, Rgb::ONE);
            for depth in 1..=lengths.at(chain) {
                let vertex = place.vertex(chain, depth);
                throughput *= ratios.at(place.vertex(chain, depth - 1));
                radiance += throughput * emissions.at(vertex);
                if !connections.is_empty() {
                    radiance += throughput * connections.at(vertex);
                }
            }
            contributions.put(chain, radiance);
        }
    }
}
