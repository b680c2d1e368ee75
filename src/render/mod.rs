//! Rendering: tiles built from a plan, dealt to threads, burst by burst.

mod built;
mod driver;
mod tile_world;

pub use built::{Built, BuiltColumn, BuiltTable, short};
pub use driver::{Budget, Outcome, Progress, Stop, drive};
pub use tile_world::TileWorld;

use crate::film::{Film, FilmError};
use crate::plan::{Plan, SystemSpec};
use crate::scene::Scene;
use crate::systems::SystemCost;
use crate::systems::tile::{Counters, FilmRef, SceneRef};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Why a render cannot start.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum RenderError {
    /// The film cannot be made.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Film(#[from] FilmError),
    /// The operating system refused threads.
    #[error("cannot start {threads} threads")]
    #[diagnostic(help("ask for fewer with --threads"))]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the operating system said.
        source: rayon::ThreadPoolBuildError,
    },
}

/// A render under way: the film, and one tile world per thread through which the tiles pass.
///
/// Independent samples leave nothing behind in a tile, so a few worlds serve any number of tiles. What a tile adds to
/// the film depends on its chains and steps alone, and the film's sums on no order: so the picture is a function of
/// scene, settings, seed and steps.
pub struct Render {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The plan that the worlds were built from.
    pub plan: Plan,
    /// The film.
    pub film: Arc<Film>,
    worlds: Vec<Mutex<TileWorld>>,
    pool: rayon::ThreadPool,
    steps: u64,
}

impl Render {
    /// Builds the film, the threads and their worlds; no more threads than there are tiles.
    ///
    /// # Errors
    /// A film that does not fit, or threads that cannot be started.
    pub fn new(scene: Arc<Scene>, plan: Plan, seed: u64, threads: usize) -> Result<Self, RenderError> {
        let film = Arc::new(Film::new(scene.width, scene.height, scene.lights.max_radiance())?);
        let tiles = scene.pixel_count().div_ceil(plan.tile.size) as usize;
        let threads = threads.clamp(1, tiles);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|source| RenderError::Threads { threads, source })?;
        let world = |_| {
            Mutex::new(TileWorld::new(&plan.tile, seed, |world| {
                world.insert_resource(SceneRef(Arc::clone(&scene)));
                world.insert_resource(FilmRef(Arc::clone(&film)));
            }))
        };
        let worlds = (0..pool.current_num_threads()).map(world).collect();
        Ok(Self {
            scene,
            plan,
            film,
            worlds,
            pool,
            steps: 0,
        })
    }

    /// Steps that every chain has taken.
    #[must_use]
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// Threads at work.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.worlds.len()
    }

    /// Chains of the whole render: one per pixel.
    #[must_use]
    pub fn chains(&self) -> u32 {
        self.scene.pixel_count()
    }

    /// Tiles of the whole render.
    #[must_use]
    pub fn tile_count(&self) -> usize {
        self.chains().div_ceil(self.plan.tile.size) as usize
    }

    /// Runs `steps` more steps of every chain, all tiles to the same step; `done` hears of every tile that has finished,
    /// by its number of samples.
    pub fn burst(&mut self, steps: u64, done: &(impl Fn(u64) + Sync)) {
        let order: Vec<usize> = (0..self.tile_count()).collect();
        self.burst_in_order(steps, &order, done);
    }

    /// [`burst`](Self::burst) with the tiles dealt in the given order, which must name every tile once; others are
    /// passed over.
    pub fn burst_in_order(&mut self, steps: u64, order: &[usize], done: &(impl Fn(u64) + Sync)) {
        let next = AtomicUsize::new(0);
        let (chains, tile_size) = (self.chains(), self.plan.tile.size);
        let (tiles, range) = (self.tile_count(), self.steps..self.steps + steps);
        let worlds = &self.worlds;
        self.pool.broadcast(|context| {
            let mut world = lock(&worlds[context.index()]);
            while let Some(&tile) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
                if tile >= tiles {
                    continue;
                }
                let first = tile as u32 * tile_size;
                let count = tile_size.min(chains - first);
                world.run(first, count, range.clone());
                done(u64::from(count) * steps);
            }
        });
        self.steps += steps;
    }

    /// What all worlds have counted.
    #[must_use]
    pub fn counters(&self) -> Counters {
        self.worlds
            .iter()
            .fold(Counters::default(), |sum, world| sum.plus(lock(world).counters()))
    }

    /// What every system has cost, summed over threads, in the order in which systems run.
    #[must_use]
    pub fn costs(&self) -> Vec<SystemCost> {
        let mut total: Vec<SystemCost> = Vec::new();
        for world in &self.worlds {
            for cost in &lock(world).profile().systems {
                match total.iter_mut().find(|sum| sum.spec == cost.spec) {
                    Some(sum) => {
                        sum.runs += cost.runs;
                        sum.nanoseconds += cost.nanoseconds;
                    }
                    None => total.push(*cost),
                }
            }
        }
        let position = |spec: SystemSpec| self.plan.tile.systems.iter().position(|system| system.spec == spec);
        total.sort_by_key(|cost| position(cost.spec));
        total
    }

    /// Wall time that threads have spent in steps, summed over them.
    #[must_use]
    pub fn busy_time(&self) -> Duration {
        self.worlds.iter().map(|world| lock(world).busy()).sum()
    }

    /// Lets `look` see every thread's world.
    pub fn for_each_world(&self, mut look: impl FnMut(usize, &mut TileWorld)) {
        for (thread, world) in self.worlds.iter().enumerate() {
            look(thread, &mut lock(world));
        }
    }
}

/// A world that another thread panicked in still holds valid tables: every step writes before it reads.
fn lock(world: &Mutex<TileWorld>) -> MutexGuard<'_, TileWorld> {
    world.lock().unwrap_or_else(PoisonError::into_inner)
}
