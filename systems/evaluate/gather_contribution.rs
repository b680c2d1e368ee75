//! A path's light from its vertices.

use super::super::tile::TilePlace;
use crate::chain::{ProposedClass, Signature, StateClass};
use crate::color::Rgb;
use crate::path::{
    ChainTable, Contribution, PathLength, ProposalTable, VERTEX_DISCRETE, VertexConnection, VertexEmission, VertexKind,
    VertexRatio, target_of,
};
use crate::table::{LANES, Read, Rows, Write};
use bevy_ecs::system::Res;

/// Sums, for every chain, the light of its vertices times the throughput up to them:
/// Σ (r₀ ⋯ r_d₋₁)(emission_d + connection_d), nearest vertex first. Chains with states are told which of the paths that end
/// at a light brings the most: its length and signature are the state's.
pub fn gather_contribution(
    place: Res<TilePlace>,
    lengths: Read<PathLength, ChainTable>,
    kinds: Read<VertexKind, ProposalTable>,
    ratios: Read<VertexRatio, ProposalTable>,
    emissions: Read<VertexEmission, ProposalTable>,
    connections: Read<VertexConnection, ProposalTable>,
    mut contributions: Write<Contribution, ChainTable>,
    mut classes: Write<ProposedClass, ChainTable>,
) {
    let (lengths, kinds, ratios) = (lengths.rows(), kinds.rows(), ratios.rows());
    let (emissions, connections) = (emissions.rows(), connections.rows());
    let (contributions, classes) = (contributions.rows(), classes.rows());
    let chains = place.chains as usize;
    for first in (0..chains).step_by(LANES) {
        for chain in first..chains.min(first + LANES) {
            let (mut radiance, mut throughput) = (Rgb::BLACK, Rgb::ONE);
            let mut brightest = Brightest::default();
            for depth in 1..=lengths.at(chain) {
                let vertex = place.vertex(chain, depth);
                throughput *= ratios.at(place.vertex(chain, depth - 1));
                let met = throughput * emissions.at(vertex);
                radiance += met;
                let mut connected = Rgb::BLACK;
                if !connections.is_empty() {
                    connected = throughput * connections.at(vertex);
                    radiance += connected;
                }
                if !classes.is_empty() {
                    brightest.see(met, connected, depth, kinds.at(vertex) == VERTEX_DISCRETE);
                }
            }
            contributions.put(chain, radiance);
            if !classes.is_empty() {
                classes.put(chain, brightest.class().0);
            }
        }
    }
}

/// The path that brings the most light, among those that a walk from the camera finds on its way.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Brightest {
    /// Vertices so far.
    signature: Signature,
    most: f32,
    length: u32,
    best: Signature,
}

impl Brightest {
    /// Sees the vertex at `depth`, with the light met there and the light connected to.
    #[inline]
    pub(crate) fn see(&mut self, met: Rgb, connected: Rgb, depth: u32, discrete: bool) {
        self.consider(target_of(met), depth);
        self.signature = self.signature.then(discrete);
        self.consider(target_of(connected), depth + 1);
    }

    #[inline]
    fn consider(&mut self, light: f32, length: u32) {
        if light > self.most {
            (self.most, self.length, self.best) = (light, length, self.signature);
        }
    }

    /// Its classes, but for the block.
    #[inline]
    pub(crate) const fn class(&self) -> StateClass {
        StateClass::new(0, self.length, self.best)
    }
}
