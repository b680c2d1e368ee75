//! One chain of a render, alone: what it does there it does here, bit for bit, since its random numbers are keyed by its own
//! number, and its seed is that of its group's whole bootstrap.

use super::chain_run::{ChainRun, Tile};
use super::chains::{insert_light, state_blocks};
use super::group::Seed;
use super::tile_world::TileWorld;
use super::{RenderError, Start};
use crate::chain::CommonDensity;
use crate::film::BlockGrid;
use crate::plan::{ChainPlan, Plan, TilePlan};
use crate::scene::Scene;
use crate::systems::Run;
use crate::systems::chains::Mutations;
use crate::systems::list::{SPLAT_LISTS, SPLAT_SAMPLES, SPLAT_STATES};
use crate::systems::tile::{SceneRef, StrategiesRef};
use bevy_ecs::world::World;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A chain of a render, or a pixel whose samples are independent, in a world of one lane group.
pub struct LoneChain {
    /// The chain's world: its columns are number 0 of every table's.
    pub world: TileWorld,
    /// The blocks that states are classed by.
    pub blocks: BlockGrid,
    chain: u32,
    start: Option<LoneStart>,
}

/// How a chain came to its first state.
#[derive(Clone, Debug)]
pub struct LoneStart {
    /// Number of its group.
    pub group: u32,
    /// Chains of each group.
    pub chains_per_group: u32,
    /// What the group's bootstrap came to.
    pub start: Start,
    /// The sample that it starts from: the chain, counted inside the group, that drew it, and the round. None where no sample
    /// has any light.
    pub sample: Option<(u32, u64)>,
}

impl LoneChain {
    /// Chain number `chain` of the render of `scene` by `plan` with `seed`: at its first state, for which the bootstrap of its
    /// group is run on `threads` threads; or before any sample, where samples are independent. `progress` hears the share of
    /// the bootstrap that is done.
    ///
    /// # Errors
    /// No such chain, threads that cannot be started, or an interruption.
    pub fn new(
        scene: &Arc<Scene>,
        plan: &Plan,
        seed: u64,
        chain: u32,
        threads: usize,
        interrupt: &AtomicBool,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, RenderError> {
        let chains = plan.chains.as_ref();
        let count = chains.map_or(scene.pixel_count(), |chains| chains.counts.total());
        if chain >= count {
            return Err(RenderError::NoSuchChain {
                chain,
                technique: plan.technique.name(),
                last: count.saturating_sub(1),
                samples_pixels: chains.is_none(),
            });
        }
        let blocks = state_blocks(scene);
        let (world, start) = match chains {
            Some(chains) => {
                let (world, start) = of_chains(scene, plan, chains, seed, chain, threads, interrupt, progress)?;
                (world, Some(start))
            }
            None => (of_samples(scene, plan, seed), None),
        };
        Ok(Self {
            world,
            blocks,
            chain,
            start,
        })
    }

    /// Takes step number `step`. A chain's steps have to be taken in order, from 0 on; independent samples in any.
    pub fn step(&mut self, step: u64) {
        self.world.run_once(Run::Step, self.chain, 1, step);
    }

    /// How the chain came to its first state; none where samples are independent.
    #[must_use]
    pub const fn start(&self) -> Option<&LoneStart> {
        self.start.as_ref()
    }
}

/// A world for the samples of any one pixel.
fn of_samples(scene: &Arc<Scene>, plan: &Plan, seed: u64) -> TileWorld {
    TileWorld::new(&for_one_chain(&plan.tile), seed, |world| {
        world.insert_resource(SceneRef(Arc::clone(scene)));
        if let Some(strategies) = plan.strategies {
            world.insert_resource(StrategiesRef(strategies));
        }
    })
}

/// A world of one chain at its first state.
fn of_chains(
    scene: &Arc<Scene>,
    plan: &Plan,
    chains: &ChainPlan,
    seed: u64,
    chain: u32,
    threads: usize,
    interrupt: &AtomicBool,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<(TileWorld, LoneStart), RenderError> {
    let blocks = Arc::new(state_blocks(scene));
    let insert = |world: &mut World, _: usize| insert_light(world, scene, &blocks, plan);
    let counts = chains.counts;
    let group = chain / counts.chains;
    let mut run = ChainRun::of_groups(
        group..group + 1,
        plan.tile.clone(),
        chains.clone(),
        seed,
        threads,
        insert,
    )?;
    let seeds = run.draw_seeds(interrupt, progress)?;
    let seeds = seeds.get(group as usize);
    let chosen: Option<Seed> = seeds.and_then(|seeds| seeds.get((chain % counts.chains) as usize).copied());
    let start = run.starts().get(group as usize).cloned().unwrap_or_default();
    drop(run);
    let mutations = Mutations::new(&chains.mutations);
    let mut lone = for_one_chain(&plan.tile);
    if let Some(table) = lone.tables.first_mut() {
        // Nothing but what looks at densities reads this column.
        table.column::<CommonDensity>("densities are looked at whole");
    }
    let mut tile = Tile::new(&lone, chains, &mutations, seed, chain..chain + 1, &insert);
    if let Some(chosen) = chosen {
        tile.seed(&[chosen], seed, counts.chains);
    }
    tile.forget_start(chains.mutations.len());
    let start = LoneStart {
        group,
        chains_per_group: counts.chains,
        start,
        sample: chosen.map(|seed| (seed.chain, seed.round)),
    };
    progress(1.0);
    Ok((tile.world, start))
}

/// The tile for one chain, without the systems that add to films: nobody looks at what one chain adds.
fn for_one_chain(tile: &TilePlan) -> TilePlan {
    let mut tile = tile.clone().without_layers().for_one_chain();
    tile.systems
        .retain(|system| ![SPLAT_SAMPLES, SPLAT_LISTS, SPLAT_STATES].contains(&system.spec));
    tile
}
