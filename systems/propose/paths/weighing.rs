//! What transition densities of whole paths are made of, and where they are written.

use super::super::super::tile::TilePlace;
use crate::chain::{ForwardDensity, ProposedTarget, ReverseDensity};
use crate::path::whole::*;
use crate::path::{ChainTable, VERTEX_DISCRETE, VertexKind};
use crate::table::{Read, Rows, Write};
use bevy_ecs::system::SystemParam;

/// The columns that densities are made of.
#[derive(SystemParam)]
pub struct Weighing<'w, 's> {
    targets: Read<'w, 's, ProposedTarget, ChainTable>,
    edges: Read<'w, 's, PathEdges, ChainTable>,
    filters: Read<'w, 's, PathFilter, ChainTable>,
    kept_lights: Read<'w, 's, PathKeptLight, ChainTable>,
    kinds: Read<'w, 's, VertexKind, PathTable>,
    shares: Read<'w, 's, PathShare, PathTable>,
    onwards: Read<'w, 's, PathOnward, PathTable>,
    backs: Read<'w, 's, PathBack, PathTable>,
    proposed_edges: Read<'w, 's, ProposedEdges, ChainTable>,
    proposed_filters: Read<'w, 's, ProposedFilter, ChainTable>,
    proposed_kept_lights: Read<'w, 's, ProposedKeptLight, ChainTable>,
    proposed_kinds: Read<'w, 's, VertexKind, ProposedPathTable>,
    proposed_shares: Read<'w, 's, PathShare, ProposedPathTable>,
    proposed_onwards: Read<'w, 's, PathOnward, ProposedPathTable>,
    proposed_backs: Read<'w, 's, PathBack, ProposedPathTable>,
    camera_kept: Read<'w, 's, KeptFromCamera, ChainTable>,
    light_kept: Read<'w, 's, KeptFromLight, ChainTable>,
    camera_made: Read<'w, 's, CameraVertices, ChainTable>,
    forward: Write<'w, 's, ForwardDensity, ChainTable>,
    reverse: Write<'w, 's, ReverseDensity, ChainTable>,
}

/// The densities of a path.
#[derive(Clone, Copy)]
pub struct PathDensities<'a> {
    place: &'a TilePlace,
    chain: usize,
    /// k.
    pub edges: u32,
    /// The sum of all pixels' filters at the place on the film through which it goes.
    pub filter: f32,
    /// See [`Measured::kept_light`].
    pub kept_light: f64,
    kinds: &'a [VertexKind],
    shares: &'a [PathShare],
    onwards: &'a [PathOnward],
    backs: &'a [PathBack],
}

impl PathDensities<'_> {
    /// The share of strategy (s, t) in the path's density; of what the lens sees (t = 1), as if one pixel were chosen among those
    /// whose filters reach there, in proportion to them.
    #[inline]
    #[must_use]
    pub fn share(&self, t: u32) -> f64 {
        let share = self.shares.at(self.place.path_vertex(self.chain, t as usize - 1));
        if t == 1 { share / f64::from(self.filter) } else { share }
    }

    /// t of the subpath from the camera that perturbations re-trace, see [`PathForm::camera_vertices`].
    #[must_use]
    pub fn camera_vertices(&self) -> u32 {
        camera_vertices(self.edges as usize, |i| self.is_discrete(i as u32)) as u32
    }

    /// Whether vertex `i` scatters into one of a few directions.
    #[must_use]
    pub fn is_discrete(&self, i: u32) -> bool {
        self.kinds.at(self.place.path_vertex(self.chain, i as usize)) == VERTEX_DISCRETE
    }

    /// The density of going on towards the light at vertex `i`.
    #[inline]
    #[must_use]
    pub fn onward(&self, i: u32) -> f64 {
        f64::from(self.onwards.at(self.place.path_vertex(self.chain, i as usize)))
    }

    /// The density of going on towards the camera at vertex `i`.
    #[inline]
    #[must_use]
    pub fn back(&self, i: u32) -> f64 {
        f64::from(self.backs.at(self.place.path_vertex(self.chain, i as usize)))
    }
}

/// One way: from a path to another, which a mutation makes of it.
#[derive(Clone, Copy)]
pub struct Way<'a> {
    /// The path that is left.
    pub from: PathDensities<'a>,
    /// The path that is proposed.
    pub to: PathDensities<'a>,
    /// t₀ and s₀: vertices that both have in common at their ends.
    pub kept: [u32; 2],
    /// t of the strategy by which the mutation has made its proposal: of both ways for mutations that keep it.
    pub made: u32,
    /// Whether it leads from the proposal to the current path.
    pub is_back: bool,
}

impl Weighing<'_, '_> {
    /// Writes ln (T / r) of both ways for the listed chains, where `density` is T / r of one way, in the measure of
    /// [`whole`](crate::path::whole): what the densities of vertices that are kept contribute is the same both ways, and left out.
    pub fn weigh(
        &mut self,
        place: &TilePlace,
        chains: impl Iterator<Item = usize>,
        mut density: impl FnMut(usize, &Way<'_>) -> f64,
    ) {
        let (targets, edges, proposed_edges) = (self.targets.rows(), self.edges.rows(), self.proposed_edges.rows());
        let (filters, proposed_filters) = (self.filters.rows(), self.proposed_filters.rows());
        let (kept_lights, proposed_kept_lights) = (self.kept_lights.rows(), self.proposed_kept_lights.rows());
        let current = (
            self.kinds.rows(),
            self.shares.rows(),
            self.onwards.rows(),
            self.backs.rows(),
        );
        let proposed = (
            self.proposed_kinds.rows(),
            self.proposed_shares.rows(),
            self.proposed_onwards.rows(),
            self.proposed_backs.rows(),
        );
        let (camera_kept, light_kept) = (self.camera_kept.rows(), self.light_kept.rows());
        let camera_made = self.camera_made.rows();
        let (forward, reverse) = (self.forward.rows(), self.reverse.rows());
        for chain in chains {
            forward.put(chain, 0.0);
            reverse.put(chain, 0.0);
            if targets.at(chain) <= 0.0 {
                continue;
            }
            let of = |edges: u32, filter, kept_light, (kinds, shares, onwards, backs)| PathDensities {
                place,
                chain,
                edges,
                filter,
                kept_light,
                kinds,
                shares,
                onwards,
                backs,
            };
            let x = of(edges.at(chain), filters.at(chain), kept_lights.at(chain), current);
            let y = of(
                proposed_edges.at(chain),
                proposed_filters.at(chain),
                proposed_kept_lights.at(chain),
                proposed,
            );
            let way = |from, to, is_back| Way {
                from,
                to,
                kept: [camera_kept.at(chain), light_kept.at(chain)],
                made: camera_made.at(chain),
                is_back,
            };
            forward.put(chain, libm::log(density(chain, &way(x, y, false))));
            // Before its first state a chain has nothing to come back to.
            if x.edges > 0 {
                reverse.put(chain, libm::log(density(chain, &way(y, x, true))));
            }
        }
    }
}
