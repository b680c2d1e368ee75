//! `large_step`: a path that has nothing to do with the current one. All its primary coordinates are drawn afresh, as path
//! tracing would (Kelemen, Szirmay-Kalos, Antal and Csonka 2002, section 4).
//!
//! | setting | meaning | default | others use |
//! |---|---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations | 0.4 | 0.05 to 0.5 |
//!
//! It is what lets a chain reach any light, whatever else it does: without it, chains stay near their seeds. Where light is
//! easy to find, more of it costs little; where it is hard, most large steps find nothing.
//!
//! T(x→y) = 1 both ways: primary coordinates are uniform.

use super::super::chains::{Keys, MutationLists};
use super::super::list::{DRAW_LARGE_STEPS, PROPOSE_LARGE_STEPS};
use super::drawing::{Drawing, Drawn};
use super::proposal::Proposals;
use crate::chain::MutationList;
use crate::path::{ChainTable, FilmCoordinates, VertexCoordinates};
use crate::plan::{MovesVertices, Mutation, Registered, StateSpace, Support, SystemPlan};
use crate::sampling::StreamKey;
use crate::table::{Read, Rows};
use bevy_ecs::system::Res;
use serde::{Deserialize, Serialize};

/// Settings of `large_step`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LargeStep {
    /// How often it is tried, relative to the other mutations.
    pub weight: f32,
}

impl Default for LargeStep {
    fn default() -> Self {
        Self { weight: 0.4 }
    }
}

impl Mutation for LargeStep {
    const NAME: &'static str = "large_step";
    const ABOUT: &'static str = "a new path, independent of the current one";
    const SPACE: StateSpace = StateSpace::PRIMARY;
    const INDEPENDENT: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn systems(&self) -> Vec<SystemPlan> {
        vec![
            SystemPlan::new(
                PROPOSE_LARGE_STEPS,
                "bootstraps and large steps start anywhere on the film",
            ),
            SystemPlan::new(DRAW_LARGE_STEPS, "and go on anywhere"),
        ]
    }

    fn depth_first(&self) -> Option<Box<dyn MovesVertices>> {
        Some(Box::new(Afresh))
    }

    fn support(&self) -> Option<Support> {
        Some(Support::Space)
    }
}

/// The same, one path after another.
#[derive(Clone, Copy, Debug)]
struct Afresh;

impl MovesVertices for Afresh {
    fn film(&self, _: FilmCoordinates, key: StreamKey) -> FilmCoordinates {
        FilmCoordinates::independent(key)
    }

    fn vertex(&self, _: VertexCoordinates, key: StreamKey, depth: u32) -> VertexCoordinates {
        VertexCoordinates::independent(key, depth)
    }
}

/// Draws where on the film the chains that take a large step start.
pub fn propose_large_steps(
    mutation: Res<Registered<LargeStep>>,
    lists: Res<MutationLists>,
    list: Read<MutationList, ChainTable>,
    keys: Keys,
    mut proposals: Proposals,
) {
    let (list, keys, mut proposals) = (list.rows(), keys.columns(), proposals.columns());
    for entry in lists.entries(mutation.number) {
        let chain = list.at(entry) as usize;
        proposals.start(chain, FilmCoordinates::independent(keys.at(chain)), 0.0);
    }
}

/// Draws the coordinates of the new vertices of chains that take a large step.
pub fn draw_large_steps(mutation: Res<Registered<LargeStep>>, mut drawing: Drawing) {
    drawing.draw(mutation.number, |_, waiting| Drawn::afresh(waiting));
}
