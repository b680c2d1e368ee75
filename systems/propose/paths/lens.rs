//! `lens`: looks through a place of the film near the current one, follows the same kinds of mirrors and clear surfaces, and joins
//! the first matt or rough point that it comes to with the next point of the current path (Veach and Guibas 1997, section 4.2;
//! Veach 1997, §11.3.2).
//!
//! | setting | meaning | unit | default | others use |
//! |---|---|---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations, where it is suitable | | 2 | 1 |
//! | `smallest` | the smallest step on the film | pixels | 0.1 | 0.1 |
//! | `covered` | share of the film that a disc of the largest step covers | | 0.05 | 0.05 |
//!
//! Suitable for paths E S* D (D|L), and E S* L where a light with a size is seen. It spreads light that was found over the pixels
//! around; where paths behind the first matt point are hard to find, it is what makes pictures smooth.
//!
//! T(x→y): one strategy; steps on the film are as likely one way as the other.

use super::film_jump::{COVERED, SMALLEST, check_film_sizes, film_jump, film_jump_density, film_sizes};
use super::moves_paths::{MovesPaths, PathProposal, Way};
use super::view::PathView;
use crate::chain::StateClass;
use crate::path::DrawList;
use crate::path::whole::LENS_TRAIT;
use crate::path_systems;
use crate::plan::{Mutation, StateSpace, SystemPlan, TablePlan};
use crate::sampling::StreamKey;
use serde::{Deserialize, Serialize};

/// Settings of `lens`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LensPerturbation {
    /// How often it is tried, relative to the other mutations, where it is suitable.
    pub weight: f32,
    /// The smallest step on the film, in pixels.
    pub smallest: f32,
    /// Share of the film that a disc of the largest step covers.
    pub covered: f32,
}

impl Default for LensPerturbation {
    fn default() -> Self {
        Self {
            weight: 2.0,
            smallest: SMALLEST,
            covered: COVERED,
        }
    }
}

impl Mutation for LensPerturbation {
    const NAME: &'static str = "lens";
    const ABOUT: &'static str = "the part of the path at the camera, through a place of the film nearby";
    const SPACE: StateSpace = StateSpace::PATH;
    const SELECTIVE: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn check(&self) -> Result<(), String> {
        check_film_sizes(self.smallest, self.covered)
    }

    fn suitability(&self, state: StateClass) -> f32 {
        if state.traits() & LENS_TRAIT != 0 { 1.0 } else { 0.0 }
    }

    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        Some(Box::new(self.clone()))
    }

    fn systems(&self) -> Vec<SystemPlan> {
        path_systems!(Self, "lens":
            propose "the path is seen from a pixel nearby",
            steer "by way of the same kinds of surfaces",
            weigh "each way is as likely as its strategy")
    }

    fn columns(&self, tables: &mut [TablePlan]) {
        if let Some(chains) = tables.first_mut() {
            chains.column::<DrawList>("perturbed subpaths wait for a direction");
        }
    }
}

impl MovesPaths for LensPerturbation {
    fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal> {
        film_jump(path, film_sizes(path.scene, self.smallest, self.covered), key)
    }

    fn density(&self, way: &Way<'_>) -> f64 {
        film_jump_density(way)
    }
}
