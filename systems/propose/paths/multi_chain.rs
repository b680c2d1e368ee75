//! `multi_chain`: as `lens`, and on: where a matt or rough point is followed by a mirror or clear surface, it goes on near to where
//! the current path goes, and so from chain to chain of such surfaces, up to the first two neighbours that can be joined, or a light
//! that it meets (Veach and Guibas 1997, section 4.2; Veach 1997, §11.3.4).
//!
//! | setting | meaning | unit | default | others use |
//! |---|---|---|---|---|
//! | `weight` | how often it is tried, relative to the other mutations, where it is suitable | | 2 | 1 |
//! | `smallest` | the smallest step on the film | pixels | 0.1 | 0.1 |
//! | `covered` | share of the film that a disc of the largest step covers | | 0.05 | 0.05 |
//! | `smallest_angle` | the smallest change of a direction | degrees | 0.0001 | 0.0001 |
//! | `largest_angle` | the largest | degrees | 0.1 | 0.1 |
//!
//! Suitable for paths with several chains, such as a pool's floor seen through its surface. Of all perturbations it keeps the least
//! of a path and is turned down most often.
//!
//! T(x→y): one strategy; steps on the film and changes of directions are as likely one way as the other.

use super::film_jump::{COVERED, SMALLEST, check_film_sizes, film_jump, film_jump_density, film_sizes};
use super::moves_paths::{MovesPaths, PathProposal, Way};
use super::view::PathView;
use crate::chain::StateClass;
use crate::path::DrawList;
use crate::path::whole::{CHAIN_TRAIT, Sizes, tilt};
use crate::path_systems;
use crate::plan::{Mutation, StateSpace, SystemPlan, TablePlan};
use crate::sampling::{Purpose, StreamKey};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Settings of `multi_chain`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MultiChainPerturbation {
    /// How often it is tried, relative to the other mutations, where it is suitable.
    pub weight: f32,
    /// The smallest step on the film, in pixels.
    pub smallest: f32,
    /// Share of the film that a disc of the largest step covers.
    pub covered: f32,
    /// The smallest change of a direction, in degrees.
    pub smallest_angle: f32,
    /// The largest change of a direction, in degrees.
    pub largest_angle: f32,
}

impl Default for MultiChainPerturbation {
    fn default() -> Self {
        Self {
            weight: 2.0,
            smallest: SMALLEST,
            covered: COVERED,
            smallest_angle: 1e-4,
            largest_angle: 0.1,
        }
    }
}

impl Mutation for MultiChainPerturbation {
    const NAME: &'static str = "multi_chain";
    const ABOUT: &'static str = "the part of the path at the camera, chain by chain of mirrors and clear surfaces";
    const SPACE: StateSpace = StateSpace::PATH;
    const SELECTIVE: bool = true;

    fn weight(&self) -> f32 {
        self.weight
    }

    fn check(&self) -> Result<(), String> {
        check_film_sizes(self.smallest, self.covered)?;
        let Self {
            smallest_angle,
            largest_angle,
            ..
        } = *self;
        if smallest_angle > 0.0 && smallest_angle < largest_angle && largest_angle <= 180.0 {
            Ok(())
        } else {
            Err(format!(
                "`smallest_angle` and `largest_angle` are degrees above 0, up to 180, the second larger than the first, not \
                 {smallest_angle} and {largest_angle}"
            ))
        }
    }

    fn suitability(&self, state: StateClass) -> f32 {
        if state.traits() & CHAIN_TRAIT != 0 { 1.0 } else { 0.0 }
    }

    fn moves_paths(&self) -> Option<Box<dyn MovesPaths>> {
        Some(Box::new(self.clone()))
    }

    fn systems(&self) -> Vec<SystemPlan> {
        path_systems!(Self, "multi_chain":
            propose "the path is seen from a pixel nearby",
            steer "and goes on nearby behind every chain",
            weigh "each way is as likely as its strategy")
    }

    fn columns(&self, tables: &mut [TablePlan]) {
        if let Some(chains) = tables.first_mut() {
            chains.column::<DrawList>("perturbed subpaths wait for a direction");
        }
    }
}

impl MovesPaths for MultiChainPerturbation {
    fn propose(&self, path: &PathView<'_>, key: StreamKey) -> Option<PathProposal> {
        film_jump(path, film_sizes(path.scene, self.smallest, self.covered), key)
    }

    fn near(&self, direction: Vec3, key: StreamKey, depth: u32) -> Vec3 {
        let angles = Sizes {
            smallest: f64::from(self.smallest_angle).to_radians(),
            largest: f64::from(self.largest_angle).to_radians(),
        };
        let mut stream = key.stream(Purpose::PERTURB, depth);
        tilt(direction, angles.sample(stream.next_f64()), stream.next_f64())
    }

    fn density(&self, way: &Way<'_>) -> f64 {
        film_jump_density(way)
    }
}
