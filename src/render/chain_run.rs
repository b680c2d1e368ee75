//! Markov chains of any kind under way: a world for every tile, which keeps its chains' states, in groups that share
//! nothing. What states are is the plan's business: light paths in [`ChainRender`](super::ChainRender), anything in a
//! program that brings its own.

use super::RenderError;
use super::deal::deal;
use super::group::{BootstrapSamples, Seed, Start};
use super::rendering::merge_costs;
use super::tile_world::{TileWorld, lock};
use crate::chain::{BootstrapWeight, KeyChain, Normalization, ProposedClass};
use crate::path::{ChainKey, ChainTable, Decisions};
use crate::plan::{ChainCounts, ChainPlan, TilePlan};
use crate::systems::chains::{ChainStatistics, GroupPlace, MutationLists, Mutations, WeightTally, weight_unit};
use crate::systems::tile::Counters;
use crate::systems::{Run, SystemCost};
use bevy_ecs::world::World;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Chains under way, on threads of their own.
pub struct ChainRun {
    chains: ChainPlan,
    tile: TilePlan,
    seed: u64,
    /// The groups that this run has tiles of.
    groups: Range<u32>,
    pub(super) tiles: Vec<Mutex<Tile>>,
    pool: rayon::ThreadPool,
    pub(super) steps: u64,
    pub(super) starts: Vec<Start>,
    bootstrap_time: Duration,
    bootstrap_costs: Vec<SystemCost>,
}

/// A tile of chains and its world.
pub(super) struct Tile {
    pub(super) world: TileWorld,
    group: usize,
    /// Global number of its first chain.
    first_chain: u32,
    chains: u32,
}

impl ChainRun {
    /// Builds the worlds of all groups, on `threads` threads: `insert` adds to each the resources that its systems read,
    /// beside those of the core; it is told the number of the world's group. No chain has a state before
    /// [`bootstrap`](Self::bootstrap).
    ///
    /// # Errors
    /// Threads that cannot be started.
    pub fn new(
        tile: TilePlan,
        chains: ChainPlan,
        seed: u64,
        threads: usize,
        insert: impl Fn(&mut World, usize),
    ) -> Result<Self, RenderError> {
        let groups = 0..chains.counts.groups;
        Self::of_groups(groups, tile, chains, seed, threads, insert)
    }

    /// [`new`](Self::new) with the tiles of some groups only. Groups share nothing, so these run as they would among all.
    ///
    /// # Errors
    /// Threads that cannot be started.
    pub fn of_groups(
        groups: Range<u32>,
        tile: TilePlan,
        chains: ChainPlan,
        seed: u64,
        threads: usize,
        insert: impl Fn(&mut World, usize),
    ) -> Result<Self, RenderError> {
        let counts = chains.counts;
        let groups = groups.start.min(counts.groups)..groups.end.min(counts.groups);
        let tiles_per_group = counts.chains.div_ceil(tile.size);
        let pool = super::thread_pool(threads.clamp(1, (tiles_per_group as usize * groups.len()).max(1)))?;
        let mutations = Mutations::new(&chains.mutations);
        let build = |group: u32, first: u32| {
            let range = group * counts.chains + first..group * counts.chains + counts.chains.min(first + tile.size);
            Mutex::new(Tile::new(&tile, &chains, &mutations, seed, range, &insert))
        };
        // Neighbours in this order belong to different groups, so that threads seldom wait for the same film.
        let firsts = (0..tiles_per_group).map(|number| number * tile.size);
        let places = firsts.flat_map(|first| groups.clone().map(move |group| (group, first)));
        let tiles = places.map(|(group, first)| build(group, first)).collect();
        Ok(Self {
            starts: vec![Start::default(); counts.groups as usize],
            chains,
            tile,
            seed,
            groups,
            tiles,
            pool,
            steps: 0,
            bootstrap_time: Duration::ZERO,
            bootstrap_costs: Vec::new(),
        })
    }

    /// Draws and weighs the samples of every group, resamples seeds among them, and draws those again as first states.
    /// `progress` hears the share that is done.
    ///
    /// # Errors
    /// [`RenderError::Interrupted`] once `interrupt` is set.
    pub fn bootstrap(&mut self, interrupt: &AtomicBool, progress: &(dyn Fn(f64) + Sync)) -> Result<(), RenderError> {
        let start = Instant::now();
        let counts = self.chains.counts;
        let seeds = self.draw_seeds(interrupt, progress)?;
        let order: Vec<usize> = (0..self.tiles.len()).collect();
        deal(&self.pool, &order, &|tile, _| {
            let mut tile = lock(&self.tiles[tile]);
            let first = tile.first_chain % counts.chains;
            let chosen = seeds[tile.group].get(first as usize..(first + tile.chains) as usize);
            if let Some(chosen) = chosen {
                tile.seed(chosen, self.seed, counts.chains);
            }
        });
        self.bootstrap_costs = self.costs();
        let mutations = self.chains.mutations.len();
        for tile in &mut self.tiles {
            let tile = tile.get_mut().unwrap_or_else(PoisonError::into_inner);
            tile.forget_start(mutations);
        }
        self.set_units();
        self.bootstrap_time = start.elapsed();
        progress(1.0);
        Ok(())
    }

