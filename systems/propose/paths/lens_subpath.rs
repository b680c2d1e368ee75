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

use super::moves_paths::{MovesPaths, PathProposal, Way};
use super::view::PathView;
use crate::chain::StateClass;
use crate::path::whole::{Growth, LENS_TRAIT};
use crate::path_systems;
use crate::plan::{Mutation, StateSpace, SystemPlan};
use crate::sampling::{Purpose, StreamKey};
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

    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        Some(Box::new(self.clone()))
    }

    fn systems(&self) -> Vec<SystemPlan> {
        path_systems!(Self, "lens_subpath":
            propose "light that was found is seen from elsewhere",
            weigh "each way is as likely as its strategy")
    }
}

/// The numbers of vertices that a subpath from the camera can have which is joined to `s` of a path.
fn growth(path: &PathView<'_>, s: u32) -> Growth {
    Growth {
        least: 2.max((path.shortest() + 1).saturating_sub(s)),
        most: path.longest() + 1 - s,
    }
}

impl MovesPaths for LensSubpath {
    fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal> {
        let t = path.camera_vertices();
        let s = path.edges + 1 - t;
        let u = key.stream(Purpose::PERTURB, 0).next_f64();
        Some(PathProposal::new([0, s], [growth(path, s).sample(t, u), s]))
    }

    /// A new start that scatters with a density before its last vertex is not one that could have been chosen.
    fn density(&self, way: &Way<'_>) -> f64 {
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
        growth(&way.from, s).probability(from, to) * way.to.share(to) * kept_light
    }
}
