//! Renders with Markov chains: a world for every tile, which keeps its chains' states, and groups that share nothing.

use super::deal::deal;
use super::group::{BootstrapSamples, Group, Seed};
use super::rendering::{Rendering, merge_costs};
use super::tile_world::{TileWorld, lock};
use super::RenderError;
use crate::chain::{BootstrapWeight, KeyChain, ProposedClass, StateClass};
use crate::film::{BlockGrid, FilmError, Picture, Tally, develop_groups};
use crate::path::{ChainKey, ChainTable};
use crate::plan::{ChainCounts, ChainPlan, Plan};
use crate::scene::Scene;
use crate::systems::chains::{ChainStatistics, GroupPlace, MutationLists, Mutations};
use crate::systems::tile::{Counters, FilmBlocks, GroupFilmRef, SceneRef};
use crate::systems::{Run, SystemCost};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Blocks along a side of the film that states are classed by.
const BLOCKS_PER_SIDE: u32 = 8;

/// A render with chains under way.
pub struct ChainRender {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The plan that the worlds were built from.
    pub plan: Plan,
    /// The groups.
    pub groups: Vec<Group>,
    /// The blocks that states are classed by.
    pub blocks: Arc<BlockGrid>,
    /// Wall time of the bootstrap.
    pub bootstrap_time: Duration,
    /// What systems cost in the bootstrap.
    pub bootstrap_costs: Vec<SystemCost>,
    chains: ChainPlan,
    seed: u64,
    pub(super) tiles: Vec<Mutex<Tile>>,
    pool: rayon::ThreadPool,
    pub(super) steps: u64,
}

/// A tile of chains and its world.
pub(super) struct Tile {
    pub(super) world: TileWorld,
    group: usize,
    /// Global number of its first chain.
    first_chain: u32,
    chains: u32,
}