    /// Draws and weighs the samples of every group, and chooses among them a seed for each of its chains: by group, in the
    /// order of its chains; none for a group without light, or one that is not here.
    ///
    /// # Errors
    /// [`RenderError::Interrupted`] once `interrupt` is set.
    pub(super) fn draw_seeds(
        &mut self,
        interrupt: &AtomicBool,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Vec<Vec<Seed>>, RenderError> {
        let counts = self.chains.counts;
        let samples = counts.rounds as usize * counts.chains as usize;
        let mut collected = vec![BootstrapSamples::default(); counts.groups as usize];
        for group in self.groups.clone() {
            collected[group as usize] = BootstrapSamples::new(samples);
        }
        let order: Vec<usize> = (0..self.tiles.len()).collect();
        for round in 0..counts.rounds {
            if interrupt.load(Ordering::Relaxed) {
                return Err(RenderError::Interrupted);
            }
            progress(f64::from(round) / f64::from(counts.rounds));
            deal(&self.pool, &order, &|tile, _| {
                lock(&self.tiles[tile]).run_once(Run::Bootstrap, u64::from(round));
            });
            for tile in &mut self.tiles {
                let tile = tile.get_mut().unwrap_or_else(PoisonError::into_inner);
                let first = (round * counts.chains + tile.first_chain % counts.chains) as usize;
                let (group, chains) = (&mut collected[tile.group], tile.chains as usize);
                let place = first..first + chains;
                tile.world
                    .read::<BootstrapWeight, ChainTable>(&mut group.weights[place.clone()]);
                tile.world.read::<ProposedClass, ChainTable>(&mut group.classes[place]);
            }
        }
        let mut seeds = vec![Vec::new(); counts.groups as usize];
        for group in self.groups.clone() {
            let samples = &collected[group as usize];
            let (start, chosen) = Start::from_samples(samples, self.seed, group * counts.chains, counts.chains);
            self.starts[group as usize] = start;
            seeds[group as usize] = chosen;
        }
        Ok(seeds)
    }

    /// Tells every tile in which units its group's weights are added up.
    pub(super) fn set_units(&mut self) {
        for tile in &mut self.tiles {
            let tile = tile.get_mut().unwrap_or_else(PoisonError::into_inner);
            let b = self.starts[tile.group].normalization.b;
            tile.world.world_mut().resource_mut::<GroupPlace>().unit = weight_unit(b);
        }
    }

    /// b of every group: the mean weight of its bootstrap's samples and of all independent proposals since. Each has the
    /// true b for its expectation.
    #[must_use]
    pub fn normalizations(&self) -> Vec<f64> {
        let mut tallies = vec![WeightTally::default(); self.starts.len()];
        for tile in &self.tiles {
            let tile = lock(tile);
            let more = tile.world.world().resource::<ChainStatistics>().independent;
            let sum = &mut tallies[tile.group];
            (sum.sum, sum.count) = (sum.sum.saturating_add(more.sum), sum.count + more.count);
        }
        let b = |(start, tally): (&Start, &WeightTally)| {
            let Normalization { b, samples, .. } = start.normalization;
            tally.mean_with(b, samples, weight_unit(b))
        };
        self.starts.iter().zip(&tallies).map(b).collect()
    }

    /// Runs `steps` more steps of every chain, the tiles dealt in the given order, which must name every tile once; others
    /// are passed over. `done` hears of every tile that has finished, by its number of mutations.
    pub fn burst_in_order(&mut self, steps: u64, order: &[usize], done: &(dyn Fn(u64) + Sync)) {
        let range = self.steps..self.steps + steps;
        deal(&self.pool, order, &|tile, _| {
            let Some(tile) = self.tiles.get(tile) else { return };
            let mut tile = lock(tile);
            let (first, chains) = (tile.first_chain, tile.chains);
            tile.world.run(first, chains, range.clone());
            done(u64::from(chains) * steps);
        });
        self.steps += steps;
    }

    /// Runs `steps` more steps of every chain.
    pub fn burst(&mut self, steps: u64, done: &(dyn Fn(u64) + Sync)) {
        let order: Vec<usize> = (0..self.tiles.len()).collect();
        self.burst_in_order(steps, &order, done);
    }

    /// How many chains there are.
    #[must_use]
    pub const fn counts(&self) -> ChainCounts {
        self.chains.counts
    }

    /// The mutations by number, and how many chains there are.
    #[must_use]
    pub const fn chains(&self) -> &ChainPlan {
        &self.chains
    }

    /// The plan that the worlds were built from.
    #[must_use]
    pub const fn tile_plan(&self) -> &TilePlan {
        &self.tile
    }

    /// The seed of all random numbers.
    #[must_use]
    pub const fn seed(&self) -> u64 {
        self.seed
    }

    /// Steps that every chain has taken.
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// Threads at work.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Tiles of all groups.
    #[must_use]
    pub fn tile_count(&self) -> usize {
        self.tiles.len()
    }

    /// What the bootstraps of the groups came to, group by group.
    #[must_use]
    pub fn starts(&self) -> &[Start] {
        &self.starts
    }

    /// Wall time of the bootstrap.
    #[must_use]
    pub const fn bootstrap_time(&self) -> Duration {
        self.bootstrap_time
    }

    /// What systems cost in the bootstrap.
    #[must_use]
    pub fn bootstrap_costs(&self) -> &[SystemCost] {
        &self.bootstrap_costs
    }

    /// What all tiles have counted.
    #[must_use]
    pub fn counters(&self) -> Counters {
        let sum = |sum: Counters, tile: &Mutex<Tile>| sum.plus(lock(tile).world.counters());
        self.tiles.iter().fold(Counters::default(), sum)
    }

    /// What every system has cost in steps, summed over threads, in the order in which systems run.
    #[must_use]
    pub fn costs(&self) -> Vec<SystemCost> {
        let costs = |tile: &Mutex<Tile>| lock(tile).world.profile().systems.clone();
        merge_costs(&self.tile, self.tiles.iter().map(costs))
    }

    /// Wall time that threads have spent in steps, summed over them.
    #[must_use]
    pub fn busy_time(&self) -> Duration {
        self.tiles.iter().map(|tile| lock(tile).world.busy()).sum()
    }

    /// What the tiles have tried and where they have been, group by group.
    #[must_use]
    pub fn statistics_by_group(&self) -> Vec<ChainStatistics> {
        let empty = ChainStatistics::new(self.chains.mutations.len());
        let mut groups = vec![empty; self.starts.len()];
        for tile in &self.tiles {
            let tile = lock(tile);
            groups[tile.group].add(tile.world.world().resource::<ChainStatistics>());
        }
        groups
    }

    /// What all tiles have tried and where they have been.
    #[must_use]
    pub fn statistics(&self) -> ChainStatistics {
        let mut sum = ChainStatistics::new(self.chains.mutations.len());
        self.statistics_by_group().iter().for_each(|group| sum.add(group));
        sum
    }

    /// Lets `look` see every tile's world, with the global numbers of its chains.
    pub fn for_each_tile(&self, look: &mut dyn FnMut(std::ops::Range<u32>, &mut TileWorld)) {
        for tile in &self.tiles {
            let mut tile = lock(tile);
            let chains = tile.first_chain..tile.first_chain + tile.chains;
            look(chains, &mut tile.world);
        }
    }
}

/// Inserts what the core of chains reads.
fn insert_core(world: &mut World, chains: &ChainPlan, mutations: &Mutations) {
    world.insert_resource(mutations.clone());
    world.insert_resource(MutationLists::default());
    world.insert_resource(ChainStatistics::new(chains.mutations.len()));
    for (number, planned) in chains.mutations.iter().enumerate() {
        planned.mutation.register(number, world);
    }
}

impl Tile {
    /// The world of the chains with these global numbers, which must be of one group; `insert` is told which.
    pub(super) fn new(
        plan: &TilePlan,
        chains: &ChainPlan,
        mutations: &Mutations,
        seed: u64,
        range: Range<u32>,
        insert: &dyn Fn(&mut World, usize),
    ) -> Self {
        let group = range.start / chains.counts.chains;
        let place = GroupPlace {
            group,
            first_chain: group * chains.counts.chains,
            unit: 1.0,
        };
        let world = TileWorld::new(plan, seed, |world| {
            insert_core(world, chains, mutations);
            world.insert_resource(place);
            insert(world, group as usize);
        });
        Self {
            world,
            group: group as usize,
            first_chain: range.start,
            chains: range.end - range.start,
        }
    }

