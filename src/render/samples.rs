//! Independent samples under way: one tile world per thread, through which the tiles pass, since a step leaves nothing behind
//! in them.

use super::deal::deal;
use super::rendering::merge_costs;
use super::tile_world::{TileWorld, lock};
use super::{RenderError, thread_pool};
use crate::plan::TilePlan;
use crate::systems::SystemCost;
use crate::systems::tile::Counters;
use bevy_ecs::world::World;
use std::sync::Mutex;
use std::time::Duration;

/// Worlds, and the threads that run them.
pub(super) struct Samples {
    tile: TilePlan,
    chains: u32,
    worlds: Vec<Mutex<TileWorld>>,
    pool: rayon::ThreadPool,
    /// Steps that every chain has taken.
    pub(super) steps: u64,
}

impl Samples {
    /// Builds threads and their worlds for so many chains; no more threads than there are tiles. `insert` adds the resources
    /// that the systems read.
    pub(super) fn new(
        tile: &TilePlan,
        chains: u32,
        seed: u64,
        threads: usize,
        insert: impl Fn(&mut World),
    ) -> Result<Self, RenderError> {
        let tiles = chains.div_ceil(tile.size) as usize;
        let pool = thread_pool(threads.clamp(1, tiles))?;
        let world = |_| Mutex::new(TileWorld::new(tile, seed, &insert));
        let worlds = (0..pool.current_num_threads()).map(world).collect();
        Ok(Self {
            tile: tile.clone(),
            chains,
            worlds,
            pool,
            steps: 0,
        })
    }

    /// Runs `steps` more steps of every chain, the tiles dealt in the given order, which must name every tile once; others
    /// are passed over. `done` hears of every tile that has finished, by its number of samples.
    pub(super) fn burst(&mut self, steps: u64, order: &[usize], done: &(dyn Fn(u64) + Sync)) {
        let (tiles, range) = (self.tile_count(), self.steps..self.steps + steps);
        deal(&self.pool, order, &|tile, thread| {
            if tile < tiles {
                let first = tile as u32 * self.tile.size;
                let count = self.tile.size.min(self.chains - first);
                lock(&self.worlds[thread]).run(first, count, range.clone());
                done(u64::from(count) * steps);
            }
        });
        self.steps += steps;
    }

    /// Takes the samples from number `from` up to `to`, the latter excluded, where number i is step i / chains of chain
    /// i mod chains. `done` hears of every stretch of chains that has finished. [`steps`](Self::steps) does not count them.
    pub(super) fn take(&self, from: u64, to: u64, done: &(dyn Fn() + Sync)) {
        let chains = u64::from(self.chains);
        let steps_before = |number: u64, chain: u32| number.saturating_sub(u64::from(chain)).div_ceil(chains);
        // Between these, all chains take the same steps.
        let mut cuts = [0, (from % chains) as u32, (to % chains) as u32, self.chains];
        cuts.sort_unstable();
        let mut stretches = Vec::new();
        for (&begin, &end) in cuts.iter().zip(&cuts[1..]) {
            for first in (begin..end).step_by(self.tile.size as usize) {
                let steps = steps_before(from, first)..steps_before(to, first);
                if !steps.is_empty() {
                    stretches.push((first, self.tile.size.min(end - first), steps));
                }
            }
        }
        let order: Vec<usize> = (0..stretches.len()).collect();
        deal(&self.pool, &order, &|number, thread| {
            let (first, count, steps) = &stretches[number];
            lock(&self.worlds[thread]).run(*first, *count, steps.clone());
            done();
        });
    }

    /// Runs `steps` more steps of every chain.
    pub(super) fn burst_all(&mut self, steps: u64, done: &(dyn Fn(u64) + Sync)) {
        let order: Vec<usize> = (0..self.tile_count()).collect();
        self.burst(steps, &order, done);
    }

    /// Chains, each of which samples one pixel a step.
    pub(super) fn pixels(&self) -> f64 {
        f64::from(self.chains)
    }

    pub(super) fn tile_count(&self) -> usize {
        self.chains.div_ceil(self.tile.size) as usize
    }

    pub(super) fn threads(&self) -> usize {
        self.worlds.len()
    }

    pub(super) fn counters(&self) -> Counters {
        let sum = |sum: Counters, world: &Mutex<TileWorld>| sum.plus(lock(world).counters());
        self.worlds.iter().fold(Counters::default(), sum)
    }

    pub(super) fn costs(&self) -> Vec<SystemCost> {
        let costs = self.worlds.iter().map(|world| lock(world).profile().systems.clone());
        merge_costs(&self.tile, costs)
    }

    pub(super) fn busy_time(&self) -> Duration {
        self.worlds.iter().map(|world| lock(world).busy()).sum()
    }

    pub(super) fn for_each_world(&self, look: &mut dyn FnMut(usize, &mut TileWorld)) {
        for (thread, world) in self.worlds.iter().enumerate() {
            look(thread, &mut lock(world));
        }
    }
}