impl ChainRender {
    /// Builds films, threads and worlds, and bootstraps every group: its chains then stand at their first states.
    ///
    /// # Errors
    /// Films that do not fit, threads that cannot be started, or a plan without chains.
    pub fn new(scene: Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Result<Self, RenderError> {
        Self::start(scene, plan, seed, threads, &AtomicBool::new(false), &|_| {})
    }

    /// [`new`](Self::new), telling `progress` the share of the bootstrap that is done, and giving up when `interrupt` is
    /// set.
    ///
    /// # Errors
    /// As [`new`](Self::new), and if it was interrupted.
    pub fn start(
        scene: Arc<Scene>,
        plan: Plan,
        seed: u64,
        threads: usize,
        interrupt: &AtomicBool,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, RenderError> {
        let mut render = Self::build(scene, plan, seed, threads)?;
        render.bootstrap(interrupt, progress)?;
        Ok(render)
    }

    /// Builds everything, without states yet.
    pub(super) fn build(scene: Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Result<Self, RenderError> {
        let Some(chains) = plan.chains.clone() else {
            return Err(RenderError::NoChains {
                technique: plan.technique.name(),
            });
        };
        let counts = chains.counts;
        let group = |_| Group::new(scene.width, scene.height);
        let groups = (0..counts.groups).map(group).collect::<Result<Vec<_>, FilmError>>()?;
        let tiles_per_group = counts.chains.div_ceil(plan.tile.size);
        let tile_count = tiles_per_group as usize * groups.len();
        let pool = super::thread_pool(threads.clamp(1, tile_count))?;
        let blocks = Arc::new(BlockGrid::new(scene.width, scene.height, BLOCKS_PER_SIDE));
        let mutations = Mutations::new(&chains.mutations);
        let build = |group: usize, first: u32| {
            let first_chain = group as u32 * counts.chains + first;
            let world = TileWorld::new(&plan.tile, seed, |world| {
                world.insert_resource(SceneRef(Arc::clone(&scene)));
                world.insert_resource(GroupFilmRef(Arc::clone(&groups[group].film)));
                world.insert_resource(FilmBlocks(Arc::clone(&blocks)));
                insert_chains(world, &chains, &mutations);
                world.insert_resource(GroupPlace {
                    group: group as u32,
                    first_chain: group as u32 * counts.chains,
                });
            });
            Mutex::new(Tile {
                world,
                group,
                first_chain,
                chains: plan.tile.size.min(counts.chains - first),
            })
        };
        // Neighbours in this order belong to different groups, so that threads seldom wait for the same film.
        let firsts = (0..tiles_per_group).map(|tile| tile * plan.tile.size);
        let tiles = firsts
            .flat_map(|first| (0..groups.len()).map(move |group| (group, first)))
            .map(|(group, first)| build(group, first))
            .collect();
        Ok(Self {
            scene,
            blocks,
            bootstrap_time: Duration::ZERO,
            bootstrap_costs: Vec::new(),
            seed,
            tiles,
            pool,
            groups,
            chains,
            plan,
            steps: 0,
        })
    }

    /// How many chains there are.
    #[must_use]
    pub const fn counts(&self) -> ChainCounts {
        self.chains.counts
    }

    /// The mutations and their numbers.
    #[must_use]
    pub const fn chain_plan(&self) -> &ChainPlan {
        &self.chains
    }

    /// The seed of all random numbers.
    #[must_use]
    pub const fn seed(&self) -> u64 {
        self.seed
    }

    /// Draws and weighs the samples of every group, resamples seeds among them, and draws those again as first states.
    fn bootstrap(&mut self, interrupt: &AtomicBool, progress: &(dyn Fn(f64) + Sync)) -> Result<(), RenderError> {
        let start = Instant::now();
        let counts = self.chains.counts;
        let samples = counts.rounds as usize * counts.chains as usize;
        let mut collected: Vec<BootstrapSamples> = vec![BootstrapSamples::default(); self.groups.len()];
        for group in &mut collected {
            group.weights.resize(samples, 0.0);
            group.classes.resize(samples, 0);
        }
        let order: Vec<usize> = (0..self.tiles.len()).collect();
        for round in 0..counts.rounds {
            if interrupt.load(Ordering::Relaxed) {
                return Err(RenderError::Interrupted);
            }
            progress(f64::from(round) / f64::from(counts.rounds));
            deal(&self.pool, &order, &|tile, _| {
                let mut tile = lock(&self.tiles[tile]);
                tile.run_once(Run::Bootstrap, u64::from(round));
            });
            for tile in &mut self.tiles {
                let tile = tile.get_mut().unwrap_or_else(std::sync::PoisonError::into_inner);
                let first = (round * counts.chains + tile.first_chain % counts.chains) as usize;
                let group = &mut collected[tile.group];
                let chains = tile.chains as usize;
                tile.world.read::<BootstrapWeight, ChainTable>(&mut group.weights[first..first + chains]);
                tile.world.read::<ProposedClass, ChainTable>(&mut group.classes[first..first + chains]);
            }
        }
        let seeds: Vec<Vec<Seed>> = (0_u32..)
            .zip(self.groups.iter_mut().zip(&collected))
            .map(|(number, (group, samples))| {
                group.settle(samples, self.seed, number * counts.chains, counts.chains)
            })
            .collect();
        deal(&self.pool, &order, &|tile, _| {
            let mut tile = lock(&self.tiles[tile]);
            let first = (tile.first_chain % counts.chains) as usize;
            let group_first = tile.first_chain - first as u32;
            let chosen = &seeds[tile.group];
            if let Some(chosen) = chosen.get(first..first + tile.chains as usize) {
                tile.seed(chosen, self.seed, group_first);
            }
        });
        self.bootstrap_costs = self.costs();
        for tile in &mut self.tiles {
            let tile = tile.get_mut().unwrap_or_else(std::sync::PoisonError::into_inner);
            tile.world.reset_costs();
            tile.world.world_mut().insert_resource(ChainStatistics::new(self.chains.mutations.len()));
            let kept = tile.world.counters();
            tile.world.world_mut().insert_resource(Counters {
                non_finite: kept.non_finite,
                ..Counters::default()
            });
        }
        self.bootstrap_time = start.elapsed();
        progress(1.0);
        Ok(())
    }

    /// The factor that turns a group's sums into radiance: b, spread over the pixels, for each step of each chain.
    #[must_use]
    pub fn scale(&self, group: usize) -> f64 {
        let states = self.steps as f64 * f64::from(self.chains.counts.chains);
        let pixels = f64::from(self.scene.pixel_count());
        if states > 0.0 {
            self.groups[group].normalization.b * pixels / states
        } else {
            0.0
        }
    }

    /// Mutations per pixel after `steps` steps.
    #[must_use]
    pub fn mutations_per_pixel(&self, steps: u64) -> f64 {
        steps as f64 * f64::from(self.chains.counts.total()) / f64::from(self.scene.pixel_count())
    }

    /// The steps that come nearest to so many mutations per pixel, at least one.
    #[must_use]
    pub fn steps_for(&self, mutations_per_pixel: f64) -> u64 {
        let mutations = mutations_per_pixel * f64::from(self.scene.pixel_count());
        (mutations / f64::from(self.chains.counts.total())).round().max(1.0) as u64
    }

    /// What all tiles have tried and where they have been.
    #[must_use]
    pub fn statistics(&self) -> ChainStatistics {
        let mut sum = ChainStatistics::new(self.chains.mutations.len());
        self.statistics_by_group().iter().for_each(|group| sum.add(group));
        sum
    }

    /// [`statistics`](Self::statistics), group by group.
    #[must_use]
    pub fn statistics_by_group(&self) -> Vec<ChainStatistics> {
        let mut groups = vec![ChainStatistics::new(self.chains.mutations.len()); self.groups.len()];
        for tile in &self.tiles {
            let tile = lock(tile);
            groups[tile.group].add(tile.world.world().resource::<ChainStatistics>());
        }
        groups
    }

    /// [`burst`](Rendering::burst) with the tiles dealt in the given order, which must name every tile once; others are
    /// passed over.
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
}

/// Inserts what the core of chains reads.
pub(crate) fn insert_chains(world: &mut bevy_ecs::world::World, chains: &ChainPlan, mutations: &Mutations) {
    world.insert_resource(mutations.clone());
    world.insert_resource(MutationLists::default());
    world.insert_resource(ChainStatistics::new(chains.mutations.len()));
    for (number, planned) in chains.mutations.iter().enumerate() {
        planned.mutation.register(number, world);
    }
}

impl Tile {
    fn run_once(&mut self, run: Run, step: u64) {
        self.world.run_once(run, self.first_chain, self.chains, step);
    }

    /// Draws the chosen samples again and takes them as the chains' first states.
    fn seed(&mut self, chosen: &[Seed], seed: u64, group_first: u32) {
        let keys: Vec<u64> = chosen.iter().map(|s| s.key(seed, group_first).bits()).collect();
        let chains: Vec<u32> = chosen.iter().map(|s| group_first + s.chain).collect();
        self.world.write::<ChainKey, ChainTable>(&keys);
        self.world.write::<KeyChain, ChainTable>(&chains);
        self.run_once(Run::Seed, 0);
        self.world.clear::<crate::path::Decisions, ChainTable>();
    }
}

impl Rendering for ChainRender {
    fn plan(&self) -> &Plan {
        &self.plan
    }

    fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn chains(&self) -> u32 {
        self.chains.counts.total()
    }

    fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    fn tile_count(&self) -> usize {
        self.tiles.len()
    }

    fn burst(&mut self, steps: u64, done: &(dyn Fn(u64) + Sync)) {
        let order: Vec<usize> = (0..self.tiles.len()).collect();
        self.burst_in_order(steps, &order, done);
    }

    fn counters(&self) -> Counters {
        let sum = |sum: Counters, tile: &Mutex<Tile>| sum.plus(lock(tile).world.counters());
        self.tiles.iter().fold(Counters::default(), sum)
    }

    fn costs(&self) -> Vec<SystemCost> {
        merge_costs(&self.plan, self.tiles.iter().map(|tile| lock(tile).world.profile().systems.clone()))
    }

    fn busy_time(&self) -> Duration {
        self.tiles.iter().map(|tile| lock(tile).world.busy()).sum()
    }

    fn picture(&self) -> Picture {
        let films: Vec<_> = self.groups.iter().map(|group| lock(&group.film)).collect();
        let films: Vec<_> = films.iter().map(|film| &**film).collect();
        let scales: Vec<f64> = (0..films.len()).map(|group| self.scale(group)).collect();
        let weight = self.mutations_per_pixel(self.steps) as f32;
        // All films are of the scene's size, and there is a scale for each.
        develop_groups(&films, &scales, weight).unwrap_or_default()
    }

    fn tally(&self) -> Tally {
        let mut sum = Tally::default();
        self.groups.iter().for_each(|group| sum.add(&lock(&group.film).tally()));
        sum
    }

    fn as_chains(&self) -> Option<&ChainRender> {
        Some(self)
    }

    fn for_each_world(&self, look: &mut dyn FnMut(usize, &mut TileWorld)) {
        for (number, tile) in self.tiles.iter().enumerate() {
            look(number, &mut lock(tile).world);
        }
    }
}

/// The state classes of a chain's statistics, for reports.
#[must_use]
pub fn class_name(blocks: &BlockGrid, class: usize) -> String {
    if class < StateClass::BLOCKS {
        return blocks.name(class);
    }
    let length = class - StateClass::BLOCKS;
    if length < StateClass::LENGTHS {
        let more = if length + 1 == StateClass::LENGTHS { " or more" } else { "" };
        return format!("length {length}{more}");
    }
    let signature = crate::chain::Signature::of_number(length - StateClass::LENGTHS);
    format!("signature {}", signature.name())
}