    pub(super) fn run_once(&mut self, run: Run, step: u64) {
        self.world.run_once(run, self.first_chain, self.chains, step);
    }

    /// Draws the chosen samples again and takes them as the chains' first states. Groups have `chains_per_group` chains.
    pub(super) fn seed(&mut self, chosen: &[Seed], seed: u64, chains_per_group: u32) {
        let group_first = self.group as u32 * chains_per_group;
        let keys: Vec<u64> = chosen.iter().map(|s| s.key(seed, group_first).bits()).collect();
        let chains: Vec<u32> = chosen.iter().map(|s| group_first + s.chain).collect();
        self.world.write::<ChainKey, ChainTable>(&keys);
        self.world.write::<KeyChain, ChainTable>(&chains);
        self.run_once(Run::Seed, 0);
    }

    /// Starts counting anew: what the bootstrap counted is not what steps count, but for what went wrong in it.
    pub(super) fn forget_start(&mut self, mutations: usize) {
        self.world.reset_costs();
        self.world.clear::<Decisions, ChainTable>();
        let counted = self.world.counters();
        let world = self.world.world_mut();
        world.insert_resource(ChainStatistics::new(mutations));
        world.insert_resource(Counters {
            non_finite: counted.non_finite,
            ..Counters::default()
        });
    }
}
