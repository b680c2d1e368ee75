//! `lens_subpath`: another start of the path, from anywhere on the film, by way of mirrors and clear surfaces alone to the first
//! matt or rough point, which is joined to the next point of the current path (Veach and Guibas 1997, section 4.4; Veach 1997,
//! §11.3.3).
//!
//! | setting | meaning | default |
//! |---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations, where it is suitable | 0.5 |
//!
//! Suitable for paths E S* D (D|L); of those that see the light itself, E S* L, it makes nothing. It carries light that was found to all of the film that can see it, so that pixels
//! are visited about equally often. The number of mirrors and clear surfaces is what it comes to: were it chosen beforehand, near to
//! that of the current path, chains would be caught in light that comes by way of many, which is seldom, but seldom left too.
//!
//! T(x→y): the density of the one strategy, times the probability of stopping where it is joined, which is 1 but on surfaces that are
//! matt and mirror at once.

use super::moves_paths::{MovesPaths, PathProposal, Way};
use super::view::PathView;
use crate::chain::StateClass;
use crate::path::whole::LENS_TRAIT;
use crate::path_systems;
use crate::plan::{Mutation, StateSpace, SystemPlan};
use crate::sampling::StreamKey;
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

/// The most vertices that a subpath from the camera can have which is joined to `s` of a path.
fn most(path: &PathView<'_>, s: u32) -> u32 {
    path.longest() + 1 - s
}

impl MovesPaths for LensSubpath {
    fn propose(&self, path: &PathView<'_>, _: StreamKey) -> Option<PathProposal> {
        let s = path.edges + 1 - path.camera_vertices();
        // Where the lens sees the light itself, nothing would be kept.
        (s > 0).then(|| PathProposal {
            to_joint: true,
            ..PathProposal::new([0, s], [most(path, s), s])
        })
    }

    /// A new start that scatters with a density before its last vertex is not one that could have been drawn.
    fn density(&self, way: &Way<'_>) -> f64 {
        let s = way.kept[1];
        let t = way.to.edges + 1 - s;
        if way.from.camera_vertices() + s != way.from.edges + 1 || way.to.camera_vertices() != t {
            return 0.0;
        }
        if (1..t - 1).any(|i| !way.to.is_discrete(i)) {
            return 0.0;
        }
        let kept_light = if s == 1 { way.to.kept_light } else { 1.0 };
        // Where paths cannot be longer, it ends anyway.
        let stopping = if t == most(&way.to, s) {
            1.0
        } else {
            way.to.vertex(t - 1).stopping(way.to.scene)
        };
        way.to.share(t) * kept_light * stopping
    }
}
