//! What all renders have in common, whether their samples are independent or states of chains.

use super::{ChainRender, DirectLight, LayerFinding, TileWorld};
use crate::film::{BlockGrid, Picture, Tally};
use crate::plan::{Plan, SystemSpec, TilePlan};
use crate::scene::Scene;
use crate::stats::error::PictureError;
use crate::systems::SystemCost;
use crate::systems::tile::Counters;
use std::sync::Arc;
use std::time::Duration;

/// A render under way.
pub trait Rendering {
    /// The plan that its worlds were built from.
    fn plan(&self) -> &Plan;
    /// The scene.
    fn scene(&self) -> &Arc<Scene>;
    /// Steps that every chain has taken.
    fn steps(&self) -> u64;
    /// Chains of the whole render.
    fn chains(&self) -> u32;
    /// Threads at work.
    fn threads(&self) -> usize;
    /// Tiles of the whole render.
    fn tile_count(&self) -> usize;
    /// Runs `steps` more steps of every chain, all tiles to the same step; `done` hears of every tile that has finished,
    /// by its number of samples or mutations.
    fn burst(&mut self, steps: u64, done: &(dyn Fn(u64) + Sync));
    /// What all worlds have counted.
    fn counters(&self) -> Counters;
    /// What every system has cost, summed over threads, in the order in which systems run.
    fn costs(&self) -> Vec<SystemCost>;
    /// Wall time that threads have spent in steps, summed over them.
    fn busy_time(&self) -> Duration;
    /// The picture so far, with its standard errors.
    fn picture(&self) -> Picture;
    /// The picture's error so far, relative to its mean: the root mean square over block means of [`error_blocks`] and
    /// channels, with a 95 % interval. `None` while nothing is known of it, or of a black picture.
    fn error(&self) -> Option<PictureError>;
    /// The share of proposals that chains have taken; `None` without chains.
    fn acceptance(&self) -> Option<f64> {
        None
    }
    /// The layers that light is split into, if it is; their light sums to that of the [`picture`](Self::picture).
    fn layers(&self) -> Vec<LayerFinding>;
    /// The render so far, to be taken up by [`resume`](super::resume).
    fn save(&self) -> Vec<u8>;
    /// What films could not take as it was.
    fn tally(&self) -> Tally;
    /// The render itself, if it is one with chains.
    fn as_chains(&self) -> Option<&ChainRender> {
        None
    }
    /// Direct light, where it is rendered apart from all other: what it counted and cost is not among the above, but for the
    /// picture, its error and what films could not take.
    fn direct(&self) -> Option<&DirectLight> {
        None
    }
    /// Lets `look` see every world, but for those of direct light.
    fn for_each_world(&self, look: &mut dyn FnMut(usize, &mut TileWorld));
}

/// Blocks along a side of the film that errors are judged by. Single pixels of chains are mostly black, and what is left is
/// far from normal; means over blocks are near enough to it for intervals.
const ERROR_BLOCKS_PER_SIDE: u32 = 16;

/// The blocks of a film that errors are judged by.
#[must_use]
pub fn error_blocks(scene: &Scene) -> BlockGrid {
    BlockGrid::new(scene.width, scene.height, ERROR_BLOCKS_PER_SIDE)
}

/// Adds the costs of several worlds up, in the order of the plan.
pub(super) fn merge_costs(plan: &TilePlan, worlds: impl Iterator<Item = Vec<SystemCost>>) -> Vec<SystemCost> {
    let mut total: Vec<SystemCost> = Vec::new();
    for cost in worlds.flatten() {
        match total.iter_mut().find(|sum| sum.spec == cost.spec) {
            Some(sum) => {
                sum.runs += cost.runs;
                sum.nanoseconds += cost.nanoseconds;
            }
            None => total.push(cost),
        }
    }
    let position = |spec: SystemSpec| plan.systems.iter().position(|system| system.spec == spec);
    total.sort_by_key(|cost| position(cost.spec));
    total
}
