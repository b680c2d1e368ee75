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

use super::moves_paths::{MovesPaths, PathProposal, Way};
use super::view::PathView;
use crate::path::whole::{Lengths, StrategyChoice};
use crate::path_systems;
use crate::plan::{Mutation, StateSpace, SystemPlan};
use crate::sampling::{Purpose, StreamKey};
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
    /// The lengths of its paths.
    fn lengths(&self, path: &PathView<'_>) -> Lengths {
        Lengths {
            shortest: path.shortest(),
            longest: path.longest(),
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

    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        Some(Box::new(self.clone()))
    }

    fn systems(&self) -> Vec<SystemPlan> {
        path_systems!(Self, "new_path":
            propose "bootstraps and new paths start at both ends",
            weigh "any strategy could have found them")
    }
}

impl MovesPaths for NewPath {
    fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal> {
        let mut stream = key.stream(Purpose::PERTURB, 0);
        let k = self.lengths(path).sample(stream.next_f64());
        let t = StrategyChoice { length: k }.sample(stream.next_f64());
        Some(PathProposal::new([0, 0], [t, k + 1 - t]))
    }

    fn density(&self, way: &Way<'_>) -> f64 {
        let k = way.to.edges;
        let strategy = StrategyChoice { length: k };
        let drawn = (1..=k + 1).map(|t| strategy.probability(t) * way.to.share(t));
        self.lengths(&way.to).probability(k) * drawn.sum::<f64>()
    }
}
