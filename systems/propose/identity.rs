//! `identity`: the current path again. It changes nothing, and so must give the same light, bit for bit, and be taken every
//! time: a test of everything that re-traces paths, and the simplest mutation to copy from.
//!
//! | setting | meaning | default |
//! |---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations | 0: not at all |

use super::super::chains::MutationLists;
use super::super::list::{DRAW_IDENTITIES, PROPOSE_IDENTITIES};
use super::drawing::{Drawing, Drawn};
use super::proposal::Proposals;
use crate::chain::MutationList;
use crate::path::{ChainTable, FilmCoordinates, PrimaryFilm, VertexCoordinates};
use crate::plan::{MovesVertices, Mutation, Registered, StateSpace, Support, SystemPlan};
use crate::sampling::StreamKey;
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use serde::{Deserialize, Serialize};

/// Settings of `identity`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Identity {
    /// How often it is tried, relative to the other mutations.
    pub weight: f32,
}

impl Mutation for Identity {
    const NAME: &'static str = "identity";
    const ABOUT: &'static str = "the current path again: for tests";
    const SPACE: StateSpace = StateSpace::PRIMARY;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(PROPOSE_IDENTITIES, "the path starts where it starts"),
            SystemPlan::new(DRAW_IDENTITIES, "and goes where it goes"),
        ]
    }

    fn depth_first(&self) -> Option<Box<dyn MovesVertices>> {
        Some(Box::new(Unmoved))
    }

    fn support(&self) -> Option<Support> {
        Some(Support::State)
    }
}

/// The same, one path after another.
#[derive(Clone, Copy, Debug)]
struct Unmoved;

impl MovesVertices for Unmoved {
    fn film(&self, current: FilmCoordinates, _: StreamKey) -> FilmCoordinates {
        current
    }

    fn vertex(&self, current: VertexCoordinates, _: StreamKey, _: u32) -> VertexCoordinates {
        current
    }
}

/// Starts the chains that stay where they are.
pub fn propose_identities(
    mutation: Res<Registered<Identity>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    film: Read<PrimaryFilm, ChainTable>,
    mut proposals: Proposals,
) {
    let (list, film, mut proposals) = (list.rows(), film.rows(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        proposals.start(chain, FilmCoordinates(film.at(chain)), 0.0);
    }
}

/// Copies the coordinates of the vertices of chains that stay where they are.
pub fn draw_identities(mutation: Res<Registered<Identity>>, mut drawing: Drawing) {
    drawing.draw(mutation.number, |current, waiting| {
        // A path without light has no state to be copied: before its first one, a chain draws.
        current.map_or_else(|| Drawn::afresh(waiting), Drawn::uniform)
    });
}
