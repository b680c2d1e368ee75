//! `bidirectional`: takes some vertices out of the current path, at either end or in between, and puts in others, about as many,
//! drawn from both sides of the gap as bidirectional path tracing draws them (Veach and Guibas 1997, section 4.1; Veach 1997,
//! §11.3.1).
//!
//! | setting | meaning | default |
//! |---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations | 1 |
//!
//! It makes large changes: other lengths, other signatures, other lights. With it alone a chain gets everywhere that two subpaths
//! can be joined. In a path whose light is hard to find, most of what it tries finds nothing; perturbations explore what is near.
//!
//! T(x→y) sums over every strategy that could have drawn the new vertices, however many of them came from either side.

use super::super::super::chains::{Keys, MutationLists};
use super::super::super::list::{PROPOSE_BIDIRECTIONAL, WEIGH_BIDIRECTIONAL};
use super::super::super::tile::{SceneRef, TilePlace};
use super::range::{PathRange, Ranges};
use super::weighing::Weighing;
use crate::chain::MutationList;
use crate::path::whole::{Deletion, PathEdges, PathTable, Replacement};
use crate::path::{ChainTable, VertexMaterial};
use crate::plan::{Mutation, Registered, StateSpace, SystemPlan};
use crate::sampling::Purpose;
use crate::scene::Scene;
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Settings of `bidirectional`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Bidirectional {
    /// How often it is tried, relative to the other mutations.
    pub weight: f32,
}

impl Default for Bidirectional {
    fn default() -> Self {
        Self { weight: 1.0 }
    }
}

impl Mutation for Bidirectional {
    const NAME: &'static str = "bidirectional";
    const ABOUT: &'static str = "some vertices are taken out, others put in from both sides";
    const SPACE: StateSpace = StateSpace::PATH;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(PROPOSE_BIDIRECTIONAL, "part of the path is replaced"),
            SystemPlan::new(WEIGH_BIDIRECTIONAL, "any strategy could have drawn that part"),
        ]
    }
}

/// The current paths of chains, as far as deletions ask.
struct Paths<'a> {
    scene: &'a Scene,
    place: &'a TilePlace,
    materials: &'a [VertexMaterial],
}

impl Paths<'_> {
    /// Whether vertex `depth` of a chain's current path is on a surface that can be joined to others.
    fn joins(&self, chain: usize, depth: u32) -> bool {
        let material = self.materials.at(self.place.path_vertex(chain, depth as usize));
        !self.scene.materials.kind(material).is_discrete()
    }

    /// t of the strategies that can put `vertices` into a gap of the current path of a chain, which has `edges`: whether the
    /// vertices on its sides can be joined does not change when others are put in.
    fn strategies(&self, chain: usize, edges: u32, deletion: Deletion, vertices: u32) -> RangeInclusive<u32> {
        let Deletion {
            from_camera,
            from_light,
            ..
        } = deletion;
        let first = match from_camera {
            0 => 1,
            kept => kept + u32::from(!self.joins(chain, kept - 1)),
        };
        let last = from_camera + vertices;
        first..=last - u32::from(from_light > 0 && !self.joins(chain, edges + 1 - from_light))
    }
}

/// How many numbers a range has.
fn count(range: &RangeInclusive<u32>) -> u32 {
    (range.end() + 1).saturating_sub(*range.start())
}

/// Chooses what is replaced by how much, and from which sides, for every chain that tries it.
pub fn propose_bidirectional(
    mutation: Res<Registered<Bidirectional>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    edges: Read<PathEdges, ChainTable>,
    materials: Read<VertexMaterial, PathTable>,
    mut ranges: Ranges,
) {
    let replacement = replacement(&scene, &place);
    let paths = Paths {
        scene: &scene.0,
        place: &place,
        materials: materials.rows(),
    };
    let (list, keys, edges) = (list.rows(), keys.columns(), edges.rows());
    for chain in lists.entries(mutation.number).map(|entry| list.at(entry) as usize) {
        let length = edges.at(chain);
        let mut stream = keys.at(chain).stream(Purpose::PERTURB, 0);
        let [u, v, w, x] = std::array::from_fn(|_| stream.next_f64());
        let chosen = (length > 0).then(|| {
            let deletion = replacement.delete(length, u, v);
            let growth = replacement.growth(length, deletion);
            if growth.least > growth.most {
                return None;
            }
            let vertices = growth.sample(deletion.vertices, w);
            let strategies = paths.strategies(chain, length, deletion, vertices);
            let count = count(&strategies);
            (count > 0).then(|| {
                let t = strategies.start() + ((x * f64::from(count)) as u32).min(count - 1);
                PathRange {
                    kept: [deletion.from_camera, deletion.from_light],
                    made: [t, deletion.from_camera + vertices + deletion.from_light - t],
                    steered: [false; 2],
                }
            })
        });
        match chosen.flatten() {
            Some(range) => ranges.put(&place, chain, range),
            None => ranges.none(chain),
        }
    }
}

/// Writes the densities of what was put in, and of what was taken out.
pub fn weigh_bidirectional(
    mutation: Res<Registered<Bidirectional>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    edges: Read<PathEdges, ChainTable>,
    materials: Read<VertexMaterial, PathTable>,
    mut weighing: Weighing,
) {
    let replacement = replacement(&scene, &place);
    let paths = Paths {
        scene: &scene.0,
        place: &place,
        materials: materials.rows(),
    };
    let (list, edges) = (list.rows(), edges.rows());
    let chains = lists.entries(mutation.number).map(|entry| list.at(entry) as usize);
    weighing.weigh(&place, chains, |chain, way| {
        let [from_camera, from_light] = way.kept;
        let kept = from_camera + from_light;
        let deletion = Deletion {
            vertices: way.from.edges + 1 - kept,
            from_camera,
            from_light,
        };
        let vertices = way.to.edges + 1 - kept;
        let strategies = paths.strategies(chain, edges.at(chain), deletion, vertices);
        let choices = f64::from(count(&strategies));
        let shares: f64 = strategies.map(|t| way.to.share(t)).sum();
        replacement.deletion(way.from.edges, deletion)
            * replacement
                .growth(way.from.edges, deletion)
                .probability(deletion.vertices, vertices)
            * (shares / choices)
    });
}

fn replacement(scene: &SceneRef, place: &TilePlace) -> Replacement {
    Replacement {
        shortest: place.shortest,
        longest: scene.0.max_depth,
    }
}
