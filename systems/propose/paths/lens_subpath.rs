//! `lens_subpath`: another start of the path, from anywhere on the film, by way of mirrors and clear surfaces alone to the first
//! matt or rough point, which is joined to the next point of the current path (Veach and Guibas 1997, section 4.4; Veach 1997,
//! §11.3.3).
//!
//! | setting | meaning | default |
//! |---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations, where it is suitable | 0.5 |
//!
//! Suitable for paths E S* D (D|L), and E S* L. It carries light that was found to all of the film that can see it, so that pixels
//! are visited about equally often; the number of mirrors and clear surfaces may change.
//!
//! T(x→y): the probability of the new number of vertices, times the density of the one strategy.

use super::super::super::chains::{Keys, MutationLists};
use super::super::super::list::{PROPOSE_LENS_SUBPATHS, WEIGH_LENS_SUBPATHS};
use super::super::super::tile::{SceneRef, TilePlace};
use super::range::{PathRange, Ranges};
use super::weighing::Weighing;
use crate::chain::{MutationList, StateClass};
use crate::path::whole::{Growth, LENS_TRAIT, PathEdges, PathTable, camera_vertices};
use crate::path::{ChainTable, VERTEX_DISCRETE, VertexKind};
use crate::plan::{Mutation, Registered, StateSpace, SystemPlan};
use crate::sampling::Purpose;
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use serde::{Deserialize, Serialize};

/// Settings of `lens_subpath`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LensSubpath {
    /// How often it is tried, relative to the other mutations, where it is suitable.
    pub weight: f32,
}

impl Default for LensSubpath {
    fn default() -> Self {
        Self { weight: 0.5 }
    }
}

impl Mutation for LensSubpath {
    const NAME: &'static str = "lens_subpath";
    const ABOUT: &'static str = "another start of the path, from anywhere on the film";
    const SPACE: StateSpace = StateSpace::PATH;
    const SELECTIVE: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn suitability(&self, state: StateClass) -> f32 {
        if state.traits() & LENS_TRAIT != 0 { 1.0 } else { 0.0 }
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(PROPOSE_LENS_SUBPATHS, "light that was found is seen from elsewhere"),
            SystemPlan::new(WEIGH_LENS_SUBPATHS, "each way is as likely as its strategy"),
        ]
    }
}

/// The numbers of vertices that a subpath from the camera can have which is joined to `s` of a path.
fn growth(scene: &SceneRef, place: &TilePlace, s: u32) -> Growth {
    Growth {
        least: 2.max((place.shortest + 1).saturating_sub(s)),
        most: scene.0.max_depth + 1 - s,
    }
}

/// Chooses how many vertices the new start has, for every chain that tries it.
pub fn propose_lens_subpaths(
    mutation: Res<Registered<LensSubpath>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    edges: Read<PathEdges, ChainTable>,
    kinds: Read<VertexKind, PathTable>,
    mut ranges: Ranges,
) {
    let (list, keys, edges, kinds) = (list.rows(), keys.columns(), edges.rows(), kinds.rows());
    for chain in lists.entries(mutation.number).map(|entry| list.at(entry) as usize) {
        let k = edges.at(chain);
        if k == 0 {
            ranges.none(chain);
            continue;
        }
        let is_discrete = |i| kinds.at(place.path_vertex(chain, i)) == VERTEX_DISCRETE;
        let t = camera_vertices(k as usize, is_discrete) as u32;
        let s = k + 1 - t;
        let u = keys.at(chain).stream(Purpose::PERTURB, 0).next_f64();
        let range = PathRange {
            kept: [0, s],
            made: [growth(&scene, &place, s).sample(t, u), s],
            steered: [false; 2],
        };
        ranges.put(&place, chain, range);
    }
}

/// Writes the densities. A new start that scatters with a density before its last vertex is not one that could have been chosen.
pub fn weigh_lens_subpaths(
    mutation: Res<Registered<LensSubpath>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    mut weighing: Weighing,
) {
    let list = list.rows();
    let chains = lists.entries(mutation.number).map(|entry| list.at(entry) as usize);
    weighing.weigh(&place, chains, |_, way| {
        let s = way.kept[1];
        let vertices = |edges: u32| edges + 1 - s;
        let (from, to) = (vertices(way.from.edges), vertices(way.to.edges));
        if way.from.camera_vertices() != from || way.to.camera_vertices() != to {
            return 0.0;
        }
        if (1..to - 1).any(|i| !way.to.is_discrete(i)) {
            return 0.0;
        }
        let kept_light = if s == 1 { way.to.kept_light } else { 1.0 };
        growth(&scene, &place, s).probability(from, to) * way.to.share(to) * kept_light
    });
}
