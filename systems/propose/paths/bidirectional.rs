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

use super::moves_paths::{MovesPaths, PathProposal, Way};
use super::view::PathView;
use crate::path::whole::{Deletion, Replacement};
use crate::path_systems;
use crate::plan::{Mutation, StateSpace, SystemPlan};
use crate::sampling::{Purpose, StreamKey};
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

    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        Some(Box::new(self.clone()))
    }

    fn systems(&self) -> Vec<SystemPlan> {
        path_systems!(Self, "bidirectional":
            propose "part of the path is replaced",
            weigh "any strategy could have drawn that part")
    }
}

/// t of the strategies that can put `vertices` into a gap of a path: whether the vertices on its sides can be joined does not change
/// when others are put in.
fn strategies(path: &PathView<'_>, deletion: Deletion, vertices: u32) -> RangeInclusive<u32> {
    let Deletion {
        from_camera,
        from_light,
        ..
    } = deletion;
    let first = match from_camera {
        0 => 1,
        kept => kept + u32::from(!path.joins(kept - 1)),
    };
    let last = from_camera + vertices;
    first..=last - u32::from(from_light > 0 && !path.joins(path.edges + 1 - from_light))
}

/// How many numbers a range has.
fn count(range: &RangeInclusive<u32>) -> u32 {
    (range.end() + 1).saturating_sub(*range.start())
}

fn replacement(path: &PathView<'_>) -> Replacement {
    Replacement {
        shortest: path.shortest(),
        longest: path.longest(),
    }
}

impl MovesPaths for Bidirectional {
    fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal> {
        let replacement = replacement(path);
        let mut stream = key.stream(Purpose::PERTURB, 0);
        let [u, v, w, x] = std::array::from_fn(|_| stream.next_f64());
        let deletion = replacement.delete(path.edges, u, v);
        let growth = replacement.growth(path.edges, deletion);
        if growth.least > growth.most {
            return None;
        }
        let vertices = growth.sample(deletion.vertices, w);
        let strategies = strategies(path, deletion, vertices);
        let count = count(&strategies);
        (count > 0).then(|| {
            let t = strategies.start() + ((x * f64::from(count)) as u32).min(count - 1);
            let s = deletion.from_camera + vertices + deletion.from_light - t;
            PathProposal::new([deletion.from_camera, deletion.from_light], [t, s])
        })
    }

    fn density(&self, way: &Way<'_>) -> f64 {
        let replacement = replacement(&way.from);
        let [from_camera, from_light] = way.kept;
        let kept = from_camera + from_light;
        let deletion = Deletion {
            vertices: way.from.edges + 1 - kept,
            from_camera,
            from_light,
        };
        let vertices = way.to.edges + 1 - kept;
        let growth = replacement.growth(way.from.edges, deletion);
        let strategies = strategies(&way.from, deletion, vertices);
        let choices = f64::from(count(&strategies));
        let shares: f64 = strategies.map(|t| way.to.share(t)).sum();
        replacement.deletion(way.from.edges, deletion)
            * growth.probability(deletion.vertices, vertices)
            * (shares / choices)
    }
}
