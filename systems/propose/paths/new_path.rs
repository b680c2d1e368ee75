//! `new_path`: a path that has nothing to do with the current one: of some length, by some strategy of bidirectional path tracing.
//!
//! | setting | meaning | default |
//! |---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations | 0.1 |
//! | `exponent` | how fast longer paths get rarer among those it tries: as (k + 2) to this power, from 0 to 16 | 2 |
//!
//! Bootstraps draw seeds with it, and what its proposals weigh makes the normalization surer while chains run. A little of it lets
//! every chain reach any light. Where long paths matter, such as between mirrors, a smaller `exponent` finds more of them, at the
//! cost of shorter ones.
//!
//! T(x→y) does not depend on x: the probability of y's length, times the sum over its k + 1 strategies of the probability of each
//! times its density.

use super::super::super::chains::{Keys, MutationLists};
use super::super::super::list::{PROPOSE_NEW_PATHS, WEIGH_NEW_PATHS};
use super::super::super::tile::{SceneRef, TilePlace};
use super::range::{PathRange, Ranges};
use super::weighing::Weighing;
use crate::chain::MutationList;
use crate::path::ChainTable;
use crate::path::whole::{Lengths, StrategyChoice};
use crate::plan::{Mutation, Registered, StateSpace, SystemPlan};
use crate::sampling::Purpose;
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use serde::{Deserialize, Serialize};

/// Settings of `new_path`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct NewPath {
    /// How often it is tried, relative to the other mutations.
    pub weight: f32,
    /// How fast longer paths get rarer among those it tries.
    pub exponent: f32,
}

impl Default for NewPath {
    fn default() -> Self {
        Self {
            weight: 0.1,
            exponent: 2.0,
        }
    }
}

impl NewPath {
    /// The lengths of its paths, of at least `shortest` and at most `longest` edges.
    fn lengths(&self, shortest: u32, longest: u32) -> Lengths {
        Lengths {
            shortest,
            longest,
            exponent: f64::from(self.exponent),
        }
    }
}

impl Mutation for NewPath {
    const NAME: &'static str = "new_path";
    const ABOUT: &'static str = "a new path, independent of the current one";
    const SPACE: StateSpace = StateSpace::PATH;
    const INDEPENDENT: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn check(&self) -> Result<(), String> {
        if (0.0..=16.0).contains(&self.exponent) {
            Ok(())
        } else {
            Err(format!("`exponent` is a number from 0 to 16, not {}", self.exponent))
        }
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(PROPOSE_NEW_PATHS, "bootstraps and new paths start at both ends"),
            SystemPlan::new(WEIGH_NEW_PATHS, "any strategy could have found them"),
        ]
    }
}

/// Chooses a length and a strategy for every chain that tries a new path.
pub fn propose_new_paths(
    mutation: Res<Registered<NewPath>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    mut ranges: Ranges,
) {
    let lengths = mutation.settings.lengths(place.shortest, scene.0.max_depth);
    let (list, keys) = (list.rows(), keys.columns());
    for chain in lists.entries(mutation.number).map(|entry| list.at(entry) as usize) {
        let mut stream = keys.at(chain).stream(Purpose::PERTURB, 0);
        let k = lengths.sample(stream.next_f64());
        let t = StrategyChoice { length: k }.sample(stream.next_f64());
        ranges.put(
            &place,
            chain,
            PathRange {
                kept: [0, 0],
                made: [t, k + 1 - t],
                steered: [false; 2],
            },
        );
    }
}

/// Writes the densities of new paths.
pub fn weigh_new_paths(
    mutation: Res<Registered<NewPath>>,
    scene: Res<SceneRef>,
    place: Res<TilePlace>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    mut weighing: Weighing,
) {
    let lengths = mutation.settings.lengths(place.shortest, scene.0.max_depth);
    let list = list.rows();
    let chains = lists.entries(mutation.number).map(|entry| list.at(entry) as usize);
    weighing.weigh(&place, chains, |_, way| {
        let k = way.to.edges;
        let strategy = StrategyChoice { length: k };
        let drawn = (1..=k + 1).map(|t| strategy.probability(t) * way.to.share(t));
        lengths.probability(k) * drawn.sum::<f64>()
    });
}
