//! `small_step`: a path near the current one. Every primary coordinate moves by a small step of either sign, and wraps around
//! (Kelemen, Szirmay-Kalos, Antal and Csonka 2002, section 4): its size is distributed as 1/|d| between the two bounds, so
//! that steps of every order of magnitude between them are as likely.
//!
//! | setting | meaning | default | others use |
//! |---|---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations | 0.6 | 0.5 to 0.95 |
//! | `smallest` | the smallest step of a coordinate | 1/1024 | 1/1024 to 1/256 |
//! | `largest` | the largest step of a coordinate, at most 0.5 | 1/16 | 1/64 to 1/16 |
//!
//! The defaults are those with the smallest errors on the shipped scenes, among those tried (`ARCHITECTURE.md` has the table).
//! Larger steps get around sooner and are turned down more often; they cost nothing else.
//!
//! Coordinates beyond the end of the current path are uniform whatever the state, so they are drawn afresh. T is symmetric:
//! the product over the coordinates that both paths have.

use super::super::chains::{Keys, MutationLists};
use super::super::list::{
    DRAW_SMALL_STEPS, DRAW_SMALL_SUPPORTS, PROPOSE_SMALL_STEPS, PROPOSE_SMALL_SUPPORTS, WEIGH_SMALL_SUPPORTS,
};
use super::drawing::{Drawing, Drawn};
use super::proposal::Proposals;
use crate::chain::{Kernel, KnownDraws, MutationList};
use crate::path::{ChainTable, FilmCoordinates, PrimaryFilm, VertexCoordinates};
use crate::plan::{MovesVertices, Mutation, Region, Registered, StateSpace, Support, SystemPlan};
use crate::sampling::StreamKey;
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use serde::{Deserialize, Serialize};

/// Settings of `small_step`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SmallStep {
    /// How often it is tried, relative to the other mutations.
    pub weight: f32,
    /// The smallest step of a coordinate.
    pub smallest: f32,
    /// The largest step of a coordinate.
    pub largest: f32,
}

impl Default for SmallStep {
    fn default() -> Self {
        Self {
            weight: 0.6,
            smallest: 1.0 / 1024.0,
            largest: 1.0 / 16.0,
        }
    }
}

impl SmallStep {
    /// The distribution of steps.
    ///
    /// # Panics
    /// Never for settings that were checked.
    #[must_use]
    pub fn kernel(&self) -> Kernel {
        match Kernel::new(self.smallest, self.largest) {
            Ok(kernel) => kernel,
            Err(error) => panic!("settings are checked before they are planned: {error}"),
        }
    }
}

impl Mutation for SmallStep {
    const NAME: &'static str = "small_step";
    const ABOUT: &'static str = "a path near the current one: every coordinate moves a little";
    const SPACE: StateSpace = StateSpace::PRIMARY;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn check(&self) -> Result<(), String> {
        Kernel::new(self.smallest, self.largest)
            .map(|_| ())
            .map_err(|error| error.to_string())
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(PROPOSE_SMALL_STEPS, "small steps start near where the path starts"),
            SystemPlan::new(DRAW_SMALL_STEPS, "and go on near where it goes"),
        ]
    }

    fn depth_first(&self) -> Option<Box<dyn MovesVertices>> {
        Some(Box::new(Nearby(self.kernel())))
    }

    fn support(&self) -> Option<Support> {
        Some(Support::Region(Region {
            draw: vec![
                SystemPlan::new(
                    PROPOSE_SMALL_SUPPORTS,
                    "known draws of starts that a small step can reach",
                ),
                SystemPlan::new(DRAW_SMALL_SUPPORTS, "and of ways on"),
            ],
            weigh: vec![SystemPlan::new(WEIGH_SMALL_SUPPORTS, "the density of those draws")],
            fourth_moment: KnownDraws::FOURTH_MOMENT,
        }))
    }
}

/// The same, one path after another.
#[derive(Clone, Debug)]
struct Nearby(Kernel);

impl MovesVertices for Nearby {
    fn film(&self, current: FilmCoordinates, key: StreamKey) -> FilmCoordinates {
        current.perturbed(&self.0, key)
    }

    fn vertex(&self, current: VertexCoordinates, key: StreamKey, depth: u32) -> VertexCoordinates {
        current.perturbed(&self.0, key, depth)
    }
}

/// Moves where on the film the chains that take a small step start.
pub fn propose_small_steps(
    mutation: Res<Registered<SmallStep>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let kernel = mutation.settings.kernel();
    let (list, keys, film, mut proposals) = (list.rows(), keys.columns(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        let current = FilmCoordinates(film.at(chain));
        let moved = current.perturbed(&kernel, keys.at(chain));
        let density = if proposals.wants_common() {
            current.log_density(&kernel, moved)
        } else {
            0.0
        };
        proposals.start(chain, moved, density);
    }
}

/// Moves the coordinates of the new vertices of chains that take a small step; where the current path has ended, draws them.
pub fn draw_small_steps(mutation: Res<Registered<SmallStep>>, mut drawing: Drawing) {
    let kernel = mutation.settings.kernel();
    drawing.draw(mutation.number, |current, waiting| {
        let Some(from) = current else {
            return Drawn::afresh(waiting);
        };
        let coordinates = from.perturbed(&kernel, waiting.key, waiting.depth);
        let mut drawn = Drawn::uniform(coordinates);
        if waiting.wants_common {
            drawn.common = from.log_density(&kernel, coordinates, waiting.depth, waiting.set);
        }
        drawn
    });
}
